// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Every experiment in this room.

#include "experiments/framework/experiment.h"
#include <string>
#include <vector>

namespace flyball {

struct NamedExperiment {
  std::string name;  ///< The stem of its file.
  Experiment experiment;
};

/// In the order of their names. CMake finds the files and writes this function.
[[nodiscard]] std::vector<NamedExperiment> all_experiments();

}  // namespace flyball
