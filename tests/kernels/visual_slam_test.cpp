// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "flyball/kernels/kernels.h"
#include "flyball/kernels/localizer.h"
#include "flyball/runtime/atmosphere.h"
#include "flyball/runtime/registry.h"

#include "circle_flight.h"
#include "textured_camera.h"
#include <memory>

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::unique_ptr<Localizer> make() {
  Registry registry;
  register_kernels(registry);
  auto localizer = registry.make<Localizer>("visual_slam");
  localizer->start({});
  localizer->set_initial_pose(kit::circle_pose(0.0));
  return localizer;
}

/// Small images: a test has milliseconds.
const kit::TexturedCamera& camera() {
  static const kit::TexturedCamera made = [] {
    DepthCameraSpec spec;
    spec.width_px = 224;
    spec.height_px = 168;
    return kit::TexturedCamera{kit::circle_world(1), spec, 1};
  }();
  return made;
}

struct Clock {
  int frames{};
  VisualFrame look(const Pose& X_WC) {
    const int i = frames++;
    return camera().capture(X_WC, MissionTime{from_seconds(0.1 * i)},
                            static_cast<std::uint64_t>(i));
  }
};

double miss_m(const VisualFix& fix, const Pose& X_WC) {
  return (fix.X_WB.translation() - X_WC.translation()).norm();
}

TEST(VisualSlam, follows_a_slow_flight) {
  const auto localizer = make();
  Clock clock;
  Work work;
  for (int i = 0; i < 12; ++i) {
    const Pose X_WC = kit::circle_pose(0.2 * i);
    const auto fix = localizer->track_frame(clock.look(X_WC), work);
    ASSERT_TRUE(fix) << fix.error().message;
    ASSERT_TRUE(fix->tracked) << i;
    EXPECT_LT(miss_m(*fix, X_WC), 0.08) << i;
    if (i > 6) {
      EXPECT_NEAR(fix->v_WB.norm(), 2.0, 0.5);
    }
  }
  EXPECT_EQ(work.count("pixels"), 12 * 224 * 168);
  EXPECT_GT(work.count("features"), 12 * 100);
  EXPECT_GT(work.count("matches"), 1000);
  EXPECT_GT(work.count("ransac_iterations"), 11);
}

TEST(VisualSlam, refuses_images_of_another_camera) {
  DepthCameraSpec spec;
  spec.width_px = 112;
  spec.height_px = 84;
  const kit::TexturedCamera smaller{kit::circle_world(1), spec, 1};
  const auto localizer = make();
  Clock clock;
  Work work;
  ASSERT_TRUE(localizer->track_frame(clock.look(kit::circle_pose(0.0)), work));
  const auto fix = localizer->track_frame(
      smaller.capture(kit::circle_pose(0.1), MissionTime{from_seconds(0.1)}, 1), work);
  ASSERT_FALSE(fix);
  EXPECT_EQ(fix.error().message,
            "a frame of 9408 pixels follows frames of 37632; one localizer takes the images of one "
            "camera");
  const auto next = localizer->track_frame(clock.look(kit::circle_pose(0.1)), work);
  EXPECT_TRUE(next && next->tracked) << "it goes on with its own";
}

/// How large errors are beside what was expected of them, over flights of 20 m in four worlds.
struct Consistency {
  double nees{};  ///< Mean of the normalized estimation error squared; 3 where all is as expected.
  double within{};  ///< Share of the errors within the 95 % quantile.
  double worst_m{};
  double worst_sigma_m{};
};

