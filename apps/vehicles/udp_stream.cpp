// SPDX-License-Identifier: BSD-3-Clause
// tested-in: byte_stream
#include "vehicles/udp_stream.h"

#include "flyball/runtime/file_handle.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <optional>
#include <utility>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace flyball {
namespace {

constexpr std::size_t largest_datagram = 65536;
constexpr int most_datagrams = 1000;  // In one call: a flood must not hold up the flight.
constexpr int loopback_net = 127;

std::optional<std::uint16_t> port_number(const std::string& text) {
  std::uint16_t port{};
  const char* end = text.data() + text.size();
  const auto [stopped, failed] = std::from_chars(text.data(), end, port);
  return failed == std::errc{} && stopped == end && port > 0 ? std::optional{port} : std::nullopt;
}

/// Host's byte order; empty for what is no address of this computer.
std::optional<std::uint32_t> loopback_address(const std::string& host) {
  in_addr address{};
  if (inet_pton(AF_INET, host == "localhost" ? "127.0.0.1" : host.c_str(), &address) != 1) {
    return std::nullopt;
  }
  const std::uint32_t number = ntohl(address.s_addr);
  return number >> 24U == loopback_net ? std::optional{number} : std::nullopt;
}

bool is_same(const sockaddr_in& a, const sockaddr_in& b) {
  return a.sin_addr.s_addr == b.sin_addr.s_addr && a.sin_port == b.sin_port;
}

/// What only says that nobody, or no room, is there now.
bool is_passing(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR || error == ECONNREFUSED ||
         error == ENOBUFS;
}

class UdpStream final : public ByteStream {
 public:
  explicit UdpStream(std::unique_ptr<FileHandle> socket) : socket_{std::move(socket)} {}

  Status send(const std::vector<std::uint8_t>& bytes) override {
    if (!peer_ || bytes.empty()) {
      return Done{};
    }
    const auto* to = reinterpret_cast<const sockaddr*>(&*peer_);  // NOLINT: sockets' own way
    const auto sent =
        sendto(socket_->number(), bytes.data(), bytes.size(), MSG_NOSIGNAL, to, sizeof *peer_);
    return sent >= 0 || is_passing(errno) ? Status{Done{}}
                                          : system_error("cannot send by UDP", errno);
  }

  /// Datagrams of others than the first sender are not listened to: two autopilots in one stream
  /// would be one that is in two places.
  Status receive(std::vector<std::uint8_t>& bytes) override {
    for (int i = 0; i < most_datagrams; ++i) {
      sockaddr_in from{};
      socklen_t size = sizeof from;
      auto* sender = reinterpret_cast<sockaddr*>(&from);  // NOLINT: sockets' own way
      const auto got =
          recvfrom(socket_->number(), room_.data(), room_.size(), MSG_DONTWAIT, sender, &size);
      if (got < 0) {
        return is_passing(errno) ? Status{Done{}} : system_error("cannot receive by UDP", errno);
      }
      peer_ = peer_.value_or(from);
      if (is_same(*peer_, from)) {
        bytes.insert(bytes.end(), room_.begin(), room_.begin() + got);
      }
    }
    return Done{};
  }

  Duration wait(Duration at_most) override { return socket_->wait(at_most); }

 private:
  std::unique_ptr<FileHandle> socket_;
  std::optional<sockaddr_in> peer_{};
  std::vector<std::uint8_t> room_ = std::vector<std::uint8_t>(largest_datagram);
};

}  // namespace

Result<std::unique_ptr<ByteStream>> open_udp(const std::string& host, const std::string& port) {
  const auto number = port_number(port);
  if (!number) {
    return Error{ErrorCode::invalid_input,
                 "\"" + port + "\" is no port; give one from 1 to 65535, as udp:127.0.0.1:14540"};
  }
  const auto address = loopback_address(host);
  if (!address) {
    return Error{ErrorCode::invalid_input,
                 "\"" + host +
                     "\" is not this computer: whoever can send to that address could fly the "
                     "vehicle; let a MAVLink router on this computer forward to udp:127.0.0.1:" +
                     port};
  }
  auto socket =
      std::make_unique<FileHandle>(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_port = htons(*number);
  here.sin_addr.s_addr = htonl(*address);
  const auto* at = reinterpret_cast<const sockaddr*>(&here);  // NOLINT: sockets' own way
  if (!socket->is_open() || bind(socket->number(), at, sizeof here) != 0) {
    return system_error("cannot listen at udp:" + host + ":" + port, errno);
  }
  return std::unique_ptr<ByteStream>{std::make_unique<UdpStream>(std::move(socket))};
}

}  // namespace flyball
