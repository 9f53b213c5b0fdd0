// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The brick map: one lattice of cells of finest_m, 2, 4 and 8 times as wide, and the resolution is
/// the level on it at which space is freed and asked about. Hits always go into the finest cells,
/// and a coarser level frees only blocks that are seen through as a whole, so the level can change
/// with every scan and nothing is lost or blown up.
///
/// A scan goes through here: cloud -> front-end -> masks (prepare) -> brick map -> view (commit).
/// At the finest level the front-end is the chosen one; above it, space is held against the depth
/// image block by block. A cloud that names no camera has no image: its rays are walked, at the
/// finest level.

#include "flyball/kernels/mapper.h"

#include <memory>

namespace flyball {

[[nodiscard]] std::unique_ptr<Mapper> make_lattice_mapper();

}  // namespace flyball