Consistency consistency(double step_m, double step_s) {
  constexpr double quantile = 7.81;
  Consistency found;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    DepthCameraSpec spec;
    spec.width_px = 224;
    spec.height_px = 168;
    const kit::TexturedCamera rgbd{kit::circle_world(seed), spec, seed};
    const auto localizer = make();
    Work work;
    for (int i = 0; step_m * i < 20.0; ++i) {
      const Pose X_WC = kit::circle_pose(step_m * i);
      const auto fix = localizer->track_frame(
          rgbd.capture(X_WC, MissionTime{from_seconds(step_s * i)}, static_cast<std::uint64_t>(i)),
          work);
      if (i > 0 && fix && fix->tracked) {
        const Vec3 miss = fix->X_WB.translation() - X_WC.translation();
        const double nees = miss.dot(fix->covariance_W.ldlt().solve(miss));
        found.nees += nees;
        found.within += nees < quantile ? 1.0 : 0.0;
        found.worst_m = std::max(found.worst_m, miss.norm());
        found.worst_sigma_m = std::max(found.worst_sigma_m, fix->sigma_m());
        ++count;
      }
    }
  }
  found.nees /= count;
  found.within /= count;
  return found;
}

// Within a factor of two of the standard deviation either way. Errors along a path are one draw, so
// that four flights give no better a mean.
TEST(VisualSlam, knows_how_far_it_may_be_off) {
  for (const double step_s : {1.0, 0.1}) {
    const Consistency found = consistency(1.0 * std::sqrt(step_s), step_s);
    EXPECT_GT(found.nees, 3.0 / 4.0) << step_s;
    EXPECT_LT(found.nees, 3.0 * 4.0) << step_s;
    EXPECT_GT(found.within, 0.8) << step_s;
  }
}

TEST(VisualSlam, does_not_take_a_view_a_second_for_a_good_one) {
  const Consistency seldom = consistency(1.0, 1.0);
  EXPECT_GT(seldom.worst_m, 0.2);
  EXPECT_GT(seldom.worst_sigma_m, 0.2);
}

TEST(VisualSlam, says_when_it_is_lost_and_finds_a_place_again_that_it_knows) {
  const auto localizer = make();
  Clock clock;
  Work work;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(localizer->track_frame(clock.look(kit::circle_pose(0.2 * i)), work)->tracked);
  }
  const auto away = localizer->track_frame(clock.look(kit::circle_pose(80.0)), work);
  ASSERT_TRUE(away);
  EXPECT_FALSE(away->tracked) << "nothing of that was ever seen";
  const auto still_away = localizer->track_frame(clock.look(kit::circle_pose(80.2)), work);
  EXPECT_FALSE(still_away->tracked);
  const Pose X_WC = kit::circle_pose(0.3);
  const auto back = localizer->track_frame(clock.look(X_WC), work);
  ASSERT_TRUE(back->tracked);
  EXPECT_LT(miss_m(*back, X_WC), 0.08);
}

double features_with(const std::map<std::string, ParameterValue>& given) {
  Registry registry;
  register_kernels(registry);
  const auto localizer = registry.make<Localizer>("visual_slam");
  const auto chosen = Parameters::resolve("visual_slam", localizer->parameters(), given);
  EXPECT_TRUE(localizer->configure(std::get<Parameters>(chosen), no_models));
  localizer->start({});
  localizer->set_initial_pose(kit::circle_pose(0.0));
  Work work;
  (void)localizer->track_frame(Clock{}.look(kit::circle_pose(0.0)), work).value();
  return work.count("features");
}

NavigationSample sample_at(double t_s, double height_m) {
  NavigationSample sample;
  sample.stamp = MissionTime{from_seconds(t_s)};
  sample.q_WB_ahrs = Eigen::Quaterniond{kit::circle_pose(0.0).linear()};
  sample.pressure_pa = standard_pressure_pa(height_m);
  return sample;
}

