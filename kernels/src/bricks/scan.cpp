// SPDX-License-Identifier: BSD-3-Clause
// tested-in: octomap
#include "scan.h"

#include "ray_scan.h"
#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

Error invalid(std::string message) {
  return {ErrorCode::invalid_input, std::move(message)};
}

bool is_finite(const std::vector<Eigen::Vector3f>& points) {
  return std::all_of(points.begin(), points.end(),
                     [](const Eigen::Vector3f& p) { return p.allFinite(); });
}

octomap::point3d to_octomap(const Vec3& p) {
  const Eigen::Vector3f single = p.cast<float>();
  return {single.x(), single.y(), single.z()};
}

}  // namespace

void to_world(const PointCloud& cloud_C, const Pose& X_WC, Scan& scan) {
  const auto add = [&](const auto& points_C, auto& points_W) {
    points_W.clear();
    for (const Eigen::Vector3f& p_C : points_C) {
      points_W.push_back(to_octomap(X_WC * p_C.template cast<double>()));
    }
  };
  add(cloud_C.hits_C, scan.hits_W);
  add(cloud_C.clear_C, scan.clear_W);
  scan.origin_W = to_octomap(X_WC.translation());
}

Status check_scan(const PointCloud& cloud_C,
                  const Pose& X_WC,
                  const MapperSettings& settings,
                  double cell_m,
                  double edge_m) {
  const auto is_positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  if (!is_positive(settings.resolution_m) || !is_positive(settings.range_m)) {
    return invalid("map.resolution_m " + std::to_string(settings.resolution_m) +
                   " and map.range_m " + std::to_string(settings.range_m) + " must be positive");
  }
  if (settings.range_m > RayScan::most_cells_per_ray * cell_m) {
    return invalid("map.range_m " + std::to_string(settings.range_m) + " is over 250 cells of " +
                   std::to_string(cell_m) + " m; shorten it or coarsen the map");
  }
  if (!X_WC.matrix().allFinite() || !is_finite(cloud_C.hits_C) || !is_finite(cloud_C.clear_C)) {
    return invalid("scan " + std::to_string(cloud_C.sequence) +
                   " has a coordinate that is not finite");
  }
  if (X_WC.translation().cwiseAbs().maxCoeff() >= edge_m) {
    return invalid("camera is over " + std::to_string(edge_m) + " m from the map's centre");
  }
  return Done{};
}

}  // namespace flyball
