// SPDX-License-Identifier: BSD-3-Clause
#include "world/import_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace flyball {
namespace {

// What the process sends: its verdict, the number of bytes that follow, and those bytes.
enum class Verdict : std::uint64_t { good = 1, not_found, invalid_input, failed, out_of_memory };
struct AnswerHeader {
  Verdict verdict{Verdict::failed};
  std::uint64_t bytes{};
};

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

void limit(int resource, rlim_t soft, rlim_t hard) {
  const rlimit both{soft, hard};
  setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

void settle_in(pid_t parent, const ImportLimits& limits) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) {  // It ended before that line.
    _exit(0);
  }
  for (const int signal : {SIGABRT, SIGXCPU, SIGALRM}) {
    std::signal(signal, SIG_DFL);
  }
  limit(RLIMIT_CORE, 0, 0);  // The parent reports a crash, so no core file is needed.
  limit(RLIMIT_CPU, limits.processor_s, limits.processor_s + 1);
  // RLIMIT_DATA, not RLIMIT_AS: sanitizers reserve terabytes of addresses.
  const rlim_t memory = own_memory_bytes() + limits.memory_bytes;
  limit(RLIMIT_DATA, memory, memory);
  alarm(20 * limits.processor_s);  // Ends a process that waits, of which no limit above knows.
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
}

bool write_all(int to, const void* from, std::size_t bytes) {
  const char* at = static_cast<const char*>(from);
  while (bytes > 0) {
    const ssize_t written = write(to, at, bytes);
    if (written < 0 && errno != EINTR) {
      return false;
    }
    at += written > 0 ? written : 0;
    bytes -= written > 0 ? static_cast<std::size_t>(written) : 0;
  }
  return true;
}

void send(int to, Verdict verdict, const std::string& content) {
  const AnswerHeader header{verdict, content.size()};
  (void)(write_all(to, &header, sizeof header) && write_all(to, content.data(), content.size()));
}

Verdict verdict_of(ErrorCode code) {
  return code == ErrorCode::not_found       ? Verdict::not_found
         : code == ErrorCode::invalid_input ? Verdict::invalid_input
                                            : Verdict::failed;
}

void answer(int to, const std::function<Result<std::string>()>& work) {
  try {
    const auto result = work();
    result ? send(to, Verdict::good, *result)
           : send(to, verdict_of(result.error().code), result.error().message);
  } catch (const std::bad_alloc&) {
    send(to, Verdict::out_of_memory, {});
  } catch (const std::exception& error) {
    send(to, Verdict::invalid_input, std::string{"is damaged: "} + error.what());
  }
}

/// All that comes until the process closes its end.
std::string received(int from) {
  std::string content;
  std::array<char, 65536> piece{};
  while (true) {
    const ssize_t got = read(from, piece.data(), piece.size());
    if (got > 0) {
      content.append(piece.data(), static_cast<std::size_t>(got));
    } else if (got == 0 || errno != EINTR) {
      return content;
    }
  }
}

Error too_much_memory(const ImportLimits& limits) {
  return {ErrorCode::invalid_input, "needs more than " +
                                        std::to_string(limits.memory_bytes >> 20U) +
                                        " MB to be read; it is damaged or too large"};
}

/// The process ended before it had said all.
Error broken_off(int status, const ImportLimits& limits) {
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGXCPU || signal == SIGALRM || signal == SIGKILL) {
    return {ErrorCode::invalid_input, "takes more than " + std::to_string(limits.processor_s) +
                                          " s to be read; it is damaged or too large"};
  }
  // NOLINTNEXTLINE(concurrency-mt-unsafe): one thread forks
  const char* name = strsignal(signal);
  const std::string how = signal != 0
                              ? "was ended by signal " + std::to_string(signal) + " (" + name + ")"
                              : "ended with exit code " + std::to_string(WEXITSTATUS(status));
  return {ErrorCode::invalid_input, "is damaged: the library that reads it " + how};
}

Result<std::string> judged(std::string content, int status, const ImportLimits& limits) {
  AnswerHeader header;
  if (content.size() < sizeof header) {
    return broken_off(status, limits);
  }
  std::memcpy(&header, content.data(), sizeof header);
  content.erase(0, sizeof header);
  if (header.bytes != content.size()) {
    return broken_off(status, limits);
  }
  switch (header.verdict) {
    case Verdict::good:
      return content;
    case Verdict::not_found:
      return Error{ErrorCode::not_found, content};
    case Verdict::failed:
      return Error{ErrorCode::failed, content};
    case Verdict::out_of_memory:
      return too_much_memory(limits);
    default:
      return Error{ErrorCode::invalid_input, content};
  }
}

Error no_process(const char* what) {
  return {ErrorCode::failed, std::string{"cannot be read: no "} + what + ": " +
                                 std::strerror(errno)};  // NOLINT(concurrency-mt-unsafe)
}

}  // namespace

ImportLimits import_limits(std::size_t file_bytes, unsigned processor_s) {
  // Measured on one core of an AMD EPYC (Zen 4) with an OBJ file of 79 MB: Assimp reads 7e7 bytes a
  // second and holds 5 times the file's size.
  constexpr std::size_t bytes_per_s = 4'000'000;
  constexpr std::size_t copies = 32;
  constexpr std::size_t base_bytes = std::size_t{2} << 30U;
  const std::size_t believed = std::min(file_bytes, std::size_t{1} << 40U);
  return {processor_s + static_cast<unsigned>(believed / bytes_per_s),
          base_bytes + copies * believed};
}

Result<std::string> read_in_process(const ImportLimits& limits,
                                    const std::function<Result<std::string>()>& work) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    return no_process("pipe");
  }
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    settle_in(parent, limits);
    answer(ends[1], work);
    _exit(0);  // Not exit: what the parent registered to happen at its end is not ours.
  }
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    return no_process("process");
  }
  std::string content = received(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return judged(std::move(content), status, limits);
}

}  // namespace flyball
