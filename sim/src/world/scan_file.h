// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Scanned places from OctoMap's files.

#include "flyball/runtime/result.h"

#include "sensors/scan_grid.h"
#include <string>

namespace flyball {

/// A bare name means the current folder's file, or else OctoMap's example of that name.
[[nodiscard]] std::string scan_path(const std::string& file);

/// Reads `.bt` (each cell free or occupied) and `.ot` (log-odds: occupied from 0 on, as OctoMap has
/// it); what begins the file decides, not its name.
///
/// @error `not_found`; `invalid_input` when it is no OcTree, has cells that are not between .01 and
///        10 m, is cut off, empty, or larger than 2e8 cells.
///
/// Own reader: the library's prints to the terminal, also when all is well, and trusts the file.
[[nodiscard]] Result<ScanGrid> read_scan(const std::string& path);

}  // namespace flyball
