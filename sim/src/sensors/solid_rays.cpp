// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/solid_rays.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace flyball {
namespace {

constexpr std::size_t leaf_solids = 2;
constexpr std::size_t most_depth = 64;  // halves of halves: enough for any number of solids
constexpr float infinite = std::numeric_limits<float>::infinity();
// Far more than the rounding of a ray or a depth in floats, far less than a pixel.
constexpr double way_margin = 1e-5;
constexpr double depth_margin = 1e-5;

constexpr double prism_radius = 0.991444861373810;  // of its faces, for 1 at the corners: cos 7.5°

Aabb box_of(const Pillar& pillar) {
  const double corner_m = pillar.radius_m / prism_radius;
  const Vec3 out{corner_m, corner_m, 0.0};
  return {pillar.foot_W - out, pillar.foot_W + out + Vec3{0.0, 0.0, pillar.height_m}};
}

/// A node that is still to be looked at, and the least depth at which a ray enters its box.
struct Visit {
  std::size_t node;
  double enters_m;
};

}  // namespace

/// Between which bounds the coordinates of a tile's directions are, and what follows for boxes.
struct SolidRays::Bounds {
  std::array<double, 3> inverse_low{};   ///< 1 / the least coordinate
  std::array<double, 3> inverse_high{};  ///< 1 / the greatest
  std::array<int, 3> sign{};             ///< 0 where there are both.

  void add(std::size_t axis, double low, double high) {
    low -= way_margin;
    high += way_margin;
    sign[axis] = low > 0.0 ? 1 : high < 0.0 ? -1 : 0;
    inverse_low[axis] = 1.0 / low;
    inverse_high[axis] = 1.0 / high;
  }

  /// No ray enters the box before this depth; infinite when none enters it.
  [[nodiscard]] double enters(const Aabb& box, const Vec3& p_WC) const {
    double enters = 0.0;
    double leaves = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      const double low = box.min[i] - p_WC[i];
      const double high = box.max[i] - p_WC[i];
      if (sign[axis] == 0) {
        enters = std::max(enters, std::max(low * inverse_high[axis], high * inverse_low[axis]));
        continue;
      }
      const double first = sign[axis] > 0 ? low : high;
      const double last = sign[axis] > 0 ? high : low;
      enters = std::max(enters, std::min(first * inverse_low[axis], first * inverse_high[axis]));
      leaves = std::min(leaves, std::max(last * inverse_low[axis], last * inverse_high[axis]));
    }
    enters -= depth_margin * (1.0 + enters);
    return enters <= leaves ? enters : std::numeric_limits<double>::infinity();
  }
};

struct SolidRays::Tile {
  TileRays rays;
  TileDepths seen;
  Vec3 p_WC;
  Bounds bounds{};
  double farthest_m{};  ///< Nothing beyond it is seen any more.
  float range_m;

  void aim(const Intrinsics& camera, const Pose& X_WC, int x, int y, const RayLoops& loops);
  void take(float greatest_m) { farthest_m = std::min(greatest_m, range_m); }
};

/// The tile whose first pixel this is.
void SolidRays::Tile::aim(
    const Intrinsics& camera, const Pose& X_WC, int x, int y, const RayLoops& loops) {
  const Vec3 right_W = X_WC.linear().col(0) / camera.focal_px;
  const Vec3 down_W = X_WC.linear().col(1) / camera.focal_px;
  const Vec3 first_W =
      X_WC.linear().col(2) + (x - camera.centre_x_px) * right_W + (y - camera.centre_y_px) * down_W;
  TileAim ways{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    ways.first_W[axis] = static_cast<float>(first_W[i]);
    ways.right_W[axis] = static_cast<float>(right_W[i]);
    ways.down_W[axis] = static_cast<float>(down_W[i]);
    const double across = (tile_width - 1) * right_W[i];
    const double along = (tile_height - 1) * down_W[i];
    bounds.add(axis, first_W[i] + std::min(across, 0.0) + std::min(along, 0.0),
               first_W[i] + std::max(across, 0.0) + std::max(along, 0.0));
  }
  loops.aim(ways, rays);
}

SolidRays::SolidRays(const World& world, const RayLoops& loops)
    : loops_{loops}, ground_z_m_{world.ground_z_m}, has_ground_{world.has_ground} {
  for (const Aabb& box : world.boxes) {
    solids_.push_back({box, false});
  }
  for (const Pillar& pillar : world.pillars) {
    solids_.push_back({box_of(pillar), true});
  }
  for (const Person& person : world.people) {
    if (person.walk.size() == 1) {
      solids_.push_back(
          {box_of({person.walk.front().foot_W, person.radius_m, person.height_m}), true});
    }
  }
  if (!solids_.empty()) {
    grow(0, solids_.size());
  }
}

