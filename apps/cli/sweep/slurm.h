// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A job array of Slurm (Debian: slurm-client): started, awaited, and nothing else. Slurm
/// schedules.

#include "flyball/runtime/result.h"

#include <cstddef>
#include <string>
#include <vector>

namespace flyball {

/// What each task of an array does.
struct JobArray {
  std::string name{};                  ///< Of the job.
  std::vector<std::string> command{};  ///< Program and arguments; each task adds `NUMBER/TASKS`.
  std::size_t tasks{};
  std::string folder{};  ///< For the script and the tasks' outputs; on the shared file system.
};

/// The batch script for `sbatch`. A task that is pre-empted, or whose node fails, starts again.
[[nodiscard]] std::string array_script(const JobArray& array);

/// Writes the script and hands it to Slurm. @return The array's number.
/// @error `unavailable` when there is no Slurm here or it refuses, with what it said.
[[nodiscard]] Result<std::string> submit(const JobArray& array);

/// How many tasks of the array have not ended; 0 as well when Slurm does not know it any more.
/// @error `unavailable` when Slurm cannot be asked.
[[nodiscard]] Result<std::size_t> tasks_left(const std::string& array_number);

/// The processors that Slurm has, at least 1.
[[nodiscard]] Result<std::size_t> slurm_processors();

}  // namespace flyball
