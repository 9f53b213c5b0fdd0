// SPDX-License-Identifier: BSD-3-Clause
// tested-in: octomap
#include "scan.h"

#include "flyball/runtime/text/number_text.h"

#include "ray_scan.h"
#include <algorithm>
#include <cmath>
#include <limits>

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
  const InnerLoops& loops = inner_loops(widest_simd());
  const PoseRows rows = rows_of(X_WC);
  const auto move = [&](const auto& points_C, auto& points_W) {
    points_W.resize(points_C.size());
    for (std::size_t first = 0; first < points_C.size(); first += lanes) {
      const std::size_t count = std::min(lanes, points_C.size() - first);
      // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): filled next
      PointBlock points;
      take_points(loops, &points_C[first], count, points);
      std::array<octomap::point3d, lanes> last;
      const bool is_last = count < lanes;
      loops.move_to_world(points, rows, is_last ? &last[0].x() : &points_W[first].x());
      if (is_last) {
        std::copy_n(last.begin(), count, &points_W[first]);
      }
    }
  };
  move(cloud_C.hits_C, scan.hits_W);
  move(cloud_C.clear_C, scan.clear_W);
  scan.origin_W = to_octomap(X_WC.translation());
}

float greatest_square(double length) {
  const float infinity = std::numeric_limits<float>::infinity();
  auto square = static_cast<float>(length * length);
  while (std::sqrt(static_cast<double>(square)) > length) {
    square = std::nextafter(square, 0.0F);
  }
  while (std::sqrt(static_cast<double>(std::nextafter(square, infinity))) <= length) {
    square = std::nextafter(square, infinity);
  }
  return square;
}

Status check_view(const Pose& X_WC, const MapperSettings& settings, double cell_m, double edge_m) {
  const auto is_positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  if (!is_positive(settings.resolution_m) || !is_positive(settings.range_m)) {
    return invalid("map.resolution_m " + short_number_text(settings.resolution_m) +
                   " and map.range_m " + short_number_text(settings.range_m) + " must be positive");
  }
  if (settings.range_m > RayScan::most_cells_per_ray * cell_m) {
    return invalid("map.range_m " + short_number_text(settings.range_m) + " is over 250 cells of " +
                   short_number_text(cell_m) + " m; shorten it or coarsen the map");
  }
  if (!X_WC.matrix().allFinite()) {
    return invalid("the camera's pose is not finite");
  }
  if (X_WC.translation().cwiseAbs().maxCoeff() >= edge_m) {
    return invalid("camera is over " + short_number_text(edge_m) + " m from the map's centre");
  }
  return Done{};
}

Status check_image(const PointCloudFrame& frame) {
  if (!frame.pixels) {
    return Done{};
  }
  const DepthImage& image = frame.pixels->image.value();
  const Intrinsics& camera = image.camera;
  const auto pixels =
      static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
  return image.depth_m.size() == pixels
             ? Status{Done{}}
             : invalid("a depth image of " + std::to_string(camera.width_px) + " x " +
                       std::to_string(camera.height_px) + " pixels has " +
                       std::to_string(image.depth_m.size()) + " depths");
}

Status check_points(const PointCloud& cloud_C, const Pose& X_WC) {
  if (!X_WC.matrix().allFinite() || !is_finite(cloud_C.hits_C) || !is_finite(cloud_C.clear_C)) {
    return invalid("scan " + std::to_string(cloud_C.sequence) +
                   " has a coordinate that is not finite");
  }
  return Done{};
}

}  // namespace flyball
