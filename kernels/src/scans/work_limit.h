// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A limit on the work of one scan, kept by looking less far: what is near is always mapped.

#include "scan.h"

namespace flyball {

/// The longest range, up to the scan's own, within which its rays cross at most `traversals` cells.
///
/// @return Positive. Right to a few cells a ray, and never above the scan's range.
/// @cost Two passes over the points, no allocation.
[[nodiscard]] double range_within(const Scan& scan, double cell_m, double traversals);

}  // namespace flyball
