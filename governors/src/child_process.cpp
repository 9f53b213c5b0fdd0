// SPDX-License-Identifier: BSD-3-Clause
#include "child_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace flyball {
namespace {

/// Private memory of this process now; 0 when the system does not say.
std::size_t own_memory_bytes() {
  unsigned long pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    // size resident shared text lib data dt (proc(5))
    if (std::fscanf(file, "%*u %*u %*u %*u %*u %lu", &pages) != 1) {  // NOLINT(cert-err34-c)
      pages = 0;
    }
    std::fclose(file);
  }
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

void limit_memory(std::size_t bytes) {
  const rlim_t limit = own_memory_bytes() + bytes;
  const rlimit both{limit, limit};
  // RLIMIT_DATA, not RLIMIT_AS: sanitizers reserve terabytes of addresses.
  setrlimit(RLIMIT_DATA, &both);
}

void settle_in(pid_t parent, std::size_t memory_bytes) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) {  // It ended before that line.
    _exit(0);
  }
  std::signal(SIGINT, SIG_IGN);
  // Crashes are the parent's to report; nobody wants a core file of each.
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  limit_memory(memory_bytes);
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
  int ready = -1;
  do {
    ready = poll(&waiting, 1, milliseconds(limit));
  } while (ready < 0 && errno == EINTR);
  if (ready == 0) {
    return Received::late;
  }
  ssize_t got = -1;
  do {
    got = recv(descriptor_, packet, size, 0);
  } while (got < 0 && errno == EINTR);
  return got > 0 ? Received::packet : Received::ended;
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
    close(ends[0]);
    settle_in(parent, memory_bytes);
    work(PacketSocket{ends[1]});
    _exit(0);  // Not exit: what the parent registered to happen at its end is not ours.
  }
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    return Error{ErrorCode::failed, std::string{"no process for a policy: "} +
                                        std::strerror(errno)};  // NOLINT(concurrency-mt-unsafe)
  }
  return std::make_unique<ChildProcess>(child, ends[0]);
}

std::string ChildProcess::end() {
  if (id_ == 0) {
    return how_;
  }
  int status = 0;
  close(socket_.descriptor());  // Who listens hears the end, ...
  kill(id_, SIGKILL);           // ... who does not is ended; one that has ended keeps its reason.
  waitpid(id_, &status, 0);
  id_ = 0;
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    const char* name = strsignal(signal);  // NOLINT(concurrency-mt-unsafe): one thread forks
    how_ = "was ended by signal " + std::to_string(signal) + " (" + name + ")";
  } else {
    how_ = "ended by itself with exit code " + std::to_string(WEXITSTATUS(status));
  }
  return how_;
}

ChildProcess::~ChildProcess() {
  end();
}

}  // namespace flyball
