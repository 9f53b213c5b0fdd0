// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Questions to a map that a flight has made, beside the same questions to stock OctoMap; inflation
/// of a window; the switch of level.

#include "map_pipeline.h"

namespace flyball::bench {

void register_questions(const Plan& plan, Scene scene);
void register_switch(const Plan& plan);

}  // namespace flyball::bench
