// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The map that tests fill by hand.

#include "flyball/kernels/conformance/dense_map.h"

namespace flyball::kit {

using GridMap = DenseMap;

}  // namespace flyball::kit
