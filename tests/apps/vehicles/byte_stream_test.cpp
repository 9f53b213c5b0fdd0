// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/vehicles/byte_stream.h"

#include "scratch_folder.h"
#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

std::string refusal(const std::string& address) {
  const auto opened = open_byte_stream(address);
  return opened ? "opened" : opened.error().message;
}

/// A socket of this computer: a simulated autopilot's, or one that asks for a free port.
class LocalSocket {
 public:
  LocalSocket() {
    sockaddr_in here = address_of(0);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&here), sizeof here), 0);
    socklen_t size = sizeof here;
    EXPECT_EQ(::getsockname(socket_, reinterpret_cast<sockaddr*>(&here), &size), 0);
    port_ = ntohs(here.sin_port);
  }
  ~LocalSocket() { ::close(socket_); }
  LocalSocket(const LocalSocket&) = delete;
  LocalSocket& operator=(const LocalSocket&) = delete;

  [[nodiscard]] int port() const { return port_; }
  void send(int port, const Bytes& bytes) const {
    const sockaddr_in there = address_of(port);
    EXPECT_EQ(::sendto(socket_, bytes.data(), bytes.size(), 0,
                       reinterpret_cast<const sockaddr*>(&there), sizeof there),
              static_cast<ssize_t>(bytes.size()));
  }
  [[nodiscard]] Bytes receive() const {
    Bytes room(100);
    const auto got = ::recv(socket_, room.data(), room.size(), MSG_DONTWAIT);
    room.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return room;
  }

 private:
  static sockaddr_in address_of(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
  }
  int socket_{::socket(AF_INET, SOCK_DGRAM, 0)};
  int port_{};
};

struct ListeningStream {
  int port{};
  std::unique_ptr<ByteStream> stream{};
};

/// Somebody else may take a free port before it is opened: the next one, then.
ListeningStream listen_somewhere() {
  for (int i = 0; i < 100; ++i) {
    const int port = LocalSocket{}.port();
    if (auto opened = open_byte_stream("udp:localhost:" + std::to_string(port))) {
      return {port, std::move(*opened)};
    }
  }
  ADD_FAILURE() << "no port is free";
  return {};
}

TEST(ByteStream, listens_by_udp_and_answers_the_first_sender_alone) {
  const auto [port, stream] = listen_somewhere();
  ASSERT_TRUE(stream);
  EXPECT_TRUE(stream->send({1, 2, 3}));  // To nobody yet.
  const LocalSocket autopilot;
  const LocalSocket stranger;
  autopilot.send(port, {4, 5});
  stranger.send(port, {6});
  autopilot.send(port, {7});
  Bytes heard;
  ASSERT_TRUE(stream->receive(heard));
  EXPECT_EQ(heard, (Bytes{4, 5, 7}));
  ASSERT_TRUE(stream->send({8, 9}));
  EXPECT_EQ(autopilot.receive(), (Bytes{8, 9}));
  EXPECT_TRUE(stranger.receive().empty());
  heard.clear();
  ASSERT_TRUE(stream->receive(heard));  // Does not wait.
  EXPECT_TRUE(heard.empty());
}

TEST(ByteStream, a_simulator_that_has_gone_is_no_error) {
  const auto [port, stream] = listen_somewhere();
  ASSERT_TRUE(stream);
  {
    const LocalSocket autopilot;
    autopilot.send(port, {1});
    Bytes heard;
    ASSERT_TRUE(stream->receive(heard));
  }
  for (int i = 0; i < 3; ++i) {  // The system says so at the next call.
    Bytes heard;
    EXPECT_TRUE(stream->send({2}));
    EXPECT_TRUE(stream->receive(heard));
  }
}

TEST(ByteStream, wakes_up_when_something_arrives) {
  const auto [port, stream] = listen_somewhere();
  ASSERT_TRUE(stream);
  const LocalSocket autopilot;
  autopilot.send(port, {1});
  EXPECT_LT(stream->wait(1h), 1h);
  EXPECT_GE(stream->wait(0ms), 0ms);
}

TEST(ByteStream, refuses_hosts_that_are_not_this_computer_and_names_the_way_out) {
  for (const char* host : {"192.168.1.7", "0.0.0.0", "example.com", "128.0.0.1"}) {
    const std::string said = refusal(std::string{"udp:"} + host + ":14540");
    EXPECT_NE(said.find("MAVLink router"), std::string::npos) << said;
    EXPECT_NE(said.find("udp:127.0.0.1:14540"), std::string::npos) << said;
  }
}

TEST(ByteStream, says_how_to_write_what_others_write_with_slashes) {
  EXPECT_EQ(refusal("udp://127.0.0.1:14540"),
            "\"udp://127.0.0.1:14540\" is written with \"://\"; write \"udp:127.0.0.1:14540\"");
}

