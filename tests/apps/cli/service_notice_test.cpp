// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "flyball_program.h"
#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace {

/// The side of systemd: where programs that are started from here find it.
class Listener {
 public:
  explicit Listener(const std::string& path, const char* interval_us = "3000")
      : socket_{::socket(AF_UNIX, SOCK_DGRAM, 0)} {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(&address.sun_path[0], path.c_str(), sizeof address.sun_path - 1);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): as bind wants it
    const auto* place = reinterpret_cast<const sockaddr*>(&address);
    EXPECT_EQ(::bind(socket_, place, sizeof address), 0);
    setenv("NOTIFY_SOCKET", path.c_str(), 1);
    setenv("WATCHDOG_USEC", interval_us, 1);
  }
  ~Listener() {
    ::close(socket_);
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  [[nodiscard]] std::vector<std::string> heard() const {
    std::vector<std::string> words;
    std::array<char, 256> word{};
    for (ssize_t size = 0; (size = ::recv(socket_, word.data(), word.size(), MSG_DONTWAIT)) >= 0;) {
      words.emplace_back(word.data(), static_cast<std::size_t>(size));
    }
    return words;
  }

 private:
  int socket_;
};

constexpr const char* short_flight =
    "run delivery_open --policy fixed_fine --set mission.time_limit_s=4 --out flight";

TEST(ServiceNotice, says_that_the_flight_began_and_that_it_goes_on) {
  const FlyballProgram flyball;
  const Listener systemd{flyball.place.path("notify")};
  const auto done = flyball.run(short_flight);
  EXPECT_EQ(done.exit_code, 1) << done.errors;
  const std::vector<std::string> heard = systemd.heard();
  ASSERT_GE(heard.size(), 3U);
  EXPECT_EQ(heard[0], "READY=1");
  EXPECT_EQ(std::count(heard.begin(), heard.end(), "WATCHDOG=1"),
            static_cast<std::ptrdiff_t>(heard.size()) - 1);
}

/// Else a finished mission would be killed over a long record, started anew, and flown again.
TEST(ServiceNotice, asks_for_a_century_to_write_what_the_flight_leaves) {
  const FlyballProgram flyball;
  const Listener systemd{flyball.place.path("notify"), "3600000000"};  // No step is told but one.
  const auto done = flyball.run(short_flight);
  EXPECT_EQ(done.exit_code, 1) << done.errors;
  const std::vector<std::string> expected{"READY=1", "WATCHDOG=1",
                                          "WATCHDOG_USEC=3155760000000000"};
  EXPECT_EQ(systemd.heard(), expected);
}

TEST(ServiceNotice, minds_no_manager_that_has_gone) {
  const FlyballProgram flyball;
  setenv("NOTIFY_SOCKET", flyball.place.path("nobody").c_str(), 1);
  const auto done = flyball.run(short_flight);
  unsetenv("NOTIFY_SOCKET");
  EXPECT_EQ(done.exit_code, 1) << done.errors;
  EXPECT_EQ(done.errors, "");
}

}  // namespace
