// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/kernels.h"
#include "flyball/kernels/localizer.h"
#include "flyball/runtime/registry.h"
#include "flyball/sim/imu.h"

#include "circle_flight.h"
#include "textured_camera.h"
#include <memory>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double frame_s = 0.1;
constexpr double imu_s = 0.005;

const kit::TexturedCamera& camera() {
  static const kit::TexturedCamera made = [] {
    DepthCameraSpec spec;
    spec.width_px = 192;
    spec.height_px = 144;
    return kit::TexturedCamera{kit::circle_world(3), spec, 3};
  }();
  return made;
}

/// A localizer, and the flight that it goes along with.
struct Companion {
  explicit Companion(const kit::CircleRun& flown) : run{flown} {
    Registry registry;
    register_kernels(registry);
    localizer = registry.make<Localizer>("visual_inertial");
    localizer->start({});
    localizer->place(run.at(0.0).X_WB);
  }
  /// Feels until the next frame, and sees it, or darkness.
  VisualFix next(bool in_the_dark = false, bool with_depth = true) {
    const double t_s = frame_s * frames;
    while (felt_s <= t_s + 1e-9) {
      ImuSample felt = imu.sample(run.at(felt_s), MissionTime{from_seconds(felt_s)});
      felt.f_B.z() -= dropped_m_s2;
      localizer->feel(felt);
      felt_s += imu_s;
    }
    const Pose X_WC = run.at(t_s).X_WB * kit::ahead_from_body();
    VisualFrame frame = camera().capture(X_WC, MissionTime{from_seconds(t_s)},
                                         static_cast<std::uint64_t>(frames++));
    frame.X_BC = kit::ahead_from_body();
    if (in_the_dark) {
      std::fill(frame.grey.begin(), frame.grey.end(), std::uint8_t{0});
    }
    if (!with_depth) {
      frame.depth_m.clear();
    }
    const auto fix = localizer->see(frame, work);
    EXPECT_TRUE(fix);
    miss_m = (fix->X_WB.translation() - X_WC.translation()).norm();
    return *fix;
  }

  kit::CircleRun run;
  Imu imu{{}, 4};
  std::unique_ptr<Localizer> localizer;
  Work work;
  double felt_s{};
  double miss_m{};
  double dropped_m_s2{};  ///< A broken accelerometer.
  int frames{};
};

TEST(VisualInertial, says_what_it_needs) {
  const Companion companion{{}};
  EXPECT_TRUE(companion.localizer->inputs().images);
  EXPECT_TRUE(companion.localizer->inputs().imu);
  EXPECT_FALSE(companion.localizer->inputs().depth) << "it uses depth, but does without";
}

TEST(VisualInertial, follows_a_start_from_rest) {
  Companion companion{{2.0, 0.3, false}};
  for (int i = 0; i < 25; ++i) {
    const VisualFix fix = companion.next();
    EXPECT_TRUE(fix.tracked);
    EXPECT_LT(companion.miss_m, 0.06) << i;
  }
  EXPECT_NEAR(companion.next().v_WB.norm(), 2.0, 0.1);
  EXPECT_GT(companion.work.count("tracks"), 100);
  EXPECT_GT(companion.work.count("filter_updates"), 1000);
}

TEST(VisualInertial, does_without_depth) {
  Companion companion{{2.0, 0.3, false}};
  for (int i = 0; i < 25; ++i) {
    EXPECT_TRUE(companion.next(false, false).tracked);
  }
  EXPECT_LT(companion.miss_m, 0.15);
}

// The vibration of real rotors, 3 m/s^2, is three times the acceleration of the start.
TEST(VisualInertial, follows_although_it_shakes) {
  Companion companion{{2.0, 0.3, true}};
  for (int i = 0; i < 25; ++i) {
    EXPECT_TRUE(companion.next().tracked);
  }
  EXPECT_LT(companion.miss_m, 0.12);
}

TEST(VisualInertial, goes_on_in_the_dark_for_a_second_but_not_for_three) {
  Companion companion{{2.0, 0.3, false}};
  for (int i = 0; i < 15; ++i) {
    (void)companion.next();
  }
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(companion.next(true).tracked) << i;
  }
  EXPECT_LT(companion.miss_m, 0.25);
  for (int i = 0; i < 6; ++i) {
    (void)companion.next(true);
  }
  EXPECT_FALSE(companion.next(true).tracked);
}

TEST(VisualInertial, knows_that_it_has_failed_when_what_it_feels_is_absurd) {
  Companion flight{{2.0, 0.3, false}};
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(flight.next().tracked) << i;
  }
  flight.dropped_m_s2 = 15.0;  // As if it fell with more than gravity.
  bool is_lost = false;
  for (int i = 0; i < 20 && !is_lost; ++i) {
    is_lost = !flight.next().tracked;
  }
  EXPECT_TRUE(is_lost);
  flight.dropped_m_s2 = 0.0;
  EXPECT_FALSE(flight.next().tracked) << "it knows no place that it could find again";
}

TEST(VisualInertial, gives_the_same_answer_twice) {
  const auto fly = [] {
    Companion companion{{2.0, 0.1, true}};
    VisualFix last;
    for (int i = 0; i < 8; ++i) {
      last = companion.next();
    }
    return last.X_WB.matrix().eval();
  };
  EXPECT_EQ(fly(), fly());
}

}  // namespace
}  // namespace flyball
