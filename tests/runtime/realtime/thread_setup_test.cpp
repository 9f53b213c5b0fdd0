// SPDX-License-Identifier: BSD-3-Clause
#include "realtime/thread_setup.h"

#include "flyball/runtime/realtime/cpus.h"

#include "scratch_folder.h"
#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <linux/capability.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace flyball {
namespace {

void set_limits(const ScratchFolder& folder, const std::string& runtime_us) {
  (void)folder.file("sched_rt_runtime_us", runtime_us + "\n");
  (void)folder.file("sched_rt_period_us", "1000000\n");
}

TEST(RealTimeThrottle, says_how_long_a_core_stands_still_and_what_ends_it) {
  const ScratchFolder folder;
  set_limits(folder, "950000");
  EXPECT_EQ(real_time_throttle(folder.path()),
            "a core on which jobs with real-time priorities never rest stands still for 50 ms of "
            "every 1000 ms; sysctl kernel.sched_rt_runtime_us=-1 ends that");
}

TEST(RealTimeThrottle, says_nothing_where_the_kernel_withholds_nothing_or_has_no_such_limit) {
  const ScratchFolder folder;
  EXPECT_FALSE(real_time_throttle(folder.path()));
  set_limits(folder, "-1");
  EXPECT_FALSE(real_time_throttle(folder.path()));
  set_limits(folder, "1000000");
  EXPECT_FALSE(real_time_throttle(folder.path()));
}

TEST(GrantableFifo, leaves_room_for_all_priorities_or_says_that_there_is_none) {
  const FifoGrant low = grantable_fifo(1, 0);
  const FifoGrant high = grantable_fifo(97, 5);
  if (!low.from) {  // This user may not have any.
    EXPECT_NE(low.note.find("CAP_SYS_NICE"), std::string::npos) << low.note;
    EXPECT_FALSE(high.from);
    return;
  }
  EXPECT_EQ(low.note, "");
  ASSERT_TRUE(high.from);
  EXPECT_LE(*high.from, 94);
  EXPECT_EQ(high.note.rfind("SCHED_FIFO begins at priority ", 0), 0U) << high.note;
  EXPECT_FALSE(grantable_fifo(50, 99).from) << "there are not so many";
}

/// As a user of whom `rtprio` alone says which priorities he may have: of the calling thread.
void give_up_cap_sys_nice() {
  __user_cap_header_struct of{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> rights{};
  ASSERT_EQ(syscall(SYS_capget, &of, rights.data()), 0);
  rights[0].effective &= ~(1U << CAP_SYS_NICE);
  ASSERT_EQ(syscall(SYS_capset, &of, rights.data()), 0);
}

TEST(ComeFirst, takes_the_highest_priority_that_the_user_may_have) {
  constexpr rlim_t granted = 80;  // By the service's unit and by `flyball board setup`.
  rlimit before{};
  getrlimit(RLIMIT_RTPRIO, &before);
  const rlimit limited{granted, std::max(granted, before.rlim_max)};
  if (setrlimit(RLIMIT_RTPRIO, &limited) != 0) {
    GTEST_SKIP() << "this user may have no real-time priorities";
  }
  int policy{};
  sched_param got{};
  std::thread{[&] {
    give_up_cap_sys_nice();
    come_first();
    pthread_getschedparam(pthread_self(), &policy, &got);
  }}.join();
  setrlimit(RLIMIT_RTPRIO, &before);
  EXPECT_EQ(policy, SCHED_FIFO);
  EXPECT_EQ(got.sched_priority, static_cast<int>(granted));
}

/// What a process of its own answers as a user whom this limit binds; -1: it may not be so high.
template <class Answer>
int answer_within(rlim_t bytes, Answer answer) {
  const pid_t process = fork();
  if (process == 0) {
    const rlimit limit{bytes, bytes};
    constexpr uid_t nobody = 65534;
    const bool is_bound =
        setrlimit(RLIMIT_MEMLOCK, &limit) == 0 && (geteuid() != 0 || setuid(nobody) == 0);
    _exit(is_bound ? answer() : 255);
  }
  int status = 0;
  waitpid(process, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) != 255 ? WEXITSTATUS(status) : -1;
}

TEST(MemoryLockLimit, is_the_users_unless_there_is_none) {
  EXPECT_EQ(answer_within(65'536, [] { return memory_lock_limit() == 65'536U ? 0 : 1; }), 0);
  rlimit own{};
  getrlimit(RLIMIT_MEMLOCK, &own);
  if (const auto limit = memory_lock_limit()) {
    EXPECT_EQ(*limit, own.rlim_cur);
  }
}

TEST(LockProcessMemory, leaves_room_for_memory_that_is_asked_for_later) {
  constexpr int some_bytes = 64 << 20;
  rlim_t pages{};
  std::ifstream{"/proc/self/statm"} >> pages;
  const rlim_t present = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
  const int answer = answer_within(present + some_bytes / 2, [] {
    const auto note = lock_process_memory();
    constexpr int flags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE;
    const void* more = mmap(nullptr, some_bytes, PROT_NONE, flags, -1, 0);
    const bool is_told = note && note->find("at its start is locked") != std::string::npos;
    return (is_told ? 0 : 1) + (more == MAP_FAILED ? 2 : 0);
  });
  if (answer < 0) {
    GTEST_SKIP() << "the memlock limit of this user is below what the program has";
  }
  EXPECT_EQ(answer, 0) << "1: without a note; 2: nothing more can be had";
}

}  // namespace
}  // namespace flyball
