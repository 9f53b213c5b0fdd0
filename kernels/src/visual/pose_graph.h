// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Poses that are bound to each other by measured relative poses.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/work.h"

#include <vector>

namespace flyball {

/// Node `to` was seen at `X_FT` from node `from`.
struct PoseEdge {
  std::size_t from{};
  std::size_t to{};
  Pose X_FT{Pose::Identity()};
  double sigma_m{1.0};
  double sigma_rad{1.0};
};

/// The poses that contradict the edges least; the first one stays. Sparse pose adjustment on the
/// manifold, with MRPT: Konolige et al. 2010, doi:10.1109/IROS.2010.5649043. Adds `graph_edges`
/// (edges times iterations) to `work`.
///
/// @error `failed` when MRPT refuses, or a pose comes back that is not finite.
[[nodiscard]] Result<std::vector<Pose>> adjust(const std::vector<Pose>& poses,
                                               const std::vector<PoseEdge>& edges,
                                               Work& work);

}  // namespace flyball
