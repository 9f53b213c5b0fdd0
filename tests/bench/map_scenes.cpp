// SPDX-License-Identifier: BSD-3-Clause
#include "map_scenes.h"

#include "flyball/kernels/pixel_point.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace flyball::bench {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Where a ray enters and leaves a box; it misses when it leaves first.
struct Passage {
  double enter;
  double leave;
};

Passage passage(const Aabb& box, const Vec3& from, const Vec3& direction) {
  const Eigen::Array3d a = (box.min - from).array() / direction.array();
  const Eigen::Array3d b = (box.max - from).array() / direction.array();
  return {a.min(b).maxCoeff(), a.max(b).minCoeff()};
}

class Place {
 public:
  explicit Place(Scene scene) : scene_{scene} {
    scene == Scene::indoor ? build_hall() : build_blocks();
  }

  [[nodiscard]] double distance_m(const Vec3& from, const Vec3& direction) const {
    double nearest = scene_ == Scene::indoor ? to_walls_m(from, direction)
                     : direction.z() < 0.0   ? -from.z() / direction.z()
                                             : never;
    for (const Aabb& block : blocks_) {
      const Passage through = passage(block, from, direction);
      if (through.enter > 0.0 && through.enter < through.leave) {
        nearest = std::min(nearest, through.enter);
      }
    }
    return nearest;
  }

 private:
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / 4294967296.0;
  }
  void add_block(double x, double y, const Vec3& size) {
    blocks_.push_back({{x, y, 0.0}, {x + size.x(), y + size.y(), size.z()}});
  }

  void build_hall() {
    rooms_ = {{{-2, -2, 0}, {26, 2, 3}}, {{25, -15, 0}, {60, 15, 8}}};
    for (int i = 0; i < 8; ++i) {
      add_block(3 + 2.8 * i, i % 2 == 1 ? 1.2 : -1.8, {0.6, 0.6, uniform(0.5, 2.2)});
    }
    for (int i = 0; i < 30; ++i) {
      const double x = uniform(30, 57);
      const double y = uniform(-13, 13);
      const Vec3 size{uniform(0.5, 2), uniform(0.5, 2), uniform(1, 6)};
      add_block(x, std::abs(y) < 2 ? y + 4 : y, size);
    }
  }

  void build_blocks() {
    for (int i = 0; i < 90; ++i) {
      const double x = uniform(-10, 110);
      const double y = uniform(-55, 55);
      const Vec3 size{uniform(1, 5), uniform(1, 5), uniform(3, 18)};
      add_block(x, std::abs(y) < 4 ? y + 9 : y, size);
    }
  }

  /// Through the rooms' union, from inside.
  [[nodiscard]] double to_walls_m(const Vec3& from, const Vec3& direction) const {
    double walked_m = 0.0;
    for (std::size_t step = 0; step <= rooms_.size(); ++step) {
      double farthest = 0.0;
      for (const Aabb& room : rooms_) {
        const Vec3 here = from + walked_m * direction;
        farthest = room.contains(here) ? std::max(farthest, passage(room, here, direction).leave)
                                       : farthest;
      }
      walked_m += farthest > 0.0 ? farthest + 1e-4 : 0.0;
    }
    return walked_m;
  }

  Scene scene_;
  std::mt19937 generator_{7};
  std::vector<Aabb> blocks_{};
  std::vector<Aabb> rooms_{};
};

Pose camera_at(Scene scene, int frame) {
  const double flown = static_cast<double>(frame) / (flight_frames - 1);
  Pose X_WC = Pose::Identity();
  X_WC.translation() = scene == Scene::indoor
                           ? Vec3{-1.0 + 48.0 * flown, 0.4 * std::sin(0.35 * frame), 1.5}
                           : Vec3{75.0 * flown, 1.5 * std::sin(0.25 * frame), 3.0};
  Eigen::Matrix3d R_BC;
  R_BC << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const double yaw_rad = 0.45 * std::sin(0.3 * frame);
  X_WC.linear() = Eigen::AngleAxisd{yaw_rad, Vec3::UnitZ()}.toRotationMatrix() * R_BC;
  return X_WC;
}

DepthImage look(const Place& place, const Pose& X_WC, ImageSize size) {
  constexpr double noise = 1e-3;
  std::mt19937 generator{123};
  std::normal_distribution<double> normal;
  const double half_px = 0.5 * size.width_px;
  DepthImage image;
  image.max_range_m = scene_range_m;
  image.camera =
      Intrinsics{size.width_px, size.height_px, half_px, half_px - 0.5, 0.5 * size.height_px - 0.5};
  for (int pixel = 0; pixel < size.width_px * size.height_px; ++pixel) {
    const Vec3 ray_C{(pixel % size.width_px - image.camera.centre_x_px) / half_px,
                     (pixel / size.width_px - image.camera.centre_y_px) / half_px, 1.0};
    const double d_m = place.distance_m(X_WC.translation(), X_WC.linear() * ray_C.normalized()) *
                       (1.0 + noise * normal(generator));
    image.depth_m.push_back(static_cast<float>(d_m / ray_C.norm()));
  }
  return image;
}

PointCloud points_of(const DepthImage& image) {
  const Intrinsics& camera = image.camera;
  PointCloud cloud_C;
  cloud_C.camera = camera;
  for (std::size_t pixel = 0; pixel < image.depth_m.size(); ++pixel) {
    const auto width = static_cast<std::size_t>(camera.width_px);
    const auto point =
        point_of_pixel((static_cast<double>(pixel % width) - camera.centre_x_px) / camera.focal_px,
                       (static_cast<double>(pixel / width) - camera.centre_y_px) / camera.focal_px,
                       static_cast<double>(image.depth_m[pixel]), scene_range_m);
    if (point) {
      (point->is_hit ? cloud_C.hits_C : cloud_C.clear_C).push_back(point->p_C);
    }
  }
  return cloud_C;
}

void to_world(Frame& frame) {
  const auto to_octomap = [](const Vec3& p) {
    const Eigen::Vector3f single = p.cast<float>();
    return octomap::point3d{single.x(), single.y(), single.z()};
  };
  const auto take = [&](const auto& points_C, auto& points_W) {
    for (const auto& p_C : points_C) {
      points_W.push_back(to_octomap(frame.X_WC * p_C.template cast<double>()));
      frame.points_W.push_back(points_W.back());
    }
  };
  take(frame.cloud_C.hits_C, frame.scan.hits_W);
  take(frame.cloud_C.clear_C, frame.scan.clear_W);
  frame.scan.origin_W = to_octomap(frame.X_WC.translation());
  frame.scan.range_m = scene_range_m;
}

}  // namespace

std::vector<Frame> frames_of(Scene scene, ImageSize size, int stride) {
  const Place place{scene};
  std::vector<Frame> frames;
  for (int i = 0; i < flight_frames; i += stride) {
    Frame frame;
    frame.X_WC = camera_at(scene, i);
    const DepthImage image = look(place, frame.X_WC, size);
    frame.cloud_C = points_of(image);
    frame.pixels.cloud_C = Deferred<PointCloud>::of(frame.cloud_C);
    frame.pixels.pixels = RangeImage{Deferred<DepthImage>::of(image), scene_range_m};
    to_world(frame);
    frames.push_back(std::move(frame));
  }
  return frames;
}

Aabb flight_space(Scene scene) {
  return scene == Scene::indoor ? Aabb{{-2, -15, 0}, {60, 15, 8}} : Aabb{{0, -20, 0}, {95, 20, 15}};
}

}  // namespace flyball::bench
