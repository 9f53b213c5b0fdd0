// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How much a brick map knows, counted cell by cell.

#include "flyball/kernels/mapper.h"

#include "brick_map.h"

namespace flyball {

/// From the finest level to `coarsest_level`, which is at most 5.
[[nodiscard]] MapContents contents_of(const BrickMap& map, int coarsest_level);

}  // namespace flyball
