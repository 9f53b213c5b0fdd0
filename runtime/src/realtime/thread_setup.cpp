// SPDX-License-Identifier: BSD-3-Clause
#include "realtime/thread_setup.h"

#include "flyball/runtime/realtime/cpus.h"
#include "flyball/runtime/text/listed.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <thread>

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace flyball {
namespace {

constexpr std::size_t prefaulted_bytes = 262'144;  // Chosen: more than OMPL's deepest recursion.

std::string reason(int number) {
  return std::strerror(number);  // NOLINT(concurrency-mt-unsafe): glibc's is safe per thread.
}

/// Touches the pages of the stack below, so that none of them faults during a job.
[[gnu::noinline]] void touch_stack() {
  std::array<volatile char, prefaulted_bytes> pages;  // NOLINT: it is written in the next lines.
  for (std::size_t i = 0; i < pages.size(); i += 4096) {
    pages[i] = 1;
  }
}

std::optional<std::string> set_fifo(const std::string& name, int priority) {
  sched_param wanted{};
  wanted.sched_priority = priority;
  const int failed = pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted);
  int policy{};
  sched_param granted{};
  pthread_getschedparam(pthread_self(), &policy, &granted);
  if (failed == 0 && policy == SCHED_FIFO && granted.sched_priority == priority) {
    return std::nullopt;
  }
  return "thread " + name + " runs under ordinary scheduling, not SCHED_FIFO at priority " +
         std::to_string(priority) + (failed != 0 ? " (" + reason(failed) + ")" : "") +
         "; give the program CAP_SYS_NICE, or its user an rtprio limit of " +
         std::to_string(priority);
}

std::optional<std::string> set_nice(const std::string& name, int nice) {
  const auto thread = static_cast<id_t>(thread_id());
  errno = 0;
  const bool is_set = setpriority(PRIO_PROCESS, thread, nice) == 0;
  const int failed = errno;
  if (is_set && getpriority(PRIO_PROCESS, thread) == nice) {
    return std::nullopt;
  }
  return "thread " + name + " did not get the nice value " + std::to_string(nice) + " (" +
         reason(failed) + ")";
}

}  // namespace

int process_nice() {
  return getpriority(PRIO_PROCESS, static_cast<id_t>(getpid()));
}

pid_t thread_id() {
  return static_cast<pid_t>(syscall(SYS_gettid));
}

std::vector<std::string> set_up_thread(const ThreadWish& wish) {
  std::vector<std::string> notes;
  pthread_setname_np(pthread_self(), wish.name.substr(0, 15).c_str());
  // Timers of ordinary threads may otherwise come 50 us late.
  prctl(PR_SET_TIMERSLACK, 1, 0, 0, 0);
  std::optional<std::string> note;
  if (wish.fifo_priority) {
    note = set_fifo(wish.name, *wish.fifo_priority);
  } else if (wish.nice != process_nice()) {
    note = set_nice(wish.name, wish.nice);
  }
  if (note) {
    notes.push_back(*note);
  }
  if (wish.prefault_stack) {
    touch_stack();
  }
  return notes;
}

std::optional<std::string> bind_thread(pid_t thread, const std::vector<int>& cpus) {
  cpu_set_t wanted;
  CPU_ZERO(&wanted);
  for (const int cpu : cpus) {
    CPU_SET(static_cast<std::size_t>(cpu), &wanted);
  }
  const bool is_set = sched_setaffinity(thread, sizeof wanted, &wanted) == 0;
  const int failed = errno;
  cpu_set_t granted;
  CPU_ZERO(&granted);
  sched_getaffinity(thread, sizeof granted, &granted);
  if (is_set && CPU_EQUAL(&wanted, &granted)) {
    return std::nullopt;
  }
  return "a thread could not be bound to the cores " + listed(cpus) + " (" +
         (is_set ? "the system granted fewer" : reason(failed)) + "); is one of them off-line?";
}

