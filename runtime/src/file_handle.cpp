// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/file_handle.h"

#include <cerrno>
#include <chrono>
#include <system_error>

#include <poll.h>
#include <unistd.h>

namespace flyball {
namespace {

ErrorCode code_of(int number) {
  switch (number) {
    case ENOENT:
    case ENOTDIR:
    case ENODEV:
    case ESRCH:
      return ErrorCode::not_found;
    case EACCES:
    case EPERM:
    case EROFS:
      return ErrorCode::unavailable;
    case EINVAL:
      return ErrorCode::invalid_input;
    default:
      return ErrorCode::failed;
  }
}

}  // namespace

FileHandle::~FileHandle() {
  if (is_open()) {
    close(number_);
  }
}

Duration FileHandle::wait(Duration at_most) const {
  const auto begun = std::chrono::steady_clock::now();
  pollfd wanted{number_, POLLIN, 0};
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(at_most).count();
  (void)poll(&wanted, 1, static_cast<int>(ms));  // A signal ends it early, as it should.
  return std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now() - begun);
}

Error system_error(const std::string& what, int number) {
  return {code_of(number), what + ": " + std::system_category().message(number)};
}

}  // namespace flyball
