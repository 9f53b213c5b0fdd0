// SPDX-License-Identifier: BSD-3-Clause
#include "board/watchdog.h"

#include "flyball/runtime/board/linux_system.h"
#include "flyball/runtime/file_handle.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace flyball {
namespace {

/// Kernels before 5.9, and C libraries of their time, close no ranges: there each file by itself.
void close_range_of(int first, int last) {
#ifdef SYS_close_range
  if (syscall(SYS_close_range, first, last, 0) == 0) {
    return;
  }
#endif
  rlimit files{};
  getrlimit(RLIMIT_NOFILE, &files);
  const rlim_t end = std::min(files.rlim_cur, static_cast<rlim_t>(last) + 1);
  for (int file = first; static_cast<rlim_t>(file) < end; ++file) {
    close(file);
  }
}

/// A socket or pipe of the program that stayed open here would seem to its peer as if the program
/// still ran.
void close_all_but(std::vector<int> kept) {
  std::sort(kept.begin(), kept.end());
  int first = 3;  // Behind standard input, output and error.
  for (const int file : kept) {
    if (file > first) {
      close_range_of(first, file - 1);
    }
    first = std::max(first, file + 1);
  }
  constexpr int last = 1 << 20;  // fs.nr_open, the most that a process may have, by default
  close_range_of(first, last);
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int standard : {0, 1, 2}) {
    dup2(nowhere, standard);
  }
}

int descriptor_of_process([[maybe_unused]] pid_t process) {
#ifdef SYS_pidfd_open
  return static_cast<int>(syscall(SYS_pidfd_open, process, 0));
#else
  return -1;
#endif
}

/// Until the socket's other end is closed, or the process has ended though somebody whom it forked
/// keeps that end open.
void wait_for_end(int socket, pid_t watched) {
  const int ended = descriptor_of_process(watched);
  // Kernels before 5.3 cannot wait for a process that is no child: there it is looked for.
  const int period_ms = ended < 0 ? 100 : -1;
  std::array<pollfd, 2> both{pollfd{socket, POLLIN, 0}, pollfd{ended, POLLIN, 0}};
  while (getppid() == watched) {
    const int count = poll(both.data(), ended < 0 ? 1 : 2, period_ms);
    if (count > 0) {
      return;
    }
  }
}

void watch(int socket, pid_t watched, std::vector<int> kept) {
  setsid();
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT}) {
    std::signal(number, SIG_IGN);
  }
  prctl(PR_SET_NAME, "flyball-restore");
  const sched_param none{};
  sched_setscheduler(0, SCHED_OTHER, &none);  // The program's priority is not for this one.
  kept.push_back(socket);
  close_all_but(std::move(kept));
  const char ready = 1;
  if (write(socket, &ready, 1) == 1) {
    wait_for_end(socket, watched);
  }
}

}  // namespace

int above_standard(int file) {
  if (file < 0 || file > STDERR_FILENO) {
    return file;
  }
  const int moved = fcntl(file, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  const int number = errno;
  close(file);
  errno = number;
  return moved;
}

Result<Watchdog> Watchdog::start(std::vector<int> kept, const std::function<void()>& work) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return system_error("no socket for the process that restores a board's settings", errno);
  }
  for (int& end : ends) {
    end = above_standard(end);
  }
  const pid_t self = getpid();
  const pid_t process = fork();
  if (process == 0) {
    close(ends[0]);
    watch(ends[1], self, std::move(kept));
    work();
    _exit(0);
  }
  const int number = errno;
  close(ends[1]);
  if (process < 0) {
    close(ends[0]);
    return system_error("no process to restore a board's settings", number);
  }
  Watchdog watchdog{ends[0], process};
  char ready = 0;
  ssize_t count = -1;
  do {
    count = read(ends[0], &ready, 1);
  } while (count < 0 && errno == EINTR);
  if (count != 1) {
    return Error{ErrorCode::failed,
                 "the process that restores a board's settings has ended at its start"};
  }
  return watchdog;
}

Watchdog::Watchdog(int socket, pid_t process)
    : socket_{socket}, process_{process}, owner_{getpid()} {}

Watchdog::Watchdog(Watchdog&& other) noexcept
    : socket_{std::exchange(other.socket_, -1)},
      process_{std::exchange(other.process_, -1)},
      owner_{other.owner_} {}

Watchdog& Watchdog::operator=(Watchdog&& other) noexcept {
  std::swap(socket_, other.socket_);
  std::swap(process_, other.process_);
  std::swap(owner_, other.owner_);
  return *this;
}

Watchdog::~Watchdog() {
  if (owner_ == getpid()) {
    end();
  }
}

bool Watchdog::is_alive() {
  if (process_ < 0) {
    return false;
  }
  if (waitpid(process_, nullptr, WNOHANG) == process_) {
    process_ = -1;
  }
  return process_ >= 0;
}

void Watchdog::end() {
  if (socket_ >= 0) {
    shutdown(socket_, SHUT_RDWR);  // Also where a child of this process has a copy of it.
    close(std::exchange(socket_, -1));
  }
  while (process_ >= 0 && waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
}

}  // namespace flyball
