// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Frees a vehicle that has come to rest so close to an occupied cell that its tube overlaps it.

#include "flyball/flight/navigation/situation.h"

#include <optional>

namespace flyball {

/// The nearest place, at most some centimetres away, where the body in its narrowest tube overlaps
/// no occupied cell: `here_W` itself when it overlaps none there, empty when there is no such
/// place. The vehicle must move, because the cell stays occupied and no plan could ever begin here.
[[nodiscard]] std::optional<Vec3> place_aside_W(const Situation& situation, const Vec3& here_W);

}  // namespace flyball
