// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The brick map as an OctoMap tree, and back. A free or occupied cell stays so. Log-odds are
/// rounded to a brick's steps of 1/29.6; OctoMap's own clamps apply in a tree.

#include "flyball/runtime/result.h"

#include "brick_map.h"
#include "maps/octomap_tree.h"
#include <memory>

namespace flyball {

/// Most chunks that a tree may fill: 550 MB.
inline constexpr std::size_t most_chunks_read = 16384;

/// What a cell of a tree holds: how likely it is occupied, or, in a fraction of the memory, only
/// which of the two is likelier (OctoMap's maximum likelihood, as in a `.bt` file).
enum class TreeCells : std::uint8_t { log_odds, likeliest };

/// The cells of one level, pruned. At a coarser one than the finest, cells that are free in part
/// only are unknown.
[[nodiscard]] std::unique_ptr<octomap::OcTree> to_octree(const BrickMap& map,
                                                         int level,
                                                         TreeCells cells = TreeCells::log_odds);

/// @error `invalid_input` when the tree's leaves fill more than `most_chunks_read` chunks: a few
///        bytes of a file can claim a continent.
[[nodiscard]] Status check_extent(const octomap::OcTree& tree);

/// A map with the tree's cells as its finest.
///
/// @error As `check_extent`.
[[nodiscard]] Result<BrickMap> to_bricks(const octomap::OcTree& tree);

}  // namespace flyball
