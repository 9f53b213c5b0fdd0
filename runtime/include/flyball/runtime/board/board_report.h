// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// For people: what a board has, what may be set, what not and why, and how to change that.

#include "flyball/runtime/board/board_file.h"
#include "flyball/runtime/board/board_inventory.h"

#include <string>

namespace flyball {

/// Several lines. Looks at permissions and writes nothing.
[[nodiscard]] std::string board_report(const LinuxSystem& system,
                                       const BoardInventory& found,
                                       const BoardFile& board);

/// A shell script for root: a group, rules of udev and tmpfiles, and limits that let the group's
/// members set clocks and cores, read energy, lock memory and use real-time priorities. Nothing
/// here runs it.
[[nodiscard]] std::string board_setup_script();

}  // namespace flyball
