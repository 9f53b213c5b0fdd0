// SPDX-License-Identifier: BSD-3-Clause
#include "world/congestion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

constexpr double pitch_m = 10.0;
constexpr double half_block_m = 2.0;

double nearest_m(const std::vector<Vec3>& places_W, const Vec3& from_W) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vec3& place_W : places_W) {
    nearest = std::min(nearest, (place_W - from_W).head<2>().norm());
  }
  return nearest;
}

/// From the surface of a block that stands there.
double clear_m(const Vec3& block_W, const Vec3& place_W) {
  const Vec3 apart = (block_W - place_W).cwiseAbs();
  const double gap_x = std::max(0.0, apart.x() - half_block_m);
  const double gap_y = std::max(0.0, apart.y() - half_block_m);
  return std::hypot(gap_x, gap_y);
}

bool may_stand(const CongestionPlan& plan, const Vec3& centre_W) {
  const Vec3 half{half_block_m, half_block_m, 0.0};
  Aabb area = plan.area_W;
  area.min.z() = area.max.z() = 0.0;
  return area.contains(centre_W - half) && area.contains(centre_W + half) &&
         std::none_of(plan.clear_W.begin(), plan.clear_W.end(), [&](const Vec3& place_W) {
           return clear_m(centre_W, place_W) < plan.clear_radius_m;
         });
}

}  // namespace

std::vector<Aabb> congested_blocks(const CongestionPlan& plan, RandomStream& random) {
  const double sigma_m = 0.5 * plan.spread_m;
  const auto first = [](double low_m) { return static_cast<int>(std::ceil(low_m / pitch_m)); };
  const auto last = [](double high_m) { return static_cast<int>(std::floor(high_m / pitch_m)); };
  const Vec3 half{half_block_m, half_block_m, 0.0};
  std::vector<Aabb> blocks;
  for (int i = first(plan.area_W.min.x()); i <= last(plan.area_W.max.x()); ++i) {
    for (int j = first(plan.area_W.min.y()); j <= last(plan.area_W.max.y()); ++j) {
      const Vec3 centre_W{i * pitch_m, j * pitch_m, 0.0};
      const double d_m = nearest_m(plan.peaks_W, centre_W);
      const double probability = plan.density * std::exp(-0.5 * d_m * d_m / (sigma_m * sigma_m));
      // Drawn for each grid point, also where no block may stand: moving a goal moves no block.
      const bool stands = random.uniform() < probability;
      if (stands && may_stand(plan, centre_W)) {
        blocks.push_back({centre_W - half, centre_W + half + plan.height_m * Vec3::UnitZ()});
      }
    }
  }
  return blocks;
}

}  // namespace flyball
