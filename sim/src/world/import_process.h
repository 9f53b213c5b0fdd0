// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Libraries that read other people's files may loop, abort or eat all memory over a damaged one.
/// They read in a process of their own, so that only this process ends.

#include "flyball/runtime/result.h"

#include <cstddef>
#include <functional>
#include <string>

namespace flyball {

struct ImportLimits {
  /// Processor time, so that a busy host refuses no file that an idle one takes.
  unsigned processor_s{};
  std::size_t memory_bytes{};
};

/// Limits for a file of this size, many times what a sound one needs: `processor_s` and 2 GB, and
/// more for a large file.
[[nodiscard]] ImportLimits import_limits(std::size_t file_bytes, unsigned processor_s = 3);

/// Calls `work` in a forked process and hands over what it returns, its errors included. What it
/// prints is discarded.
///
/// @error Those of `work`; `invalid_input` when the process crashed or went beyond a limit, told
///        in words that follow a file's name ("takes more than 3 s ..."); `failed` when there is
///        no process to be had.
[[nodiscard]] Result<std::string> read_in_process(const ImportLimits& limits,
                                                  const std::function<Result<std::string>()>& work);

}  // namespace flyball
