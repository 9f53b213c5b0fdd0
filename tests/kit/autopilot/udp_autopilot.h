// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The stand-in autopilot as a program of its own would be: on a thread, in real time, by UDP.

#include "autopilot_in_memory.h"
#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace flyball::kit {

/// Sends to a port of this computer that was free, from the beginning, as PX4's simulation does.
class UdpAutopilot {
 public:
  explicit UdpAutopilot(const StandInRules& rules)
      : autopilot_{rules, shipped_airframe()}, port_{free_port()} {
    timeval longest{0, 2000};  // Between two steps.
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
    thread_ = std::thread{[this] { run(); }};
  }
  ~UdpAutopilot() { stop(); }
  UdpAutopilot(const UdpAutopilot&) = delete;
  UdpAutopilot& operator=(const UdpAutopilot&) = delete;

  [[nodiscard]] std::string address() const { return "udp:127.0.0.1:" + std::to_string(port_); }
  /// While it runs: whether the vehicle is up, and whether somebody has said hello.
  [[nodiscard]] bool is_up() const { return is_up_; }
  [[nodiscard]] bool is_greeted() const { return is_greeted_; }
  /// It stops, and can be looked at.
  StandInAutopilot& stop() {
    is_stopped_ = true;
    if (thread_.joinable()) {
      thread_.join();
      ::close(socket_);
    }
    return autopilot_;
  }

 private:
  static sockaddr_in local(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
  }

  static std::uint16_t free_port() {
    const int asking = ::socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in here = local(0);
    socklen_t size = sizeof here;
    const bool is_known =
        ::bind(asking, reinterpret_cast<const sockaddr*>(&here), sizeof here) == 0 &&
        ::getsockname(asking, reinterpret_cast<sockaddr*>(&here), &size) == 0;
    ::close(asking);
    FLYBALL_ASSERT(is_known, "no port is free: %d", asking);
    return ntohs(here.sin_port);
  }

  void run() {
    const sockaddr_in there = local(port_);
    std::vector<std::uint8_t> room(4096);
    auto flown_until = std::chrono::steady_clock::now();
    while (!is_stopped_) {
      const auto got = ::recv(socket_, room.data(), room.size(), 0);
      if (got > 0) {
        autopilot_.hear({room.begin(), room.begin() + got});
      }
      const auto now = std::chrono::steady_clock::now();
      autopilot_.step(std::chrono::duration_cast<Duration>(now - flown_until));
      flown_until = now;
      is_up_ = autopilot_.moved_m().z() > 0.5;
      is_greeted_ = autopilot_.heartbeats() > 0;
      const std::vector<std::uint8_t> bytes = autopilot_.take_output();
      if (!bytes.empty()) {
        (void)::sendto(socket_, bytes.data(), bytes.size(), 0,
                       reinterpret_cast<const sockaddr*>(&there), sizeof there);
      }
    }
  }

  StandInAutopilot autopilot_;
  std::uint16_t port_;
  int socket_{::socket(AF_INET, SOCK_DGRAM, 0)};
  std::atomic<bool> is_up_{false};
  std::atomic<bool> is_greeted_{false};
  std::atomic<bool> is_stopped_{false};
  std::thread thread_{};
};

}  // namespace flyball::kit