/// Halves of equal number along the axis in which the solids' middles spread most.
void SolidRays::grow(std::size_t first, std::size_t count) {
  const auto begin = solids_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = begin + static_cast<std::ptrdiff_t>(count);
  Aabb box = begin->box;
  Eigen::AlignedBox3d middles;
  std::for_each(begin, end, [&](const Solid& solid) {
    box = {box.min.cwiseMin(solid.box.min), box.max.cwiseMax(solid.box.max)};
    middles.extend(Vec3{solid.box.min + solid.box.max});
  });
  const auto node = nodes_.size();
  nodes_.push_back({box});
  if (count <= leaf_solids) {
    nodes_[node].first = first;
    nodes_[node].count = count;
    return;
  }
  Eigen::Index axis = 0;
  middles.sizes().maxCoeff(&axis);
  const std::size_t half = count / 2;
  std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(half), end,
                   [axis](const Solid& a, const Solid& b) {
                     return a.box.min[axis] + a.box.max[axis] < b.box.min[axis] + b.box.max[axis];
                   });
  grow(first, half);
  nodes_[node].right = nodes_.size();
  grow(first + half, count - half);
}

void SolidRays::look(const Intrinsics& camera,
                     const Pose& X_WC,
                     double range_m,
                     float* depth_m) const {
  constexpr auto width = static_cast<int>(tile_width);
  constexpr auto height = static_cast<int>(tile_height);
  Tile tile{};
  tile.p_WC = X_WC.translation();
  tile.range_m = static_cast<float>(range_m);
  for (int y = 0; y < camera.height_px; y += height) {
    for (int x = 0; x < camera.width_px; x += width) {
      tile.aim(camera, X_WC, x, y, loops_);
      look_at_tile(tile);
      const int columns = std::min(width, camera.width_px - x);
      for (int row = 0; row < std::min(height, camera.height_px - y); ++row) {
        std::copy_n(tile.seen.depth_m.data() + static_cast<std::ptrdiff_t>(row) * width, columns,
                    depth_m + static_cast<std::ptrdiff_t>(y + row) * camera.width_px + x);
      }
    }
  }
}

void SolidRays::look_at_tile(Tile& tile) const {
  tile.seen.depth_m.fill(infinite);
  tile.farthest_m = static_cast<double>(tile.range_m);
  if (has_ground_) {
    tile.take(loops_.meet_ground(tile.rays, static_cast<float>(ground_z_m_ - tile.p_WC.z()),
                                 tile.range_m, tile.seen));
  }
  const auto visit_of = [&](std::size_t node) {
    return Visit{node, tile.bounds.enters(nodes_[node].box, tile.p_WC)};
  };
  std::array<Visit, most_depth> open{};
  std::size_t count = 0;
  if (!nodes_.empty()) {
    open[count++] = visit_of(0);
  }
  while (count > 0) {
    const Visit visit = open[--count];
    if (visit.enters_m > tile.farthest_m) {
      continue;
    }
    const Node& node = nodes_[visit.node];
    if (node.count > 0) {
      meet(node, tile);
      continue;
    }
    Visit near = visit_of(visit.node + 1);
    Visit far = visit_of(node.right);
    if (far.enters_m < near.enters_m) {
      std::swap(near, far);
    }
    open[count++] = far;
    open[count++] = near;
  }
}

void SolidRays::meet(const Node& leaf, Tile& tile) const {
  for (std::size_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
    if (tile.bounds.enters(solids_[i].box, tile.p_WC) <= tile.farthest_m) {
      meet(solids_[i], tile);
    }
  }
}

void SolidRays::meet(const Solid& solid, Tile& tile) const {
  const Eigen::Vector3f low = (solid.box.min - tile.p_WC).cast<float>();
  const Eigen::Vector3f high = (solid.box.max - tile.p_WC).cast<float>();
  if (!solid.is_pillar) {
    tile.take(loops_.meet_box(tile.rays,
                              {{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}},
                              tile.range_m, tile.seen));
    return;
  }
  const Vec3 centre = 0.5 * (solid.box.min + solid.box.max) - tile.p_WC;
  const double radius_m = 0.5 * prism_radius * (solid.box.max.x() - solid.box.min.x());
  tile.take(loops_.meet_pillar(tile.rays,
                               {static_cast<float>(centre.x()), static_cast<float>(centre.y()),
                                static_cast<float>(radius_m), low.z(), high.z()},
                               tile.range_m, tile.seen));
}

}  // namespace flyball
