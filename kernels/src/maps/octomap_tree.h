// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// `octomap::OcTree`, whose templates are compiled once, in octomap_tree.cpp, and not in every file
/// that uses it: that takes a file seconds.

#include <octomap/OcTree.h>

namespace octomap {
extern template class OcTreeBaseImpl<OcTreeNode, AbstractOccupancyOcTree>;
extern template class OccupancyOcTreeBase<OcTreeNode>;
}  // namespace octomap
