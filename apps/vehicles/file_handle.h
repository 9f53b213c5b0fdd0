// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A file descriptor that is closed when it goes.

#include "flyball/runtime/result.h"
#include "flyball/runtime/time.h"

#include <string>

namespace flyball {

class FileHandle {
 public:
  explicit FileHandle(int number) : number_{number} {}
  ~FileHandle();
  FileHandle(const FileHandle&) = delete;
  FileHandle& operator=(const FileHandle&) = delete;

  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] bool is_open() const { return number_ >= 0; }
  /// Until it can be read from, or `at_most` has passed. Returns how long that took.
  [[nodiscard]] Duration wait(Duration at_most) const;

 private:
  int number_;
};

/// `what` and the system's own words for `errno`.
[[nodiscard]] Error system_error(const std::string& what);

}  // namespace flyball
