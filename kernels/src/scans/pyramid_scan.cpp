// SPDX-License-Identifier: BSD-3-Clause
#include "pyramid_scan.h"

#include "bricks/bits.h"
#include "scan.h"
#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

/// In a block of a level from `brick_level` on.
std::size_t bricks_in(int level) {
  return std::size_t{1} << 3 * static_cast<unsigned>(level - brick_level);
}

}  // namespace

PyramidScan::PyramidScan(double finest_m, Simd simd)
    : lattice_{finest_m}, loops_{inner_loops(simd)}, view_{finest_m, loops_} {}

const ScanMasks& PyramidScan::compute(const PointCloud& cloud_C,
                                      const Pose& X_WC,
                                      double range_m,
                                      int floor_level) {
  floor_level_ = floor_level;
  masks_.blocks = 0.0;
  view_.look(cloud_C, X_WC, range_m);
  view_share_ = cloud_C.camera->height_px / cloud_C.camera->focal_px;
  span_window(X_WC, range_m);
  const Pose X_CW = X_WC.inverse();
  for (int z = first_chunk_.z; z <= last_chunk_.z; ++z) {
    for (int y = first_chunk_.y; y <= last_chunk_.y; ++y) {
      for (int x = first_chunk_.x; x <= last_chunk_.x; ++x) {
        free_chunk({x, y, z}, X_CW);
      }
    }
  }
  mark_origin(X_WC.translation());
  mark_hits(cloud_C, X_WC, range_m);
  masks_.bricks.clear();
  masks_.updates = static_cast<double>(window_.collect(masks_.bricks));
  masks_.rays = static_cast<double>(cloud_C.hits_C.size() + cloud_C.clear_C.size());
  return masks_;
}

void PyramidScan::span_window(const Pose& X_WC, double range_m) {
  const Aabb box = view_.box_of_view(X_WC, range_m, lattice_.cell_m(0));
  first_chunk_ = lattice_.cell(box.min).above(chunk_level);
  last_chunk_ = lattice_.cell(box.max).above(chunk_level);
  window_.span(first_chunk_, last_chunk_);
}

// Points are moved, rounded and held against the range as for the ray front-ends, so that hits fall
// into the same cells.
void PyramidScan::mark_hits(const PointCloud& cloud_C, const Pose& X_WC, double range_m) {
  HitFrame frame{};
  frame.X_WC = rows_of(X_WC);
  const Eigen::Vector3f origin_W = X_WC.translation().cast<float>();
  frame.origin_W = {origin_W.x(), origin_W.y(), origin_W.z()};
  frame.squared_range_m2 = greatest_square(range_m);
  frame.cells_per_m = 1.0 / lattice_.cell_m(0);
  frame.window = window_.chunks();
  std::size_t brick = 0;  // Neighbours in the image are most often in one brick.
  std::uint64_t hit = 0;
  for (std::size_t first = 0; first < cloud_C.hits_C.size(); first += lanes) {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): filled next
    PointBlock points;
    take_points(loops_, &cloud_C.hits_C[first], std::min(lanes, cloud_C.hits_C.size() - first),
                points);
    Lanes<std::int32_t> cells;
    loops_.locate_hits(points, frame, cells);
    for (const std::int32_t cell : cells) {  // beyond the last point it repeats that
      const auto place = static_cast<std::size_t>(cell);
      if (cell >= 0 && place >> 6U != brick) {
        mark_hits_of(brick, hit);
        brick = place >> 6U;
        hit = 0;
      }
      hit |= (cell >= 0 ? std::uint64_t{1} : 0) << (place & 63U);
    }
  }
  mark_hits_of(brick, hit);
}

void PyramidScan::mark_hits_of(std::size_t brick, std::uint64_t hit) {
  if (hit != 0) {
    window_.add_hit(brick, hit);
  }
}

/// The cell that the camera is in is too near to be looked at, and free.
void PyramidScan::mark_origin(const Vec3& p_WC) {
  const CellKey cell = lattice_.cell(p_WC.cast<float>().cast<double>());
  window_.add_free(window_.place_of_cell(cell), std::uint64_t{1} << bit_in_brick(cell));
}

void PyramidScan::free_chunk(const CellKey& chunk, const Pose& X_CW) {
  ++masks_.blocks;
  const Aabb cube = lattice_.cube(chunk, chunk_level);
  const Vec3 centre_W = 0.5 * (cube.min + cube.max);
  const Block block{(X_CW * centre_W).cast<float>(), window_.place(chunk), chunk_level};
  const BlockVisibility visible = view_.visibility_of(block.centre_C, block.level);
  if (visible == BlockVisibility::whole) {
    window_.free_block(block.place, bricks_in(chunk_level));
  } else if (visible == BlockVisibility::part) {
    free_inside(block);
  }
}

int PyramidScan::floor_at(float depth_m) const {
  const double widest_m = 0.25 * view_share_ * std::max(0.0F, depth_m);
  int level = floor_level_;
  while (refines_near_ && level > 0 && lattice_.cell_m(level) > widest_m) {
    --level;
  }
  return level;
}

/// Of a block that is perhaps seen in part.
void PyramidScan::free_inside(const Block& block) {
  const int floor_level = floor_at(block.centre_C.z());
  if (block.level <= floor_level) {
    free_closely(block);
    return;
  }
  if (block.level > brick_level) {
    free_octants(block);
  } else if (floor_level > 0) {
    free_eighths(block);
  } else {
    free_cells(block);
  }
}

/// There is no smaller block to try.
void PyramidScan::free_closely(const Block& block) {
  ++masks_.blocks;
  if (view_.sees_through(block.centre_C, block.level)) {
    window_.free_block(block.place, bricks_in(block.level));
  }
}

void PyramidScan::free_octants(const Block& block) {
  masks_.blocks += 8.0;
  const OctantVisibility visible = view_.visibility_of_octants(block.centre_C, block.level);
  const std::size_t bricks = bricks_in(block.level - 1);
  for (std::uint64_t left = visible.whole; left != 0; left &= left - 1) {
    window_.free_block(block.place + lowest_bit(left) * bricks, bricks);
  }
  for (std::uint64_t left = visible.part; left != 0; left &= left - 1) {
    const std::size_t octant = lowest_bit(left);
    free_inside({block.centre_C + view_.to_octant(block.level, static_cast<unsigned>(octant)),
                 block.place + octant * bricks, block.level - 1});
  }
}

void PyramidScan::free_eighths(const Block& brick) {
  masks_.blocks += 8.0;
  std::uint64_t cells = 0;
  for (std::uint64_t left = view_.whole_octants(brick.centre_C, brick_level); left != 0;
       left &= left - 1) {
    const std::size_t octant = lowest_bit(left);
    cells |= std::uint64_t{0x330033}
             << ((octant & 1U) * 2 + (octant >> 1U & 1U) * 8 + (octant >> 2U) * 32);
  }
  if (cells != 0) {
    window_.add_free(brick.place, cells);
  }
}

void PyramidScan::free_cells(const Block& brick) {
  ++masks_.blocks;
  const std::uint64_t seen = loops_.seen_cells(view_.probe(), brick.centre_C.data());
  if (seen != 0) {
    window_.add_free(brick.place, seen);
  }
}

}  // namespace flyball
