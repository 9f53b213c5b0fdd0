// SPDX-License-Identifier: BSD-3-Clause

#include "console.h"

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdio>

#include <unistd.h>

namespace flyball {
namespace {

// A signal handler has nowhere else to leave its word.
volatile std::sig_atomic_t interrupted =
    0;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void remember(int) {
  interrupted = 1;
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
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESETHAND;  // The second one has its usual effect.
  sigaction(SIGINT, &action, nullptr);
}

bool was_interrupted() {
  return interrupted != 0;
}

std::string aligned(const std::vector<std::vector<std::string>>& lines) {
  std::vector<std::size_t> widths;
  for (const auto& line : lines) {
    widths.resize(std::max(widths.size(), line.size()));
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      widths[i] = std::max(widths[i], line[i].size());
    }
  }
  std::string text;
  for (const auto& line : lines) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      text += line[i] + std::string(widths[i] - line[i].size() + 2, ' ');
    }
    text += (line.empty() ? "" : line.back()) + "\n";
  }
  return text;
}

}  // namespace flyball
