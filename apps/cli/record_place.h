// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <system_error>

namespace flyball {

/// Where a record is written: what was there before is back when nothing flies. Leaves a device or
/// a pipe where it is.
class RecordPlace {
 public:
  explicit RecordPlace(const std::string& path) {
    std::error_code failed;
    path_ = std::filesystem::weakly_canonical(std::filesystem::absolute(path, failed),
                                              failed);  // What a link names.
    if (std::filesystem::is_regular_file(path_, failed)) {
      before_ = unused_beside(path_);
      std::filesystem::rename(path_, before_, failed);
      has_before_ = !failed;
    }
  }
  RecordPlace(const RecordPlace&) = delete;
  RecordPlace& operator=(const RecordPlace&) = delete;
  ~RecordPlace() {
    std::error_code ignored;
    if (!has_flown_ && std::filesystem::is_regular_file(path_, ignored)) {
      std::filesystem::remove(path_, ignored);
    }
    if (has_before_ && has_flown_) {
      std::filesystem::remove(before_, ignored);
    } else if (has_before_) {
      std::filesystem::rename(before_, path_, ignored);
    }
  }
  void keep() { has_flown_ = true; }

 private:
  /// FILE.before, unless that is somebody's own, or what was there before a flight that was killed.
  static std::filesystem::path unused_beside(const std::filesystem::path& file) {
    std::filesystem::path before{file.string() + ".before"};
    for (int i = 2; std::filesystem::exists(before); ++i) {
      before = file.string() + ".before" + std::to_string(i);
    }
    return before;
  }

  std::filesystem::path path_;
  std::filesystem::path before_;
  bool has_before_{};
  bool has_flown_{};
};

}  // namespace flyball
