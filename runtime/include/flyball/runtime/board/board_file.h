// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Reads runtime/boards/NAME.toml: what is known of a board before anybody looks at it. Only names
/// and priors; clocks, cores, rails and trips are read from the board itself.

#include "flyball/runtime/result.h"
#include "flyball/runtime/units.h"

#include <string>
#include <vector>

namespace flyball {

/// The defaults are those of a board that no file describes.
struct BoardFile {
  std::string name{"unknown"};
  std::vector<std::string> models{};  ///< Parts of the device tree's or the firmware's model.
  std::vector<int> core_order{};      ///< In which cores are taken; empty: ascending.
  std::vector<int> cores_if_asked{};  ///< Of another kind, behind `core_order`: TX2's Denver cores.
  bool may_unplug_cores{};            ///< A core that is switched off comes back when asked.
  std::vector<std::string> input_rails{};    ///< Of the whole board, the best one first.
  std::vector<std::string> ignored_zones{};  ///< Thermal zones that measure nothing.
  Hertz clock_step{100e6};                   ///< Between clocks, where the driver lists none.
  Hertz lowest_kept_clock{};                 ///< The firmware ignores lower ones; 0: it keeps all.
  double cycles_per_addition{1.0};  ///< Of a chain of dependent additions, for `measured_clock`.
};

/// @error `not_found`, `invalid_input`: unknown keys and impossible values, all in one message.
[[nodiscard]] Result<BoardFile> load_board_file(const std::string& path);

/// The file whose `models` name a part of `model`; the longest such part wins. Without one, the
/// defaults.
[[nodiscard]] BoardFile board_file_for(const std::vector<BoardFile>& files,
                                       const std::string& model);

/// Those of the cores that are present which jobs may take, in the order of the board's file, then,
/// if asked for, its cores of another kind. Where the file has no order, all as they are given.
[[nodiscard]] std::vector<int> cores_in_order(const BoardFile& board,
                                              const std::vector<int>& present,
                                              bool with_cores_if_asked = false);

}  // namespace flyball
