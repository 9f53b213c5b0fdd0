// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Two commands that fly into one folder would remove each other's records. The second one waits,
/// and then finds what the first one has flown.

#include "flyball/runtime/result.h"

#include <string>
#include <vector>

namespace flyball {

/// A folder that this process alone flies into, until the object or the process ends.
class ClaimedFolder {
 public:
  /// Makes the folder where it is missing. Waits, and says so, while another process has it.
  /// @error Those of `prepare_folder`; `unavailable` when it was interrupted while it waited.
  static Result<ClaimedFolder> claim(const std::string& path);
  ClaimedFolder(ClaimedFolder&& other) noexcept;
  ClaimedFolder& operator=(ClaimedFolder&&) = delete;
  ClaimedFolder(const ClaimedFolder&) = delete;
  ClaimedFolder& operator=(const ClaimedFolder&) = delete;
  ~ClaimedFolder();

  /// The folders that had to be made, outermost first.
  [[nodiscard]] const std::vector<std::string>& made() const { return made_; }

 private:
  ClaimedFolder(int descriptor, std::vector<std::string> made);

  int descriptor_;  ///< Of the folder; -1: handed on.
  std::vector<std::string> made_;
};

}  // namespace flyball
