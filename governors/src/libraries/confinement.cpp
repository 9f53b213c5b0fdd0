// SPDX-License-Identifier: BSD-3-Clause
#include "confinement.h"

#include "system_calls.h"
#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace flyball {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t architecture = 0;  // Numbers of calls differ: there is no filter for it.
#endif

/// What a process that was ended had asked for, and its exit code.
enum Request : int { other = 200, file, network, process, shared_memory };

template <class Calls>
bool has(const Calls& calls, int call) {
  for (const int one : calls) {
    if (one == call) {
      return true;
    }
  }
  return false;
}

/// Runs in the process that asked.
void end_with_request(int /*signal*/, siginfo_t* told, void* /*context*/) {
  const int call = told->si_syscall;
  _exit(has(reaches_for_file, call) || has(looks_at_files, call) ? Request::file
        : has(reaches_for_network, call)                         ? Request::network
        : has(reaches_for_process, call)                         ? Request::process
        : has(reaches_for_memory, call)                          ? Request::shared_memory
                                                                 : Request::other);
}

/// A program for the kernel: for each call its own branch, which returns.
class Filter {
 public:
  Filter() {
    load(offsetof(seccomp_data, arch));
    add(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0);
    answer(SECCOMP_RET_KILL_PROCESS);
    load(offsetof(seccomp_data, nr));
  }

  template <class Calls>
  void allow(const Calls& calls) {
    for (const int call : calls) {
      only_for(call, 1);
      answer(SECCOMP_RET_ALLOW);
    }
  }
  void refuse(int call, std::uint32_t code) {
    only_for(call, 1);
    answer(SECCOMP_RET_ERRNO | code);
  }
  /// When (argument & mask) == value.
  void allow_if(int call, int argument, std::uint32_t mask, std::uint32_t value) {
    only_for(call, 5);
    load_argument(argument);
    add(BPF_ALU | BPF_AND | BPF_K, mask);
    decide(value, SECCOMP_RET_ALLOW, SECCOMP_RET_TRAP);
  }
  /// When an argument is a null pointer.
  void allow_if_null(int call, int argument) {
    only_for(call, 7);
    load_argument(argument);
    add(BPF_JMP | BPF_JEQ | BPF_K, 0, 1, 0);
    answer(SECCOMP_RET_TRAP);
    load_argument(argument, sizeof(std::uint32_t));
    decide(0, SECCOMP_RET_ALLOW, SECCOMP_RET_TRAP);
  }
  /// When an argument is one of a few values.
  template <class Values>
  void allow_values(int call, int argument, const Values& values) {
    decide_among(call, argument, values, SECCOMP_RET_ALLOW, SECCOMP_RET_TRAP);
  }
  /// When an argument is none of them.
  template <class Values>
  void allow_but_values(int call, int argument, const Values& values) {
    decide_among(call, argument, values, SECCOMP_RET_TRAP, SECCOMP_RET_ALLOW);
  }

  /// False with `errno` set.
  bool install() {
    answer(SECCOMP_RET_TRAP);
    sock_fprog program{static_cast<unsigned short>(lines_.size()), lines_.data()};
    return syscall(__NR_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &program) == 0;
  }

 private:
  void add(int code, std::uint32_t value, std::uint8_t if_true = 0, std::uint8_t if_false = 0) {
    lines_.push_back({static_cast<std::uint16_t>(code), if_true, if_false, value});
  }
  void load(std::size_t offset) {
    add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
  }
  /// The lower half of it, on a processor that stores that first.
  void load_argument(int argument, std::size_t half = 0) {
    load(offsetof(seccomp_data, args) + half +
         sizeof(std::uint64_t) * static_cast<unsigned>(argument));
  }
  void only_for(int call, std::uint8_t lines) {
    add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, lines);
  }
  void answer(std::uint32_t what) { add(BPF_RET | BPF_K, what); }
  template <class Values>
  void decide_among(
      int call, int argument, const Values& values, std::uint32_t if_one, std::uint32_t otherwise) {
    only_for(call, static_cast<std::uint8_t>(2 + 2 * values.size()));
    load_argument(argument);
    for (const std::uint32_t value : values) {
      add(BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1);
      answer(if_one);
    }
    answer(otherwise);
  }
  void decide(std::uint32_t value, std::uint32_t if_equal, std::uint32_t otherwise) {
    add(BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1);
    answer(if_equal);
    answer(otherwise);
  }

  std::vector<sock_filter> lines_{};
};

