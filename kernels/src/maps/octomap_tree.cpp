// SPDX-License-Identifier: BSD-3-Clause
// tested-in: octomap
#include "maps/octomap_tree.h"

namespace octomap {
template class OcTreeBaseImpl<OcTreeNode, AbstractOccupancyOcTree>;
template class OccupancyOcTreeBase<OcTreeNode>;
}  // namespace octomap
