// SPDX-License-Identifier: BSD-3-Clause
// tested-in: exact_scan
//
// The part of ExactScan that holds space against the image, from chunks down to cells.

#include "bricks/bits.h"
#include "exact_scan.h"
#include <cmath>

namespace flyball {

void ExactScan::free_seen(const Pose& X_CW) {
  if (traversals_ >
      0) {  // The first cell of every ray that leaves it; it may lie behind the camera.
    free_cell({frame_.start[0], frame_.start[1], frame_.start[2]});
  }
  for (int z = first_chunk_.z; z <= last_chunk_.z; ++z) {
    for (int y = first_chunk_.y; y <= last_chunk_.y; ++y) {
      for (int x = first_chunk_.x; x <= last_chunk_.x; ++x) {
        free_chunk({x, y, z}, X_CW);
      }
    }
  }
}

void ExactScan::free_chunk(const CellKey& chunk, const Pose& X_CW) {
  const Aabb cube = lattice_.cube(chunk, chunk_level);
  const Vec3 centre_W = 0.5 * (cube.min + cube.max);
  const Block block{(X_CW * centre_W).cast<float>(), centre_W - camera_W_, window_.place(chunk),
                    chunk_level};
  const BlockVisibility visible = view_.visibility_of(block.centre_C, block.level);
  if (visible == BlockVisibility::whole && fills_pixels(block)) {
    window_.free_block(block.place, std::size_t{512});
  } else if (visible != BlockVisibility::none) {
    free_inside(block);
  }
}

bool ExactScan::fills_pixels(const Block& block) const {
  const double ball_m = std::sqrt(0.75) * lattice_.cell_m(block.level);
  return static_cast<double>(block.centre_C.norm()) + ball_m < ball_reach_m_;
}

ExactScan::Block ExactScan::octant_of(const Block& block,
                                      unsigned octant,
                                      std::size_t place) const {
  const double half_m = 0.25 * lattice_.cell_m(block.level);
  const Vec3 offset_W{(octant & 1U) != 0 ? half_m : -half_m, (octant & 2U) != 0 ? half_m : -half_m,
                      (octant & 4U) != 0 ? half_m : -half_m};
  return {block.centre_C + view_.to_octant(block.level, octant), block.centre_W + offset_W, place,
          block.level - 1};
}

/// Of a block that is perhaps crossed in part.
void ExactScan::free_inside(const Block& block) {
  if (block.level == brick_level) {
    free_brick(block);
    return;
  }
  const OctantVisibility visible = view_.visibility_of_octants(block.centre_C, block.level);
  const std::size_t bricks = std::size_t{1}
                             << 3 * static_cast<unsigned>(block.level - 1 - brick_level);
  for (std::uint64_t left = visible.whole | visible.part; left != 0; left &= left - 1) {
    const auto octant = static_cast<unsigned>(lowest_bit(left));
    const Block part = octant_of(block, octant, block.place + octant * bricks);
    if ((visible.whole >> octant & 1U) != 0 && fills_pixels(part)) {
      window_.free_block(part.place, bricks);
    } else {
      free_inside(part);
    }
  }
}

void ExactScan::free_brick(const Block& brick) {
  const OctantVisibility visible = view_.visibility_of_octants(brick.centre_C, brick_level);
  std::uint64_t free = 0;
  if (visible.part != 0 && fills_pixels(brick)) {
    free = loops_.seen_cells(view_.probe(), brick.centre_C.data());
  }
  for (std::uint64_t left = visible.whole | visible.part; left != 0; left &= left - 1) {
    const auto octant = static_cast<unsigned>(lowest_bit(left));
    const Block eighth = octant_of(brick, octant, brick.place);
    const unsigned first_bit = (octant & 1U) * 2 + (octant >> 1U & 1U) * 8 + (octant >> 2U) * 32;
    if ((visible.whole >> octant & 1U) != 0 && fills_pixels(eighth)) {
      free |= std::uint64_t{0x330033} << first_bit;
    } else {
      free |= crossed_cells(eighth, first_bit, free | window_.hits(brick.place));
    }
  }
  if (free != 0) {
    window_.add_free(brick.place, free);
  }
}

/// Of two by two by two cells, the first of which has this bit in its brick, those that are not
/// settled: known to be free, or hit. A hit is not freed by rays that cross it.
std::uint64_t ExactScan::crossed_cells(const Block& eighth,
                                       unsigned first_bit,
                                       std::uint64_t settled) {
  if ((~settled >> first_bit & 0x330033) == 0) {
    return 0;
  }
  const OctantVisibility visible = view_.visibility_of_octants(eighth.centre_C, 1);
  std::uint64_t crossed = 0;
  for (std::uint64_t left = visible.whole | visible.part; left != 0; left &= left - 1) {
    const auto octant = static_cast<unsigned>(lowest_bit(left));
    const unsigned step = (octant & 1U) + (octant >> 1U & 1U) * 4 + (octant >> 2U) * 16;
    const std::uint64_t bit = std::uint64_t{1} << (first_bit + step);
    if ((settled & bit) != 0) {
      continue;
    }
    const Block cell = octant_of(eighth, octant, eighth.place);
    const bool is_whole = (visible.whole >> octant & 1U) != 0 && fills_pixels(cell);
    crossed |= is_whole || is_crossed(cell) ? bit : 0;
  }
  return crossed;
}

/// Such cells are left to `knows_corner`.
bool ExactScan::touches_eye(const Block& cell) const {
  if (beside_ == std::array<int, 3>{}) {
    return false;
  }
  const double reach_m = 0.5 * frame_.cell_m + corner_m_;
  return (cell.centre_W.array().abs() < reach_m).all();
}

/// Where only the slack could tell, remembers the pixels in question.
bool ExactScan::is_crossed(const Block& cell) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box_.centre[axis] = static_cast<float>(cell.centre_W(static_cast<int>(axis)));
  }
  box_.depth = view_.nearest_depth_m(cell.centre_C, 0);
  const PixelBlock pixels = view_.pixels_around(cell.centre_C, 0);
  const Crossing crossing = image_rays_.cross(box_, pixels, loops_);
  if (!crossing.is_sure && crossing.is_possible && !touches_eye(cell)) {
    image_rays_.append_doubtful(box_, pixels, loops_, doubtful_px_);
  }
  return crossing.is_sure;
}

}  // namespace flyball
