// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/kernels.h"
#include "flyball/kernels/localizer.h"
#include "flyball/runtime/registry.h"
#include "flyball/sim/imu.h"

#include "circle_flight.h"
#include "textured_camera.h"
#include <functional>
#include <limits>
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

using Motion = std::function<VehicleState(double t_s)>;

/// A localizer, and the flight that it goes along with.
struct Companion {
  explicit Companion(const kit::CircleRun& flown, std::uint64_t seed = 4)
      : Companion{[flown](double t_s) { return flown.at(t_s); }, seed} {}
  explicit Companion(Motion flown, std::uint64_t seed = 4) : at{std::move(flown)}, imu{{}, seed} {
    Registry registry;
    register_kernels(registry);
    localizer = registry.make<Localizer>("visual_inertial");
    localizer->start({});
    localizer->set_initial_pose(at(0.0).X_WB);
  }
  /// Adds the IMU's samples until the next frame, and tracks that, or darkness.
  VisualFix next(bool in_the_dark = false, bool with_depth = true) {
    const double t_s = frame_s * frames;
    while (imu_until_s <= t_s + 1e-9) {
      ImuSample sample = imu.sample(at(imu_until_s), MissionTime{from_seconds(imu_until_s)});
      sample.f_B.z() -= dropped_m_s2;
      localizer->add_imu_sample(sample);
      imu_until_s += imu_s;
    }
    const Pose X_WC = at(t_s).X_WB * kit::ahead_from_body();
    VisualFrame frame = camera().capture(X_WC, MissionTime{from_seconds(t_s)},
                                         static_cast<std::uint64_t>(frames++));
    frame.X_BC = kit::ahead_from_body();
    if (hangs) {
      frame.grey = last.grey;
      frame.depth_m = last.depth_m;
    }
    last = frame;
    if (in_the_dark) {
      std::fill(frame.grey.begin(), frame.grey.end(), std::uint8_t{0});
    }
    if (!with_depth) {
      frame.depth_m.clear();
    }
    const auto fix = localizer->track_frame(frame, work);
    EXPECT_TRUE(fix);
    miss_m = (fix->X_WB.translation() - X_WC.translation()).norm();
    return *fix;
  }

  Motion at;
  Imu imu;
  std::unique_ptr<Localizer> localizer;
  Work work;
  double imu_until_s{};
  double miss_m{};
  double dropped_m_s2{};  ///< A broken accelerometer.
  bool hangs{};           ///< The camera sends its last image again and again.
  VisualFrame last{};
  int frames{};
};

