// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The brick map in OctoMap's files. Nothing is thrown.

#include "flyball/runtime/result.h"

#include "brick_map.h"
#include <optional>
#include <string>

namespace flyball {

/// @param resolution_m  1, 2, 4 or 8 times the finest cells; the finest without it.
/// @error As `Mapper::write`.
[[nodiscard]] Status write_map_file(const BrickMap& map,
                                    std::optional<double> resolution_m,
                                    const std::string& path);
/// @error As `Mapper::read`.
[[nodiscard]] Result<BrickMap> read_map_file(const std::string& path);

}  // namespace flyball
