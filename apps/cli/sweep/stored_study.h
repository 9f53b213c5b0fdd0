// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What commands share that fly many missions into one store: where they fly them, and with which
/// options.

#include "cli/stored_flights.h"
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace flyball {

/// Options that say where and how a study flies.
struct StudyOptions {
  std::size_t jobs{};  ///< At a time, when it flies here.
  bool keeps_records{};
  std::string on{};    ///< `slurm`, or empty: here.
  std::string part{};  ///< Of a task of a job array, `2/8`: the second of eight. Else empty.
};

/// `--jobs`, `--on`, `--keep-records`, and `--part`, with which tasks of an array are started.
void add_study_options(CLI::App& command, StudyOptions& options);

/// All flights of a study.
struct Study {
  StoredBatch batch{};
  std::string store{};                    ///< The database's file in the batch's folder.
  std::vector<std::string> slurm_task{};  ///< The command of one task of an array, up to its part.
  std::vector<StoredFlight*> flights{};
};

/// Flies what the store does not know.
/// @return The code to end with, after saying why; empty: every flight has its summary.
[[nodiscard]] std::optional<int> fly_study(const Study& study, const StudyOptions& options);

}  // namespace flyball
