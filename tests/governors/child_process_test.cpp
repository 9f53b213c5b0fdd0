// SPDX-License-Identifier: BSD-3-Clause
#include "libraries/child_process.h"

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <sys/wait.h>
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

TEST(ChildProcess, is_refused_shared_memory_beyond_its_limit) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer has more addresses than any limit";
#endif
  const auto child = forked(
      [](const PacketSocket& socket) {
        int refused = mmap(nullptr, std::size_t{32} << 20U, PROT_READ | PROT_WRITE,
                           MAP_SHARED | MAP_ANONYMOUS, -1, 0) == MAP_FAILED
                          ? 1
                          : 0;
        static_cast<void>(socket.send(&refused, sizeof refused));
      },
      std::size_t{8} << 20U);
  int refused = 0;
  ASSERT_EQ(Received::packet, child->socket().receive(&refused, sizeof refused, 10s));
  EXPECT_EQ(1, refused);
}

TEST(ChildProcess, has_none_of_its_parents_files) {
  const int open_here = open("/dev/null", O_RDONLY);
  ASSERT_GE(open_here, 0);
  const auto child = forked([open_here](const PacketSocket& socket) {
    int open_there = fcntl(open_here, F_GETFD) != -1 && open_here != socket.descriptor() ? 1 : 0;
    char byte = 0;
    open_there += static_cast<int>(read(STDIN_FILENO, &byte, 1));
    static_cast<void>(socket.send(&open_there, sizeof open_there));
  });
  close(open_here);
  int open_there = -1;
  ASSERT_EQ(Received::packet, child->socket().receive(&open_there, sizeof open_there, 10s));
  EXPECT_EQ(0, open_there);
}

TEST(ChildProcess, a_packet_of_another_size_is_told) {
  const auto child = forked([](const PacketSocket& socket) {
    for (const std::size_t size : {1U, 64U}) {
      const std::vector<char> packet(size);
      static_cast<void>(socket.send(packet.data(), size));
    }
    pause();
  });
  int number = 7;
  EXPECT_EQ(Received::of_other_size, child->socket().receive(&number, sizeof number, 10s));
  EXPECT_EQ(Received::of_other_size, child->socket().receive(&number, sizeof number, 10s));
}

/// Whether a process that is not ours has ended, or does so soon.
bool ends_soon(pid_t process) {
  for (int i = 0; i < 1000; ++i) {
    std::ifstream status{"/proc/" + std::to_string(process) + "/stat"};
    std::string number;
    std::string name;
    std::string state;
    if (!(status >> number >> name >> state) || state == "Z") {
      return true;
    }
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

TEST(ChildProcess, takes_its_own_children_along) {
  const auto child = forked([](const PacketSocket& socket) {
    pid_t grandchild = fork();
    if (grandchild != 0) {
      static_cast<void>(socket.send(&grandchild, sizeof grandchild));
    }
    pause();
  });
  pid_t grandchild = 0;
  ASSERT_EQ(Received::packet, child->socket().receive(&grandchild, sizeof grandchild, 10s));
  child->end();
  EXPECT_TRUE(ends_soon(grandchild));
}

TEST(ChildProcess, outlives_the_thread_that_forked_it) {
  std::unique_ptr<ChildProcess> child;
  std::thread{[&child] {
    child = forked([](const PacketSocket& socket) {
      int number = 0;
      while (socket.receive(&number, sizeof number, -1s) == Received::packet) {
        static_cast<void>(socket.send(&number, sizeof number));
      }
    });
  }}.join();
  for (int i = 0; i < 100; ++i) {  // The kernel may be slower at ending a thread than `join`.
    int number = i;
    static_cast<void>(child->socket().send(&number, sizeof number));
    ASSERT_EQ(Received::packet, child->socket().receive(&number, sizeof number, 10s)) << i;
    std::this_thread::sleep_for(1ms);
  }
}

TEST(ChildProcess, is_late_although_signals_keep_coming) {
  const auto child = forked([](const PacketSocket&) { pause(); });
  std::signal(SIGALRM, [](int) {});
  const itimerval often{{0, 5000}, {0, 5000}};
  const itimerval never{};
  setitimer(ITIMER_REAL, &often, nullptr);
  int number = 0;
  EXPECT_EQ(Received::late, child->socket().receive(&number, sizeof number, 100ms));
  EXPECT_EQ("was ended by signal 9 (Killed)", child->end());
  setitimer(ITIMER_REAL, &never, nullptr);
  std::signal(SIGALRM, SIG_DFL);
}

TEST(ChildProcess, that_somebody_else_has_waited_for_is_no_clean_end) {
  const auto child = forked([](const PacketSocket&) { std::raise(SIGKILL); });
  int number = 0;
  EXPECT_EQ(Received::ended, child->socket().receive(&number, sizeof number, 10s));
  EXPECT_GT(waitpid(-1, nullptr, 0), 0);
  EXPECT_EQ("ended, but this program's other parts kept how", child->end());
}

TEST(ChildProcess, ends_with_its_parent) {
  std::array<int, 2> ends{};
  ASSERT_EQ(0, pipe(ends.data()));
  const pid_t parent = fork();
  if (parent == 0) {
    const auto child = forked([](const PacketSocket& socket) {
      pid_t self = getpid();
      static_cast<void>(socket.send(&self, sizeof self));
      pause();
    });
    pid_t id = 0;
    static_cast<void>(child->socket().receive(&id, sizeof id, 10s));
    const bool wrote = write(ends[1], &id, sizeof id) == sizeof id;
    _exit(wrote ? 0 : 1);
  }
  pid_t child = 0;
  ASSERT_EQ(static_cast<ssize_t>(sizeof child), read(ends[0], &child, sizeof child));
  waitpid(parent, nullptr, 0);
  EXPECT_TRUE(ends_soon(child));
}

}  // namespace
}  // namespace flyball
