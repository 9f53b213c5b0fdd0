// SPDX-License-Identifier: BSD-3-Clause

#include "console.h"

#include "flyball/runtime/text/printable.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

namespace flyball {
namespace {

// A signal handler can only set a global variable.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
volatile std::sig_atomic_t interrupted = 0;

// Standard output is the process's, and so is what became of it: the `errno` of the first result
// that could not be written; 0: all could.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
int output_error = 0;

// When that was, in milliseconds that begin again after 24 days.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
volatile std::sig_atomic_t interrupted_ms = 0;

constexpr std::string_view program_name = "flyball: ";

constexpr unsigned wrapped_ms = 0x7fffffff;

int now_ms() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);  // One of the few calls that a handler may make.
  const auto ms = static_cast<std::uint64_t>(now.tv_sec) * 1000 +
                  static_cast<std::uint64_t>(now.tv_nsec) / 1000000;
  return static_cast<int>(ms & wrapped_ms);
}

// A second signal has its usual effect, unless it means the first one: a terminal that closes and
// its shell both send SIGHUP, within milliseconds, and a flight has to land and to keep its record.
void remember(int signal) {
  constexpr unsigned same_wish_ms = 1000;
  const unsigned since_ms = static_cast<unsigned>(now_ms() - interrupted_ms) & wrapped_ms;
  if (interrupted == 0) {
    interrupted = signal;
    interrupted_ms = now_ms();
  } else if (since_ms >= same_wish_ms) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

// Names, reasons and descriptions come from files and plug-ins, which must not steer the terminal.
constexpr const char* layout = "\n\t";

void print(const std::string& given) {
  const std::string text = printable(given, layout);
  const bool is_written =
      std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
  if (!is_written && output_error == 0) {
    output_error = errno;
  }
}

int exit_code_with_output(int exit_code) {
  if (output_error == 0) {
    return exit_code;
  }
  remark(std::string{"cannot write the result to standard output: "} +
         std::strerror(output_error) +  // NOLINT(concurrency-mt-unsafe): one thread prints
         "; send it to another place");
  return std::max(exit_code, exit_bad_input);
}

void open_standard_files() {
  for (int file = open("/dev/null", O_RDWR); file >= 0; file = open("/dev/null", O_RDWR)) {
    if (file > STDERR_FILENO) {
      close(file);
      return;
    }
    if (file == STDOUT_FILENO) {  // Results that nobody can read are not written.
      output_error = EBADF;
    }
  }
}

void note(const std::string& line) {
  const std::string text = printable(line, layout) + "\n";
  std::fwrite(text.data(), 1, text.size(), stderr);
}

void remark(const std::string& sentence) {
  note(std::string{program_name} + sentence);
}

std::string remarked(const std::string& lines) {
  const std::size_t begin = lines.rfind(program_name, 0) == 0 ? program_name.size() : 0;
  return lines.substr(begin, lines.find_last_not_of('\n') + 1 - begin);
}

int refuse(const std::vector<Error>& errors) {
  for (const Error& error : errors) {
    remark(error.message);
  }
  return exit_bad_input;
}

bool has_watcher() {
  return isatty(STDERR_FILENO) != 0;
}

void catch_interrupt() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) {  // As nohup leaves it.
      action = {};
      action.sa_handler = remember;
      sigaction(signal, &action, nullptr);
    }
  }
}

bool release_interrupt() {
  bool was_caught = false;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler == remember) {
      std::signal(signal, SIG_DFL);
      was_caught = true;
    }
  }
  return was_caught;
}

bool was_interrupted() {
  return interrupted != 0;
}

int interrupted_exit_code() {
  return exit_by_signal + interrupted;
}

}  // namespace flyball
