// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/program.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace flyball {
namespace {

constexpr const char* itself = "/proc/self/exe";

}  // namespace

std::string program_to_start() {
  // Read before any thread is started.
  const char* launcher = std::getenv("FLYBALL_PROGRAM");  // NOLINT(concurrency-mt-unsafe)
  return launcher != nullptr && *launcher != '\0' ? launcher : itself;
}

std::string program_file() {
  const std::string program = program_to_start();
  std::error_code failed;
  return program == itself ? std::filesystem::read_symlink(itself, failed).string() : program;
}

}  // namespace flyball
