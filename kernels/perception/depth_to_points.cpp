// SPDX-License-Identifier: BSD-3-Clause
//
// Pinhole back-projection. No voxel filter: the map would lose rays.

#include "flyball/kernels/point_cloud.h"
#include "flyball/runtime/assert.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr double beyond_range = 1.001;  // so that a mapper with the same range cuts the ray there

/// Writes points where there is room for all of them.
class PointWriter {
 public:
  PointWriter(std::vector<Eigen::Vector3f>& points, std::size_t most)
      : points_{points}, count_{points.size()} {
    points_.resize(count_ + most);
  }
  void add(const flyball::Vec3& p) { points_[count_++] = p.cast<float>(); }
  void end() { points_.resize(count_); }

 private:
  std::vector<Eigen::Vector3f>& points_;
  std::size_t count_;
};

class CloudWriter {
 public:
  CloudWriter(flyball::PointCloud& cloud, std::size_t most, double reach_m)
      : hits_{cloud.hits_C, most}, clear_{cloud.clear_C, most}, reach_m_{reach_m} {}
  /// `ray_C` has depth 1 in its own camera. A depth that is not a number, or not in front of the
  /// camera, is a broken measurement: it must neither mark nor clear anything.
  void add(const flyball::Vec3& ray_C, double depth_m) {
    if (std::isnan(depth_m) || depth_m <= 0.0) {
      return;
    }
    const double length = ray_C.norm();
    if (depth_m * length > reach_m_) {
      clear_.add(ray_C * (beyond_range * reach_m_ / length));
    } else {
      hits_.add(ray_C * depth_m);
    }
  }
  void end() {
    hits_.end();
    clear_.end();
  }

 private:
  PointWriter hits_;
  PointWriter clear_;
  double reach_m_;
};

/// Where its columns and rows look, as coordinates of rays of depth 1.
struct PixelRays {
  std::vector<double> x;
  std::vector<double> y;

  explicit PixelRays(const flyball::Intrinsics& camera)
      : x{slopes(camera.width_px, camera.centre_x_px, camera.focal_px)},
        y{slopes(camera.height_px, camera.centre_y_px, camera.focal_px)} {}
  static std::vector<double> slopes(int count, double centre_px, double focal_px) {
    std::vector<double> slopes(static_cast<std::size_t>(count));
    for (int pixel = 0; pixel < count; ++pixel) {
      slopes[static_cast<std::size_t>(pixel)] = (pixel - centre_px) / focal_px;
    }
    return slopes;
  }
};

void append(flyball::PointCloud& cloud,
            const flyball::DepthImage& image,
            const Eigen::Matrix3d& R_CS,
            double range_m) {
  const PixelRays rays{image.camera};
  const std::size_t pixels = rays.x.size() * rays.y.size();
  FLYBALL_ASSERT(image.depth_m.size() == pixels, "%zu depths for %d x %d pixels",
                 image.depth_m.size(), image.camera.width_px, image.camera.height_px);
  const bool is_turned = R_CS != Eigen::Matrix3d::Identity();
  CloudWriter writer{cloud, pixels, std::min(range_m, image.max_range_m)};
  const float* depth_m = image.depth_m.data();
  for (const double y : rays.y) {
    for (const double x : rays.x) {
      const flyball::Vec3 ray_S{x, y, 1.0};
      writer.add(is_turned ? flyball::Vec3{R_CS * ray_S} : ray_S, static_cast<double>(*depth_m++));
    }
  }
  writer.end();
}

/// Of several cameras the points are no longer the pixels of one image.
flyball::PointCloud back_project(const flyball::DepthFrame& frame, double range_m) {
  const flyball::DepthImage& ahead = frame.image.value();
  flyball::PointCloud cloud{frame.captured, frame.sequence, {}, {}, std::nullopt};
  const std::size_t pixels = ahead.depth_m.size() * (1 + frame.sides.size());
  cloud.hits_C.reserve(pixels);
  cloud.clear_C.reserve(pixels);
  append(cloud, ahead, Eigen::Matrix3d::Identity(), range_m);
  for (const flyball::SideView& side : frame.sides) {
    append(cloud, side.image.value(), side.R_CS, range_m);
  }
  if (frame.sides.empty()) {
    cloud.camera = ahead.camera;
  }
  return cloud;
}

class DepthToPoints final : public flyball::PointCloudBuilder {
 public:
  flyball::PointCloudFrame build(const flyball::DepthFrame& frame,
                                 double range_m,
                                 flyball::Work& work) override {
    FLYBALL_ASSERT(range_m > 0.0, "range_m=%g", range_m);
    work.add("pixels", frame.pixels * (1.0 + static_cast<double>(frame.sides.size())));
    return {frame.captured, frame.sequence,
            flyball::Deferred<flyball::PointCloud>{
                [frame, range_m] { return back_project(frame, range_m); }}};
  }
};

}  // namespace

FLYBALL_PLUGIN(depth_to_points) {
  registry.add<flyball::PointCloudBuilder>("depth_to_points",
                                           [] { return std::make_unique<DepthToPoints>(); });
}
