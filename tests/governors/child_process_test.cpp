// SPDX-License-Identifier: BSD-3-Clause
#include "child_process.h"

#include <csignal>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;
using Received = PacketSocket::Received;

constexpr std::size_t roomy = 64U << 20U;

std::unique_ptr<ChildProcess> forked(const std::function<void(const PacketSocket&)>& work,
                                     std::size_t memory_bytes = roomy) {
  auto child = ChildProcess::fork(memory_bytes, work);
  EXPECT_TRUE(child.ok());
  return std::move(*child);
}

TEST(ChildProcess, answers_packet_by_packet) {
  const auto child = forked([](const PacketSocket& socket) {
    int number = 0;
    while (socket.receive(&number, sizeof number, -1s) == Received::packet) {
      number *= 2;
      static_cast<void>(socket.send(&number, sizeof number));
    }
  });
  for (int i = 1; i < 5; ++i) {
    int number = i;
    ASSERT_TRUE(child->socket().send(&number, sizeof number));
    ASSERT_EQ(Received::packet, child->socket().receive(&number, sizeof number, 10s));
    EXPECT_EQ(2 * i, number);
  }
}

TEST(ChildProcess, that_is_silent_is_late_and_can_be_ended) {
  const auto child = forked([](const PacketSocket&) { pause(); });
  int number = 0;
  EXPECT_EQ(Received::late, child->socket().receive(&number, sizeof number, 1ms));
  EXPECT_EQ("was ended by signal 9 (Killed)", child->end());
}

TEST(ChildProcess, that_crashes_says_how) {
  const auto child = forked([](const PacketSocket&) {
    std::signal(SIGSEGV, SIG_DFL);  // A sanitizer would turn it into something else.
    std::raise(SIGSEGV);
  });
  int number = 0;
  EXPECT_EQ(Received::ended, child->socket().receive(&number, sizeof number, 10s));
  EXPECT_EQ("was ended by signal 11 (Segmentation fault)", child->end());
  EXPECT_FALSE(child->socket().send(&number, sizeof number));
}

TEST(ChildProcess, that_exits_says_so) {
  const auto child = forked([](const PacketSocket&) { _exit(7); });
  int number = 0;
  EXPECT_EQ(Received::ended, child->socket().receive(&number, sizeof number, 10s));
  EXPECT_EQ("ended by itself with exit code 7", child->end());
}

TEST(ChildProcess, is_refused_memory_beyond_its_limit) {
  const auto child = forked(
      [](const PacketSocket& socket) {
        int blocks = 0;
        // Not malloc: a sanitizer's gives no null but ends the process.
        while (blocks < 64 && mmap(nullptr, 1U << 20U, PROT_READ | PROT_WRITE,
                                   MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED) {
          ++blocks;
        }
        static_cast<void>(socket.send(&blocks, sizeof blocks));
      },
      std::size_t{8} << 20U);
  int blocks = 0;
  ASSERT_EQ(Received::packet, child->socket().receive(&blocks, sizeof blocks, 10s));
  EXPECT_GT(blocks, 0);
  EXPECT_LT(blocks, 16);
}

}  // namespace
}  // namespace flyball
