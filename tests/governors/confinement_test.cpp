// SPDX-License-Identifier: BSD-3-Clause
// test-label: fault
#include "libraries/confinement.h"

#include "libraries/child_process.h"
#include <array>
#include <cerrno>
#include <cstddef>
#include <stdexcept>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;
using Received = PacketSocket::Received;

struct End {
  int answer{-1};
  std::string how;
};

/// Runs `work` in a confined process; its answer, and how it ended.
End end_of(const std::function<int()>& work) {
  auto child = ChildProcess::fork(64U << 20U, [&work](const PacketSocket& socket) {
    int answer = work();
    static_cast<void>(socket.send(&answer, sizeof answer));
  });
  EXPECT_TRUE(child.ok());
  End end;
  const auto received = (*child)->socket().receive(&end.answer, sizeof end.answer, 10s);
  end.how = received == Received::packet ? "answered" : (*child)->end();
  return end;
}

int is_open(int descriptor) {
  return descriptor >= 0 ? 1 : 0;
}

#ifndef __SANITIZE_ADDRESS__  // Its own calls are none that a policy may make.
TEST(Confinement, lets_a_policy_compute_and_read_files_until_it_decides) {
  const End end = end_of([] {
    int good = confine(Confinement::loading) == Confined::yes ? 1 : 0;
    good += is_open(open("/proc/self/status", O_RDONLY));
    good += confine(Confinement::deciding) == Confined::yes ? 1 : 0;
    const std::string long_text(1U << 20U, 'x');
    try {
      throw std::runtime_error{long_text};
    } catch (const std::exception& error) {
      good += error.what() == long_text ? 1 : 0;
    }
    return good;
  });
  EXPECT_EQ("answered", end.how);
  EXPECT_EQ(4, end.answer);
}

TEST(Confinement, ends_a_process_and_says_what_for) {
  EXPECT_EQ("was ended because it reached for the network, which a policy may not use",
            end_of([] {
              static_cast<void>(confine(Confinement::loading));
              return socket(AF_INET, SOCK_STREAM, 0);
            }).how);
  const auto reads_late = [] {
    static_cast<void>(confine(Confinement::loading));
    static_cast<void>(confine(Confinement::deciding));
    return open("/proc/self/status", O_RDONLY);
  };
  EXPECT_EQ(
      "was ended because it reached for a file, which a policy may only read, and only until "
      "it has started",
      end_of(reads_late).how);
}
#endif

/// A kernel without seccomp, as far as this process can tell.
void hide_seccomp() {
  std::array<sock_filter, 4> lines{{
      {BPF_LD | BPF_W | BPF_ABS, 0, 0, offsetof(seccomp_data, nr)},
      {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, __NR_seccomp},
      {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ERRNO | ENOSYS},
      {BPF_RET | BPF_K, 0, 0, SECCOMP_RET_ALLOW},
  }};
  sock_fprog program{lines.size(), lines.data()};
  syscall(__NR_seccomp, SECCOMP_SET_MODE_FILTER, 0, &program);
}
TEST(Confinement, without_seccomp_says_so_and_goes_on) {
  const End end = end_of([] {
    hide_seccomp();
    return confine(Confinement::loading) == Confined::no_seccomp ? 1 : 0;
  });
  EXPECT_EQ("answered", end.how);
  EXPECT_EQ(1, end.answer);
}

}  // namespace
}  // namespace flyball