TEST(ByteStream, says_what_is_wrong_with_an_address) {
  for (const char* address : {"", "udp", "udp:", "udp::14540", "udp:127.0.0.1:",
                              "tcp:127.0.0.1:5760", "/dev/ttyACM0", "serial:/dev/ttyACM0"}) {
    EXPECT_NE(refusal(address).find("is no address of an autopilot"), std::string::npos)
        << address << ": " << refusal(address);
  }
  for (const char* port : {"0", "65536", "abc", "14540x", "-1"}) {
    EXPECT_NE(refusal(std::string{"udp:127.0.0.1:"} + port).find("is no port"), std::string::npos);
  }
  EXPECT_NE(refusal("serial:/dev/null:12345").find("there are: 57600"), std::string::npos);
  EXPECT_NE(refusal("serial:/dev/null:57600").find("is no serial line"), std::string::npos);
  EXPECT_NE(refusal("serial:/dev/nothing:57600").find("No such file"), std::string::npos);
}

TEST(ByteStream, says_that_a_port_is_taken) {
  const LocalSocket other;
  const std::string said = refusal("udp:127.0.0.1:" + std::to_string(other.port()));
  EXPECT_NE(said.find("Address already in use"), std::string::npos) << said;
}

/// The far end of a serial line, as an autopilot has it.
class FarEnd {
 public:
  FarEnd() {
    EXPECT_EQ(::grantpt(number_), 0);
    EXPECT_EQ(::unlockpt(number_), 0);
    EXPECT_EQ(::ptsname_r(number_, device_.data(), device_.size()), 0);
  }
  ~FarEnd() { hang_up(); }
  FarEnd(const FarEnd&) = delete;
  FarEnd& operator=(const FarEnd&) = delete;

  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] std::string device() const { return device_.data(); }
  void hang_up() {
    if (number_ >= 0) {
      ::close(std::exchange(number_, -1));
    }
  }

 private:
  int number_{::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)};
  std::array<char, 100> device_{};
};

TEST(ByteStream, carries_all_bytes_over_a_serial_line) {
  FarEnd autopilot;
  auto stream = open_byte_stream("serial:" + autopilot.device() + ":921600");
  ASSERT_TRUE(stream) << stream.error().message;
  Bytes all;  // Also those that a terminal would take for commands.
  for (int byte = 0; byte < 256; ++byte) {
    all.push_back(static_cast<std::uint8_t>(byte));
  }
  ASSERT_TRUE((*stream)->send(all));
  Bytes room(300);
  EXPECT_EQ(::read(autopilot.number(), room.data(), room.size()), 256);
  room.resize(256);
  EXPECT_EQ(room, all);
  Bytes heard;
  ASSERT_TRUE((*stream)->receive(heard));  // Nothing has come yet.
  EXPECT_TRUE(heard.empty());
  ASSERT_EQ(::write(autopilot.number(), all.data(), all.size()), 256);
  (void)(*stream)->wait(1h);
  ASSERT_TRUE((*stream)->receive(heard));
  EXPECT_EQ(heard, all);
  autopilot.hang_up();
  EXPECT_FALSE((*stream)->send({1}));  // Somebody pulled the plug.
}

TEST(ByteStream, says_that_a_serial_line_has_hung_up_and_finds_it_again) {
  const ScratchFolder folder;
  const std::string by_id =
      folder.path("autopilot");  // A name that stays, as in /dev/serial/by-id.
  FarEnd before;
  std::filesystem::create_symlink(before.device(), by_id);
  auto stream = open_byte_stream("serial:" + by_id + ":921600");
  ASSERT_TRUE(stream) << stream.error().message;
  before.hang_up();
  std::filesystem::remove(by_id);
  Bytes heard;
  const Status gone = (*stream)->receive(heard);
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error().code, ErrorCode::unavailable);
  EXPECT_EQ(gone.error().message, by_id + " has hung up; is its cable loose?");
  EXPECT_GE((*stream)->wait(5ms), 5ms);  // What never has anything to read is no reason to wake up.
  EXPECT_FALSE((*stream)->send({1}));
  EXPECT_FALSE((*stream)->receive(heard));
  const FarEnd after;
  std::filesystem::create_symlink(after.device(), by_id);
  ASSERT_TRUE((*stream)->receive(heard));
  ASSERT_TRUE((*stream)->send({2, 3}));
  Bytes room(10);
  ASSERT_EQ(::read(after.number(), room.data(), room.size()), 2);
  EXPECT_EQ(room[0], 2);
  ASSERT_EQ(::write(after.number(), room.data(), 2), 2);
  (void)(*stream)->wait(1h);
  ASSERT_TRUE((*stream)->receive(heard));
  EXPECT_EQ(heard, (Bytes{2, 3}));
}

TEST(ByteStream, loses_new_messages_rather_than_half_of_one_when_a_line_is_full) {
  const FarEnd autopilot;
  auto stream = open_byte_stream("serial:" + autopilot.device() + ":57600");
  ASSERT_TRUE(stream);
  const Bytes message{1, 2, 3, 4, 5, 6, 7};
  for (int i = 0; i < 20000; ++i) {
    ASSERT_TRUE((*stream)->send(message));
  }
  Bytes all;
  Bytes room(4096);
  for (int i = 0; i < 1000; ++i) {
    const auto got = ::read(autopilot.number(), room.data(), room.size());
    if (got > 0) {
      all.insert(all.end(), room.begin(), room.begin() + got);
    }
    ASSERT_TRUE((*stream)->send({}));
  }
  EXPECT_LT(all.size(), 7U * 20000U);
  EXPECT_EQ(all.size() % 7, 0U);
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_EQ(all[i], message[i % 7]);
  }
}

}  // namespace
}  // namespace flyball