TEST(VisualSlam, begins_a_young_map_anew_where_the_vehicle_is_reckoned_to_be) {
  const auto localizer = make();
  Clock clock;
  Work work;
  PoseEstimate reckoned = localizer->estimate(sample_at(0.0, 400.0), work).value();
  ASSERT_TRUE(localizer->track_frame(clock.look(kit::circle_pose(0.0)), work)->tracked);
  for (int i = 1; i <= 300; ++i) {
    reckoned = localizer->estimate(sample_at(0.01 * i, 400.0 + 0.01 * i), work).value();
  }
  clock.frames = 30;
  Pose X_WC = kit::circle_pose(20.0);  // It sees nothing that it knows.
  VisualFrame frame = clock.look(X_WC);
  frame.X_WB_reckoned = reckoned.X_WB;
  const auto fix = localizer->track_frame(frame, work);
  ASSERT_TRUE(fix);
  EXPECT_TRUE(fix->tracked);
  EXPECT_NEAR(fix->X_WB.translation().z(), kit::circle_pose(0.0).translation().z() + 3.0, 0.05);
  EXPECT_EQ(fix->keyframes, 1);
}

TEST(VisualSlam, begins_no_map_anew_where_nobody_knows_the_height) {
  const auto localizer = make();
  Clock clock;
  Work work;
  ASSERT_TRUE(localizer->track_frame(clock.look(kit::circle_pose(0.0)), work)->tracked);
  const auto fix = localizer->track_frame(clock.look(kit::circle_pose(20.0)), work);
  ASSERT_TRUE(fix);
  EXPECT_FALSE(fix->tracked);
}

TEST(VisualSlam, looks_for_as_many_corners_as_it_is_told) {
  EXPECT_EQ(features_with({}), 224 * 168 / 96) << "the painted world has more than are wanted";
  EXPECT_EQ(features_with({{"pixels_per_feature", 192.0}}), 224 * 168 / 192);
}

TEST(VisualSlam, strong_corners_hide_weak_ones_and_only_they_do) {
  const ParameterValue many{16.0};
  const double all = features_with({{"pixels_per_feature", many}});
  const double mixed = features_with({{"pixels_per_feature", many}, {"strong_corner", 60.0}});
  const double strong =
      features_with({{"pixels_per_feature", many}, {"weak_corner", 60.0}, {"strong_corner", 60.0}});
  EXPECT_LT(mixed, all);
  EXPECT_GT(mixed, strong) << "parts of the image without a strong one show weak ones";
  EXPECT_GT(strong, 15);
}

TEST(VisualSlam, gives_the_same_answer_twice) {
  const auto fly = [] {
    const auto localizer = make();
    Clock clock;
    Work work;
    VisualFix last;
    for (int i = 0; i < 4; ++i) {
      last = *localizer->track_frame(clock.look(kit::circle_pose(0.3 * i)), work);
    }
    return last;
  };
  const VisualFix one = fly();
  const VisualFix two = fly();
  EXPECT_EQ(one.X_WB.matrix(), two.X_WB.matrix());
  EXPECT_EQ(one.inliers, two.inliers);
}

TEST(VisualSlam, starts_nowhere_without_features) {
  const auto localizer = make();
  VisualFrame blank;
  blank.camera = {64, 48, 32.0, 32.0, 31.5, 23.5, {}};
  blank.grey.assign(64 * 48, 128);
  blank.depth_m.assign(64 * 48, 3.0F);
  Work work;
  const auto fix = localizer->track_frame(blank, work);
  ASSERT_TRUE(fix);
  EXPECT_FALSE(fix->tracked);
  EXPECT_EQ(fix->keyframes, 0);
}

TEST(VisualSlam, refuses_a_frame_of_another_size_than_its_camera) {
  const auto localizer = make();
  VisualFrame broken;
  broken.camera = {64, 48, 32.0, 32.0, 31.5, 23.5, {}};
  broken.grey.assign(100, 128);
  Work work;
  const auto fix = localizer->track_frame(broken, work);
  ASSERT_FALSE(fix);
  EXPECT_EQ(fix.error().code, ErrorCode::invalid_input);
  EXPECT_NE(fix.error().message.find("64 x 48"), std::string::npos);
}

}  // namespace
}  // namespace flyball
