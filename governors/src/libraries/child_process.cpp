// SPDX-License-Identifier: BSD-3-Clause
#include "child_process.h"

#include "confinement.h"
#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace flyball {
namespace {

struct MemoryInUse {
  std::size_t addresses{};
  std::size_t own{};  ///< Not shared with others, nor read from a file.
};

/// Of this process now; zeros when the system does not say.
MemoryInUse memory_in_use() {
  unsigned long size = 0;
  unsigned long data = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    // size resident shared text lib data dt (proc(5))
    // NOLINTNEXTLINE(cert-err34-c)
    if (std::fscanf(file, "%lu %*u %*u %*u %*u %lu", &size, &data) != 2) {
      size = data = 0;
    }
    std::fclose(file);
  }
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return {size * page, data * page};
}

void set_limit(int what, rlim_t limit) {
  const rlimit both{limit, limit};
  setrlimit(static_cast<__rlimit_resource_t>(what), &both);
}

void limit_memory(std::size_t bytes) {
  const MemoryInUse now = memory_in_use();
  set_limit(RLIMIT_DATA, now.own + bytes);
  // Shared memory counts here only. A sanitizer reserves terabytes and needs more now and then.
  constexpr std::size_t reserved_by_sanitizer = std::size_t{1} << 40U;
  if (now.addresses < reserved_by_sanitizer) {
    set_limit(RLIMIT_AS, now.addresses + bytes);
  }
}

constexpr int first_own = 3;  // Behind standard input, output and error.

/// Kernels before 5.9 close no ranges: there each file is closed by itself.
void close_own_but(int kept) {
  if (syscall(__NR_close_range, first_own, kept - 1, 0) == 0 &&
      syscall(__NR_close_range, kept + 1, ~0U, 0) == 0) {
    return;
  }
  rlimit files{};
  getrlimit(RLIMIT_NOFILE, &files);
  for (int other = first_own; other < static_cast<int>(files.rlim_cur); ++other) {
    if (other != kept) {
      close(other);
    }
  }
}

/// Standard input, output and error lead nowhere; of the rest only the socket stays open.
int keep_only(int socket) {
  const int kept = fcntl(socket, F_DUPFD_CLOEXEC, first_own);  // The others are overwritten now.
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  for (int standard = 0; standard < first_own; ++standard) {
    dup2(nowhere, standard);
  }
  close_own_but(kept);
  return kept;
}

// Of the process that this one was forked from.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a signal handler sees no more
pid_t parent_id = 0;

/// The kernel sends the signal when the thread that forked ends, too.
void end_with_parent(int /*signal*/) {
  if (getppid() != parent_id) {
    _exit(0);
  }
}

void follow_parent(pid_t parent) {
  parent_id = parent;
  struct sigaction act {};
  act.sa_handler = end_with_parent;
  sigaction(parent_ended_signal, &act, nullptr);
  sigset_t one;
  sigemptyset(&one);
  sigaddset(&one, parent_ended_signal);
  // The thread that forked may have blocked it. pthread_sigmask would need glibc 2.32.
  sigprocmask(SIG_UNBLOCK, &one, nullptr);  // NOLINT(concurrency-mt-unsafe): one thread
  prctl(PR_SET_PDEATHSIG, parent_ended_signal);
  end_with_parent(0);  // It may have ended before that line.
}

/// Returns the socket's new number.
int settle_in(pid_t parent, int socket, std::size_t memory_bytes) {
  follow_parent(parent);
  setpgid(0, 0);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  std::signal(SIGINT, SIG_IGN);
  const int kept = keep_only(socket);
  // The parent reports crashes, so no core file is needed.
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_FSIZE, 0);
  constexpr rlim_t most_files = 64;
  set_limit(RLIMIT_NOFILE, most_files);
  limit_memory(memory_bytes);
  return kept;
}

int milliseconds(Duration limit) {
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(limit).count();
  return limit.count() < 0 ? -1 : static_cast<int>(std::max<std::int64_t>(1, ms));
}

}  // namespace

bool PacketSocket::send(const void* packet, std::size_t size) const noexcept {
  ssize_t sent = -1;
  do {
    sent = ::send(descriptor_, packet, size, MSG_NOSIGNAL);
  } while (sent < 0 && errno == EINTR);
  return sent == static_cast<ssize_t>(size);
}

PacketSocket::Received PacketSocket::receive(void* packet,
                                             std::size_t size,
                                             Duration limit) const noexcept {
  pollfd waiting{descriptor_, POLLIN, 0};
  const bool has_end = limit.count() >= 0;
  const HostTime until = HostTime::clock::now() + std::max(limit, Duration{0});
  Duration left = limit;
  int ready = poll(&waiting, 1, milliseconds(left));
  while (ready < 0 && errno == EINTR && (!has_end || left.count() > 0)) {
    left = has_end ? std::max<Duration>(until - HostTime::clock::now(), Duration{0}) : limit;
    ready = poll(&waiting, 1, milliseconds(left));
  }
  if (ready == 0 || (ready < 0 && errno == EINTR)) {
    return Received::late;
  }
  ssize_t got = -1;
  do {
    got = recv(descriptor_, packet, size, MSG_TRUNC);  // Says how long it was.
  } while (got < 0 && errno == EINTR);
  return got <= 0                            ? Received::ended
         : got == static_cast<ssize_t>(size) ? Received::packet
                                             : Received::of_other_size;
}

Result<std::unique_ptr<ChildProcess>> ChildProcess::fork(
    std::size_t memory_bytes, const std::function<void(const PacketSocket&)>& work) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return Error{ErrorCode::failed, std::string{"no socket for a policy's process: "} +
                                        std::strerror(errno)};  // NOLINT(concurrency-mt-unsafe)
  }
  const pid_t parent = getpid();
  const pid_t child = ::fork();
  if (child == 0) {
    work(PacketSocket{settle_in(parent, ends[1], memory_bytes)});
    _exit(0);  // Not exit: what the parent registered to happen at its end is not ours.
  }
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    return Error{ErrorCode::failed, std::string{"no process for a policy: "} +
                                        std::strerror(errno)};  // NOLINT(concurrency-mt-unsafe)
  }
  setpgid(child, child);  // Parent and child both do it, because either may come first.
  return std::make_unique<ChildProcess>(child, ends[0]);
}

std::string ChildProcess::end() {
  if (id_ == 0) {
    return how_;
  }
  int status = 0;
  close(socket_.descriptor());  // Who listens hears the end, ...
  kill(id_, SIGKILL);           // ... who does not is ended; one that has ended keeps its reason.
  kill(-id_, SIGKILL);          // Its children, while its number cannot be another one's.
  pid_t waited = -1;
  do {
    waited = waitpid(id_, &status, 0);
  } while (waited < 0 && errno == EINTR);
  id_ = 0;
  if (waited < 0) {  // Who ignores SIGCHLD, or waits for any child, has taken it away.
    how_ = "ended, but this program's other parts kept how";
  } else if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    const char* name = strsignal(signal);  // NOLINT(concurrency-mt-unsafe): one thread forks
    // A forbidden request while the signal that tells it was blocked.
    how_ = signal == SIGSYS ? "was ended because it " + any_forbidden_request()
                            : "was ended by signal " + std::to_string(signal) + " (" + name + ")";
  } else {
    const int code = WEXITSTATUS(status);
    const auto request = forbidden_request(code);
    how_ = request ? "was ended because it " + *request
                   : "ended by itself with exit code " + std::to_string(code);
  }
  return how_;
}

ChildProcess::~ChildProcess() {
  end();
}

}  // namespace flyball
