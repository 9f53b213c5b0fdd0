// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The contract of point_cloud.h as checks: each point is held against the pixel that it comes
/// from.

#include "flyball/kernels/conformance/kernel_conformance.h"
#include "flyball/kernels/point_cloud.h"
#include "flyball/runtime/random.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace flyball {

class PointCloudConformance : public KernelConformance<PointCloudBuilder> {
 public:
  using KernelConformance::KernelConformance;

  [[nodiscard]] std::vector<std::string> breaches() {
    return checked({}, [this] {
      check_pixels(image(1, 24, 16), 6.0);
      check_pixels(image(2, 24, 16), 50.0);
      check_sides();
      check_work();
      check_memory();
    });
  }

 private:
  static constexpr float infinity = std::numeric_limits<float>::infinity();

  /// Depths of all kinds: near, far, no return, and broken ones.
  static DepthImage image(std::uint64_t seed, int width_px, int height_px) {
    RandomStream random{seed, "point_cloud_conformance"};
    DepthImage image;
    image.captured = MissionTime{std::chrono::seconds{3}};
    image.sequence = 17;
    image.camera = {width_px, height_px, 0.5 * width_px, 0.5 * (width_px - 1),
                    0.5 * (height_px - 1)};
    image.max_range_m = 9.0;
    const std::vector<float> odd{infinity, std::numeric_limits<float>::quiet_NaN(), 0.0F, -1.0F,
                                 -infinity};
    for (int i = 0; i < width_px * height_px; ++i) {
      const auto kind = static_cast<std::size_t>(random.next() % 12);
      image.depth_m.push_back(kind < odd.size() ? odd[kind]
                                                : static_cast<float>(random.uniform(0.2, 12.0)));
    }
    return image;
  }

  static DepthFrame frame_of(const DepthImage& image) {
    return {image.captured,
            image.sequence,
            image.camera.width_px * image.camera.height_px,
            Deferred<DepthImage>::of(image),
            {}};
  }

  /// As the interface says it, with nothing shared with any implementation.
  static void back_project(const DepthImage& image,
                           double range_m,
                           const Eigen::Matrix3d& R_CS,
                           std::vector<Vec3>& hits_C,
                           std::vector<Vec3>& clear_C) {
    const double reach_m = std::min(range_m, image.max_range_m);
    for (int v = 0; v < image.camera.height_px; ++v) {
      for (int u = 0; u < image.camera.width_px; ++u) {
        const Vec3 ray{(u - image.camera.centre_x_px) / image.camera.focal_px,
                       (v - image.camera.centre_y_px) / image.camera.focal_px, 1.0};
        const auto depth_m = static_cast<double>(
            image.depth_m[static_cast<std::size_t>(v * image.camera.width_px + u)]);
        if (!(depth_m > 0.0)) {
          continue;  // A broken measurement is no point.
        }
        if (depth_m * ray.norm() > reach_m) {
          clear_C.push_back(R_CS * ray.normalized() * reach_m);
        } else {
          hits_C.push_back(R_CS * ray * depth_m);
        }
      }
    }
  }

  /// Whether both are the same points, in any order.
  static bool is_same_set(const std::vector<Eigen::Vector3f>& points,
                          const std::vector<Vec3>& wanted,
                          double tolerance_m) {
    const auto covered = [tolerance_m](const Vec3& p, const auto& by) {
      return std::any_of(by.begin(), by.end(), [&](const auto& other) {
        return (other.template cast<double>() - p).norm() <= tolerance_m;
      });
    };
    return points.size() == wanted.size() &&
           std::all_of(wanted.begin(), wanted.end(),
                       [&](const Vec3& p) { return covered(p, points); }) &&
           std::all_of(points.begin(), points.end(), [&](const Eigen::Vector3f& p) {
             return p.allFinite() && covered(p.cast<double>(), wanted);
           });
  }

  void check_cloud(const PointCloud& cloud,
                   const std::vector<Vec3>& hits_C,
                   const std::vector<Vec3>& clear_C) {
    require(is_same_set(cloud.hits_C, hits_C, 1e-4), "does not put each pixel at its depth");
    // A ray without return may be a little longer than the range, so that a mapper cuts it there.
    require(is_same_set(cloud.clear_C, clear_C, 0.02),
            "does not turn each pixel without return, or beyond the range, into a clear ray");
  }

  void check_pixels(const DepthImage& image, double range_m) {
    auto builder = made();
    Work work;
    const PointCloudFrame built = builder->build(frame_of(image), range_m, work);
    builder.reset();  // The result may outlive its builder.
    const PointCloud& cloud = built.cloud_C.value();
    std::vector<Vec3> hits_C;
    std::vector<Vec3> clear_C;
    back_project(image, range_m, Eigen::Matrix3d::Identity(), hits_C, clear_C);
    check_cloud(cloud, hits_C, clear_C);
    require(built.captured == image.captured && built.sequence == image.sequence &&
                cloud.captured == image.captured && cloud.sequence == image.sequence,
            "does not keep time and number of the frame");
    require(is_countable(work) && work.count("pixels") > 0.0, "counts no pixels");
  }

  void check_sides() {
    const DepthImage ahead = image(3, 12, 8);
    const DepthImage aside = image(4, 12, 8);
    SideView left;
    left.R_CS = Eigen::AngleAxisd{-1.5, Vec3::UnitY()}.toRotationMatrix();
    left.image = Deferred<DepthImage>::of(aside);
    DepthFrame frame = frame_of(ahead);
    frame.sides = {left};
    std::vector<Vec3> hits_C;
    std::vector<Vec3> clear_C;
    back_project(ahead, 6.0, Eigen::Matrix3d::Identity(), hits_C, clear_C);
    back_project(aside, 6.0, left.R_CS, hits_C, clear_C);
    Work work;
    Work alone;
    const PointCloudFrame built = made()->build(frame, 6.0, work);
    check_cloud(built.cloud_C.value(), hits_C, clear_C);
    require(!built.pixels && !built.cloud_C.value().camera,
            "calls the points of several cameras the pixels of one");
    static_cast<void>(made()->build(frame_of(ahead), 6.0, alone));
    require_work(work, alone);
  }

  void check_work() {
    Work small;
    Work large;
    static_cast<void>(made()->build(frame_of(image(5, 8, 6)), 6.0, small));
    static_cast<void>(made()->build(frame_of(image(5, 32, 24)), 6.0, large));
    require_work(large, small);
    require(large.count("pixels") > small.count("pixels"), "counts less work for a larger input");
  }

  void check_memory() {
    const auto used = made();
    for (const std::uint64_t seed : {6U, 7U, 6U}) {
      Work work;
      const DepthFrame frame = frame_of(image(seed, 16, 12));
      const PointCloudFrame fresh = made()->build(frame, 6.0, work);
      const PointCloudFrame again = used->build(frame, 6.0, work);
      require(fresh.cloud_C.value().hits_C == again.cloud_C.value().hits_C &&
                  fresh.cloud_C.value().clear_C == again.cloud_C.value().clear_C,
              "answers differently after other frames");
    }
  }
};

}  // namespace flyball
