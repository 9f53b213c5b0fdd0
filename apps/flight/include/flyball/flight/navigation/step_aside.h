// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Out of what reaches into the tube by a millimetre.

#include "flyball/flight/mission_context.h"

#include <optional>

namespace flyball {

/// The nearest place, some centimetres off at most, where the body in its narrowest tube touches
/// nothing that is occupied; none where it touches nothing at `here_W` either, or wherever it is.
/// What is occupied stays so: with a part of it in the tube, no plan would ever begin here.
[[nodiscard]] std::optional<Vec3> place_aside_W(const MissionContext& context, const Vec3& here_W);

}  // namespace flyball
