// SPDX-License-Identifier: BSD-3-Clause
#include "sensors/solid_rays.h"

#include "flyball/runtime/camera_spec.h"
#include "flyball/runtime/random.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double range_m = 20.0;
constexpr double infinite = std::numeric_limits<double>::infinity();

const Intrinsics camera = pinhole(64, 40, 1.5);

World random_world(std::uint64_t seed) {
  RandomStream random{seed, "solids"};
  World world;
  world.ground_z_m = -2.0;
  for (int i = 0; i < 40; ++i) {
    const Vec3 low{random.uniform(-15.0, 15.0), random.uniform(-15.0, 15.0),
                   random.uniform(-3.0, 3.0)};
    const Vec3 size{random.uniform(0.01, 3.0), random.uniform(0.01, 3.0),
                    random.uniform(0.01, 3.0)};
    world.boxes.push_back({low, low + size});
    world.pillars.push_back({Vec3{random.uniform(-15.0, 15.0), random.uniform(-15.0, 15.0), -2.0},
                             random.uniform(0.02, 0.5), random.uniform(0.1, 6.0)});
  }
  return world;
}

Pose random_pose(std::uint64_t seed) {
  RandomStream random{seed, "pose"};
  Pose X_WC = Pose::Identity();
  const Vec3 axis{random.normal(), random.normal(), random.normal()};
  X_WC.linear() = Eigen::AngleAxisd{random.uniform(0.0, 6.0), axis.normalized()}.toRotationMatrix();
  X_WC.translation() = Vec3{random.uniform(-3.0, 3.0), random.uniform(-3.0, 3.0), 0.3};
  return X_WC;
}

/// Where a ray is in a solid, as depths.
struct Span {
  double enters{-infinite};
  double leaves{infinite};

  void cut(double a, double b) {
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  [[nodiscard]] double depth_m() const {
    const double depth_m = enters > 0.0 ? enters : leaves;
    return enters <= leaves && depth_m > 0.0 ? depth_m : infinite;
  }
};

double depth_of(const Aabb& box, const Vec3& p, const Vec3& way) {
  Span span;
  for (int i = 0; i < 3; ++i) {
    span.cut((box.min[i] - p[i]) / way[i], (box.max[i] - p[i]) / way[i]);
  }
  return span.depth_m();
}

double depth_of(const Pillar& pillar, const Vec3& p, const Vec3& way) {
  const Vec3 foot = pillar.foot_W - p;
  Span span;
  span.cut(foot.z() / way.z(), (foot.z() + pillar.height_m) / way.z());
  for (int pair = 0; pair < 12; ++pair) {
    const double angle = 3.141592653589793 / 12.0 * (pair + 0.5);
    const Vec3 out{std::cos(angle), std::sin(angle), 0.0};
    span.cut((out.dot(foot) - pillar.radius_m) / out.dot(way),
             (out.dot(foot) + pillar.radius_m) / out.dot(way));
  }
  return span.depth_m();
}

double nearest_m(const World& world, const Vec3& p, const Vec3& way) {
  double nearest = infinite;
  for (const Aabb& box : world.boxes) {
    nearest = std::min(nearest, depth_of(box, p, way));
  }
  for (const Pillar& pillar : world.pillars) {
    nearest = std::min(nearest, depth_of(pillar, p, way));
  }
  const double ground_m = (world.ground_z_m - p.z()) / way.z();
  nearest = ground_m > 0.0 ? std::min(nearest, ground_m) : nearest;
  return nearest <= range_m ? nearest : infinite;
}

std::vector<float> seen(const World& world, const Pose& X_WC, const RayLoops& loops) {
  std::vector<float> depth_m(64 * 40, -1.0F);
  SolidRays{world, loops}.look(camera, X_WC, range_m, depth_m.data());
  return depth_m;
}

/// Beside an edge a float's rounding decides what is seen: anything that rays a little beside see.
bool is_right(const World& world, const Pose& X_WC, int x, int y, double depth_m) {
  constexpr double beside_px = 1e-3;
  for (const double du : {0.0, -beside_px, beside_px}) {
    for (const double dv : {0.0, -beside_px, beside_px}) {
      const Vec3 way_C{(x + du - camera.centre_x_px) / camera.focal_px,
                       (y + dv - camera.centre_y_px) / camera.focal_px, 1.0};
      const double truth_m = nearest_m(world, X_WC.translation(), X_WC.linear() * way_C);
      if (truth_m == depth_m || std::abs(truth_m - depth_m) < 1e-4 * (1.0 + depth_m)) {
        return true;
      }
    }
  }
  return false;
}

TEST(SolidRays, meet_what_a_search_over_all_solids_finds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const World world = random_world(seed);
    const Pose X_WC = random_pose(seed);
    const std::vector<float> depth_m = seen(world, X_WC, *supported_ray_loops().back());
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const auto pixel = static_cast<std::size_t>(y * camera.width_px + x);
        ASSERT_TRUE(is_right(world, X_WC, x, y, static_cast<double>(depth_m[pixel])))
            << "seed " << seed << " at " << x << ", " << y << ": " << depth_m[pixel];
      }
    }
  }
}

TEST(SolidRays, are_the_same_bits_by_every_instruction_set) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const World world = random_world(seed);
    const Pose X_WC = random_pose(seed);
    const std::vector<float> depth_m = seen(world, X_WC, *supported_ray_loops().front());
    for (const RayLoops* loops : supported_ray_loops()) {
      EXPECT_EQ(seen(world, X_WC, *loops), depth_m);
    }
  }
}

TEST(SolidRays, find_no_slit_between_solids_that_touch) {
  World world;
  world.has_ground = false;
  for (int y = -40; y < 40; ++y) {
    for (int z = -40; z < 40; ++z) {
      const Vec3 low{3.0, 0.15 * y, 0.15 * z};
      world.boxes.push_back({low, {3.15, 0.15 * (y + 1), 0.15 * (z + 1)}});
    }
  }
  Pose X_WC = Pose::Identity();
  X_WC.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  for (const float depth_m : seen(world, X_WC, *supported_ray_loops().back())) {
    ASSERT_NEAR(depth_m, 3.0F, 1e-5F);
  }
}

TEST(SolidRays, see_the_far_side_of_the_solid_that_they_start_in) {
  World world;
  world.has_ground = false;
  world.boxes = {{{-1.0, -1.0, -1.0}, {1.0, 1.0, 2.0}}};
  const std::vector<float> depth_m = seen(world, Pose::Identity(), *supported_ray_loops().back());
  EXPECT_NEAR(depth_m[20 * 64 + 32], 2.0F, 1e-5F);  // Straight up.
}

TEST(SolidRays, meet_people_who_stand_and_not_those_who_walk) {
  World world;
  world.has_ground = false;
  Person person;
  person.radius_m = 0.3;
  person.height_m = 1.8;
  person.walk = {{0.0, Vec3{4.0, 0.0, -1.0}}};
  world.people = {person};
  Pose X_WC = Pose::Identity();
  X_WC.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const std::vector<float> standing = seen(world, X_WC, *supported_ray_loops().back());
  EXPECT_NEAR(*std::min_element(standing.begin(), standing.end()), 3.7F,
              0.01F);  // Beside its middle.
  world.people[0].walk.push_back({1.0, Vec3{4.0, 1.0, -1.0}});
  const std::vector<float> walking = seen(world, X_WC, *supported_ray_loops().back());
  EXPECT_TRUE(std::all_of(walking.begin(), walking.end(),
                          [](float depth_m) { return std::isinf(depth_m); }));
}

}  // namespace
}  // namespace flyball
