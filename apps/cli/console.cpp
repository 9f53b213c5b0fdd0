// SPDX-License-Identifier: BSD-3-Clause

#include "console.h"

#include <csignal>
#include <cstdio>

#include <unistd.h>

namespace flyball {
namespace {

// A signal handler has nowhere else to leave its word.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
volatile std::sig_atomic_t interrupted = 0;

void remember(int signal) {
  if (interrupted != 0) {  // The second one has its usual effect.
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  interrupted = signal;
}

}  // namespace

void print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

void note(const std::string& line) {
  const std::string text = line + "\n";
  std::fwrite(text.data(), 1, text.size(), stderr);
}

int refuse(const std::vector<Error>& errors) {
  for (const Error& error : errors) {
    note("flyball: " + error.message);
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

bool was_interrupted() {
  return interrupted != 0;
}

int interrupted_exit_code() {
  return exit_by_signal + interrupted;
}

}  // namespace flyball