FifoGrant grantable_fifo(int from, int above) {
  constexpr int highest = 99;  // Of Linux.
  FifoGrant grant;
  std::thread{[&] {
    for (int lowest = std::min(from, highest - above); lowest >= 1 && !grant.from; --lowest) {
      if (!set_fifo("", lowest + above)) {
        grant.from = lowest;
      }
    }
  }}.join();
  const std::string way_out = "give the program CAP_SYS_NICE, or its user an rtprio limit of " +
                              std::to_string(std::min(from + above, highest));
  if (!grant.from) {
    grant.note = "jobs run under ordinary scheduling, not SCHED_FIFO from priority " +
                 std::to_string(from) + " on; " + way_out;
  } else if (*grant.from < from) {
    grant.note = "SCHED_FIFO begins at priority " + std::to_string(*grant.from) + " instead of " +
                 std::to_string(from) + ", so that the most urgent of " +
                 std::to_string(above + 1) + " gets its own" +
                 (from + above > highest ? "" : "; " + way_out);
  }
  return grant;
}

std::optional<std::string> real_time_throttle(const std::string& folder) {
  long runtime_us{};
  long period_us{};
  if (!(std::ifstream{folder + "/sched_rt_runtime_us"} >> runtime_us) ||
      !(std::ifstream{folder + "/sched_rt_period_us"} >> period_us) || runtime_us < 0 ||
      runtime_us >= period_us) {
    return std::nullopt;
  }
  return "a core on which jobs with real-time priorities never rest stands still for " +
         std::to_string((period_us - runtime_us) / 1000) + " ms of every " +
         std::to_string(period_us / 1000) + " ms; sysctl kernel.sched_rt_runtime_us=-1 ends that";
}

void step_back() {
  constexpr int nicest = 19;
  const sched_param ordinary{};
  (void)sched_setscheduler(0, SCHED_OTHER, &ordinary);
  (void)setpriority(PRIO_PROCESS, static_cast<id_t>(thread_id()), nicest);
}

void come_first() {
  constexpr int below_the_kernels = 98;  // Its own watchdogs have 99.
  int priority = below_the_kernels;
  while (priority >= 1 && set_fifo("", priority)) {  // A user may have them up to his limit.
    --priority;
  }
}

std::optional<rlim_t> memory_lock_limit() {
  rlimit limit{};
  getrlimit(RLIMIT_MEMLOCK, &limit);
  if (limit.rlim_cur == RLIM_INFINITY) {
    return std::nullopt;
  }
  // A capability lifts the limit, but not if it is one of a user namespace: only trying tells.
  // Nobody can touch what is tried, so that it takes no memory.
  const std::size_t more = static_cast<std::size_t>(limit.rlim_cur) + 65'536;
  constexpr int flags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_LOCKED;
  void* const locked = mmap(nullptr, more, PROT_NONE, flags, -1, 0);
  if (locked == MAP_FAILED) {
    return limit.rlim_cur;
  }
  munmap(locked, more);
  return std::nullopt;
}

std::optional<std::string> lock_process_memory() {
#ifdef MCL_ONFAULT
  constexpr int present = MCL_CURRENT | MCL_ONFAULT;
#else
  constexpr int present = MCL_CURRENT;
#endif
  const std::string way_out =
      "; give the program CAP_IPC_LOCK, or its user an unlimited memlock limit";
  const auto limit = memory_lock_limit();
  if (mlockall(limit ? present : present | MCL_FUTURE) != 0) {
    return "the program's memory is not locked (" + reason(errno) +
           "): a page that the system took away costs milliseconds" + way_out;
  }
  if (limit) {
    return "only the memory that the program had at its start is locked, because its limit is " +
           std::to_string(*limit / 1'048'576) + " MiB" + way_out;
  }
  return std::nullopt;
}

std::vector<int> usable_cpus() {
  cpu_set_t usable;
  CPU_ZERO(&usable);
  sched_getaffinity(0, sizeof usable, &usable);
  std::vector<int> cpus;
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (CPU_ISSET(static_cast<std::size_t>(cpu), &usable)) {
      cpus.push_back(cpu);
    }
  }
  return cpus;
}

}  // namespace flyball
