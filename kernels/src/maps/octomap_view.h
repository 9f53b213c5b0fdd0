// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Several OctoMap trees of different resolutions, seen as one map.

#include "maps/layered_view.h"

namespace octomap {
class OcTree;
}  // namespace octomap

namespace flyball {

using OctomapView = LayeredView<octomap::OcTree>;

}  // namespace flyball
