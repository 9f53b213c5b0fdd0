// SPDX-License-Identifier: BSD-3-Clause
//
// Pinhole back-projection. No voxel filter: the map would lose rays.

#include "flyball/kernels/pixel_point.h"
#include "flyball/kernels/point_cloud.h"
#include "flyball/runtime/assert.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <cmath>

namespace {

/// Makes room for so many more points, and returns where the first of them goes.
Eigen::Vector3f* room_for(std::vector<Eigen::Vector3f>& points, std::size_t most) {
  const std::size_t count = points.size();
  points.resize(count + most);
  return points.data() + count;
}

/// Drops the room that was not used.
void end_at(std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f* end) {
  points.resize(static_cast<std::size_t>(end - points.data()));
}

/// Where its columns and rows look, as coordinates of rays of depth 1.
struct PixelRays {
  Eigen::ArrayXd x;
  Eigen::ArrayXd y;

  explicit PixelRays(const flyball::Intrinsics& camera)
      : x{slopes(camera.width_px, camera.centre_x_px, camera.focal_px)},
        y{slopes(camera.height_px, camera.centre_y_px, camera.focal_px)} {}
  static Eigen::ArrayXd slopes(int count, double centre_px, double focal_px) {
    return (Eigen::ArrayXd::LinSpaced(count, 0.0, count - 1.0) - centre_px) / focal_px;
  }
  [[nodiscard]] std::size_t pixels() const { return static_cast<std::size_t>(x.size() * y.size()); }
};

/// As `point_of_pixel` makes each. `turn` takes a ray of depth 1 in its own camera to C.
template <class Turn>
void append(flyball::PointCloud& cloud,
            const flyball::DepthImage& image,
            double range_m,
            Turn&& turn) {
  const PixelRays rays{image.camera};
  FLYBALL_ASSERT(image.depth_m.size() == rays.pixels(), "%zu depths for %d x %d pixels",
                 image.depth_m.size(), image.camera.width_px, image.camera.height_px);
  const double reach_m = std::min(range_m, image.max_range_m);
  Eigen::Vector3f* hit_C = room_for(cloud.hits_C, rays.pixels());
  Eigen::Vector3f* clear_C = room_for(cloud.clear_C, rays.pixels());
  const float* depth_m = image.depth_m.data();
  for (const double y : rays.y) {
    const Eigen::ArrayXd lengths = (rays.x.square() + (y * y + 1.0)).sqrt();
    const Eigen::ArrayXd clear_depths_m = flyball::beyond_reach * reach_m / lengths;
    for (Eigen::Index column = 0; column < lengths.size(); ++column) {
      const double depth = static_cast<double>(*depth_m++);
      const flyball::Vec3 ray_C = turn(flyball::Vec3{rays.x(column), y, 1.0});
      // A depth that is not a number, or not in front of the camera, is a broken measurement: it
      // must neither mark nor clear anything.
      if (depth * lengths(column) > reach_m) {
        *clear_C++ = (ray_C * clear_depths_m(column)).cast<float>();
      } else if (depth > 0.0) {
        *hit_C++ = (ray_C * depth).cast<float>();
      }
    }
  }
  end_at(cloud.hits_C, hit_C);
  end_at(cloud.clear_C, clear_C);
}

/// Of several cameras the points are no longer the pixels of one image.
flyball::PointCloud back_project(const flyball::DepthFrame& frame, double range_m) {
  const flyball::DepthImage& ahead = frame.image.value();
  flyball::PointCloud cloud{frame.captured, frame.sequence, {}, {}, std::nullopt};
  const std::size_t pixels = ahead.depth_m.size() * (1 + frame.sides.size());
  cloud.hits_C.reserve(pixels);
  cloud.clear_C.reserve(pixels);
  append(cloud, ahead, range_m, [](const flyball::Vec3& ray_C) { return ray_C; });
  for (const flyball::SideView& side : frame.sides) {
    append(cloud, side.image.value(), range_m,
           [&](const flyball::Vec3& ray_S) { return flyball::Vec3{side.R_CS * ray_S}; });
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
    flyball::PointCloudFrame points{frame.captured, frame.sequence,
                                    flyball::Deferred<flyball::PointCloud>{
                                        [frame, range_m] { return back_project(frame, range_m); }}};
    if (frame.sides.empty()) {
      points.pixels = flyball::RangeImage{frame.image, range_m};
    }
    return points;
  }
};

}  // namespace

FLYBALL_PLUGIN(depth_to_points) {
  registry.add<flyball::PointCloudBuilder>("depth_to_points",
                                           [] { return std::make_unique<DepthToPoints>(); });
}
