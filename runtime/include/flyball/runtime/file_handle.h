// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A file descriptor that is closed when it goes, and what the system says when it gives none.

#include "flyball/runtime/result.h"
#include "flyball/runtime/time.h"

#include <string>

namespace flyball {

class FileHandle {
 public:
  /// @param number  What `open` or `socket` returned; below zero: nothing was opened.
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

/// `what`, and the system's own words for an errno; the code is what that means to whoever reads or
/// writes a file: `not_found`, `unavailable` (not permitted, or read-only), `invalid_input`
/// (EINVAL), or `failed`.
[[nodiscard]] Error system_error(const std::string& what, int number);

}  // namespace flyball
