// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// OctoMap's files, `.bt` (each cell free or occupied) and `.ot` (log-odds). OctoMap's own reader
/// trusts what it reads: a broken file makes it descend without end, or takes space as free that
/// the file does not mention. Here every byte is checked before OctoMap sees it.

#include "flyball/runtime/result.h"

#include "maps/octomap_tree.h"
#include <memory>
#include <string>

namespace flyball {

/// @error `not_found` when there is no such file; `invalid_input` with what is wrong in it: the
///        header, a tree deeper than OctoMap's, an inner node without children, a log-odds that is
///        not finite, fewer or more nodes than it says.
[[nodiscard]] Result<std::unique_ptr<octomap::OcTree>> read_octree(const std::string& path);

/// Written beside the path and then moved there, so no half file is left. `.bt` turns every node
/// into free or occupied, also in `tree`.
///
/// @error `invalid_input` for a path that ends in neither `.bt` nor `.ot`; `failed` when it cannot
///        be written.
[[nodiscard]] Status write_octree(octomap::OcTree& tree, const std::string& path);

}  // namespace flyball