void add_own_affairs(Filter& filter) {
  filter.allow(allowed);
  constexpr std::uint32_t kind_of_mapping = 0x0f;
  filter.allow_if(__NR_mmap, 3, kind_of_mapping, MAP_PRIVATE);
  constexpr std::uint32_t thread = 0x00010000;  // CLONE_THREAD of sched.h, which wants _GNU_SOURCE.
  filter.allow_if(__NR_clone, 0, thread, thread);
#ifdef __NR_clone3
  filter.refuse(__NR_clone3, ENOSYS);  // Its flags lie in memory; the C library then uses clone.
#endif
  filter.allow_values(__NR_tgkill, 0, std::array{static_cast<std::uint32_t>(getpid())});
  filter.allow_but_values(__NR_rt_sigaction, 0,
                          std::array<std::uint32_t, 2>{SIGSYS, parent_ended_signal});
  constexpr std::uint32_t name_of_mapping = 0x53564d41;  // PR_SET_VMA
  filter.allow_values(__NR_prctl, 0,
                      std::array<std::uint32_t, 3>{PR_SET_NAME, PR_GET_NAME, name_of_mapping});
  filter.allow_values(
      __NR_fcntl, 1,
      std::array<std::uint32_t, 6>{F_DUPFD, F_GETFD, F_SETFD, F_GETFL, F_SETFL, F_DUPFD_CLOEXEC});
  filter.allow_if_null(__NR_prlimit64, 2);       // Reads a limit.
  constexpr std::uint32_t is_terminal = 0x5401;  // TCGETS
  filter.allow_values(__NR_ioctl, 1, std::array{is_terminal});
}

void add_reading(Filter& filter) {
  constexpr std::uint32_t changes = O_ACCMODE | O_CREAT | O_TRUNC;
  filter.allow(looks_at_files);
  filter.allow_if(__NR_openat, 2, changes, O_RDONLY);
#ifdef __x86_64__
  filter.allow_if(__NR_open, 1, changes, O_RDONLY);
#endif
}

// A sanitizer's runtime asks the system for what a policy may not have.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif

}  // namespace

Confined confine(Confinement how) noexcept {
  if (is_sanitized || architecture == 0) {
    return Confined::no_seccomp;
  }
  if (how == Confinement::loading) {
    struct sigaction act {};
    act.sa_sigaction = end_with_request;
    act.sa_flags = SA_SIGINFO;
    sigaction(SIGSYS, &act, nullptr);
  }
  Filter filter;
  add_own_affairs(filter);
  if (how == Confinement::loading) {
    add_reading(filter);
  }
  if (filter.install()) {
    return Confined::yes;
  }
  // The kernel was built without system call filters, or without any seccomp.
  return errno == EINVAL || errno == ENOSYS ? Confined::no_seccomp : Confined::failed;
}

std::optional<std::string> forbidden_request(int exit_code) {
  switch (exit_code) {
    case Request::file:
      return "reached for a file, which a policy may only read, and only until it has started";
    case Request::network:
      return "reached for the network, which a policy may not use";
    case Request::process:
      return "reached for another process, which a policy may not";
    case Request::shared_memory:
      return "reached for shared memory, which a policy may not have";
    case Request::other:
      return any_forbidden_request();
    default:
      return std::nullopt;
  }
}

std::string any_forbidden_request() {
  return "asked the system for what a policy may not have";
}

}  // namespace flyball