TEST(VisualInertial, says_what_it_needs) {
  const Companion companion{kit::CircleRun{}};
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

TEST(VisualInertial, does_not_believe_a_sample_that_no_sensor_can_mean) {
  Companion companion{{2.0, 0.3, false}};
  for (int i = 0; i < 10; ++i) {
    ImuSample broken = companion.imu.sample(companion.at(companion.imu_until_s),
                                            MissionTime{from_seconds(companion.imu_until_s)});
    broken.f_B.x() = i % 2 == 0 ? std::numeric_limits<double>::quiet_NaN() : 1e4;
    broken.w_WB_B.z() = i % 3 == 0 ? 1e6 : 0.0;
    companion.localizer->add_imu_sample(broken);
    EXPECT_TRUE(companion.next().tracked) << i;
  }
  EXPECT_LT(companion.miss_m, 0.06);
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

// It would take the image for a standstill, and be 12 m off after six seconds without a word.
TEST(VisualInertial, tells_when_the_camera_hangs_in_flight) {
  for (const bool with_depth : {true, false}) {
    Companion flight{kit::CircleRun{2.0, 0.5, true}};
    for (int i = 0; i < 40; ++i) {
      EXPECT_TRUE(flight.next(false, with_depth).tracked) << i;
    }
    const double before_m = flight.miss_m;
    flight.hangs = true;
    int goes_on = 0;
    while (goes_on < 60 && flight.next(false, with_depth).tracked) {
      ++goes_on;
    }
    EXPECT_LE(goes_on, 16) << "a second and a half";
    EXPECT_LT(flight.miss_m, before_m + 1.0);
  }
}

// With depth, what does not move in the image does not move; without this it took a second and a
// half, and 2.3 m.
TEST(VisualInertial, tells_when_the_accelerometer_contradicts_a_standstill_that_it_sees) {
  Companion companion{kit::CircleRun{0.0, 100.0, true}};
  for (int i = 0; i < 40; ++i) {
    EXPECT_TRUE(companion.next().tracked) << i;
  }
  companion.dropped_m_s2 = 2.0;
  int goes_on = 0;
  while (goes_on < 60 && companion.next().tracked) {
    ++goes_on;
  }
  EXPECT_LE(goes_on, 11) << "a second";
  EXPECT_LT(companion.miss_m, 1.5);
}

/// A vehicle that flies 2 m ahead within the first two and a half seconds, and stands from then on.
VehicleState stopping(double t_s, bool shakes) {
  constexpr double begin_s = 0.5;
  constexpr double moving_s = 2.0;
  constexpr double length_m = 2.0;
  VehicleState state;
  state.X_WB = kit::circle_pose(0.0) * kit::ahead_from_body().inverse();
  const Vec3 ahead_W = state.X_WB.linear().col(0);
  const double turn = kit::full_turn_rad / moving_s;
  const double s = std::clamp((t_s - begin_s) / moving_s, 0.0, 1.0);
  const double phase = kit::full_turn_rad * s;
  state.X_WB.translation() += length_m * (s - std::sin(phase) / kit::full_turn_rad) * ahead_W;
  state.v_WB = length_m / moving_s * (1.0 - std::cos(phase)) * ahead_W;
  state.a_WB = length_m / moving_s * turn * std::sin(phase) * ahead_W;
  if (shakes) {
    state.rotor_rev_s = {60.3, 61.7, 60.9, 61.2};
  }
  return state;
}

/// A vehicle in a hand: it sways by 1.5 cm to the side, and never quite stands.
VehicleState swaying(double t_s) {
  constexpr double half_m = 0.0075;
  constexpr double turn = kit::full_turn_rad / 2.0;
  VehicleState state;
  state.X_WB = kit::circle_pose(0.0) * kit::ahead_from_body().inverse();
  const Vec3 left_W = state.X_WB.linear().col(1);
  const double since_s = std::max(0.0, t_s - 0.5);
  state.X_WB.translation() += half_m * (1.0 - std::cos(turn * since_s)) * left_W;
  state.v_WB = half_m * turn * std::sin(turn * since_s) * left_W;
  state.a_WB = half_m * turn * turn * (since_s > 0.0 ? std::cos(turn * since_s) : 0.0) * left_W;
  return state;
}

// The IMU takes rotors that turn on the ground for motion; the images show none.
TEST(VisualInertial, stays_where_it_is_while_it_stands_and_shakes) {
  Companion companion{kit::CircleRun{0.0, 100.0, true}};
  for (int i = 0; i < 80; ++i) {
    const VisualFix fix = companion.next(false, false);
    EXPECT_TRUE(fix.tracked) << i;
    EXPECT_LT(companion.miss_m, 0.05) << i;
  }
}

TEST(VisualInertial, stays_where_it_is_in_a_hand_that_is_not_quite_still) {
  Companion companion{swaying};
  for (int i = 0; i < 80; ++i) {
    const VisualFix fix = companion.next(false, false);
    EXPECT_TRUE(fix.tracked) << i;
    EXPECT_LT(companion.miss_m, 0.05) << i;
  }
}

TEST(VisualInertial, stays_where_it_has_stopped) {
  for (const bool shakes : {false, true}) {
    Companion companion{[shakes](double t_s) { return stopping(t_s, shakes); }};
    double stopped_m = 0.0;
    for (int i = 0; i < 100; ++i) {
      const VisualFix fix = companion.next(false, false);
      EXPECT_TRUE(fix.tracked) << i;
      stopped_m = i == 30 ? companion.miss_m : stopped_m;
    }
    EXPECT_LT(companion.miss_m, stopped_m + 0.05) << shakes;
  }
}

TEST(VisualInertial, takes_the_same_image_again_for_a_standstill_where_it_feels_one) {
  Companion companion{[](double t_s) { return stopping(t_s, true); }};
  for (int i = 0; i < 100; ++i) {
    companion.hangs = i > 40;
    EXPECT_TRUE(companion.next().tracked) << i;
  }
  EXPECT_LT(companion.miss_m, 0.2);
}

/// A vehicle that only turns: .4 rad/s from half a second on.
VehicleState turning(double t_s) {
  constexpr double rate_rad_s = 0.4;
  VehicleState state;
  state.X_WB = kit::circle_pose(0.0) * kit::ahead_from_body().inverse();
  const double since_s = std::max(0.0, t_s - 0.5);
  state.X_WB.rotate(Eigen::AngleAxisd{rate_rad_s * since_s, Vec3::UnitZ()});
  state.w_WB_B = Vec3{0.0, 0.0, since_s > 0.0 ? rate_rad_s : 0.0};
  state.rotor_rev_s = {60.3, 61.7, 60.9, 61.2};
  return state;
}

// Turning shows corners in plenty, and without depth none of them says how fast the vehicle is.
TEST(VisualInertial, tells_when_nothing_that_it_sees_corrects_it_any_more) {
  Companion companion{turning};
  bool is_lost = false;
  for (int i = 0; i < 80 && !is_lost; ++i) {
    is_lost = !companion.next(false, false).tracked;
  }
  EXPECT_TRUE(is_lost);
  EXPECT_LT(companion.miss_m, 1.0) << "it has told in time";
}

// Within a factor of two of the standard deviation either way; five flights give no better a mean.
TEST(VisualInertial, knows_how_far_it_may_be_off) {
  double nees = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Companion companion{kit::CircleRun{2.0, 1.0, true}, seed};
    for (int i = 0; i < 60; ++i) {
      const VisualFix fix = companion.next();
      const Vec3 miss_W = fix.X_WB.translation() - companion.at(frame_s * i).X_WB.translation();
      if (i > 15) {
        nees += miss_W.dot(fix.covariance_W.ldlt().solve(miss_W));
        ++count;
      }
    }
  }
  EXPECT_GT(nees / count, 3.0 / 4.0);
  EXPECT_LT(nees / count, 3.0 * 4.0);
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
