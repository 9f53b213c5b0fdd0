// SPDX-License-Identifier: BSD-3-Clause
#include "map_file.h"

#include "flyball/runtime/text/number_text.h"

#include "maps/octree_file.h"
#include "octree_copy.h"
#include <cmath>
#include <exception>

namespace flyball {
namespace {

constexpr int coarsest_written = 3;

}  // namespace

Status write_map_file(const BrickMap& map,
                      std::optional<double> resolution_m,
                      const std::string& path) {
  const double finest_m = map.lattice().cell_m(0);
  int level = 0;
  while (level <= coarsest_written &&
         std::abs(map.lattice().cell_m(level) - resolution_m.value_or(finest_m)) > 1e-9) {
    ++level;
  }
  if (level > coarsest_written) {
    return Error{ErrorCode::invalid_input, "a map file's cells must be 1, 2, 4 or 8 times " +
                                               short_number_text(finest_m) + " m, and not " +
                                               short_number_text(*resolution_m) + " m"};
  }
  try {
    const bool is_bt = path.size() > 3 && path.compare(path.size() - 3, 3, ".bt") == 0;
    const auto cells = is_bt ? TreeCells::likeliest : TreeCells::log_odds;
    return write_octree(*to_octree(map, level, cells), path);
  } catch (const std::exception& e) {
    return Error{ErrorCode::failed, "map file \"" + path + "\": " + e.what()};
  }
}

Result<BrickMap> read_map_file(const std::string& path) {
  const auto tree = read_octree(path);
  if (!tree) {
    return tree.error();
  }
  try {
    auto bricks = to_bricks(**tree);
    if (!bricks) {
      return Error{bricks.error().code, "map file \"" + path + "\": " + bricks.error().message};
    }
    return bricks;
  } catch (const std::exception& e) {
    return Error{ErrorCode::failed, "map file \"" + path + "\": " + e.what()};
  }
}

}  // namespace flyball
