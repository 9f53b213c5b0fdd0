// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "flyball/governors/learned_latency.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double top_hz = 2e9;
constexpr MapSetting coarse{0.80, 12.0, top_hz};

LearnedLatency learner(const LearnedLatencySettings& settings = {}) {
  return {settings, {{0.15, 0.5, 2.2}, {0.80, 0.1, 1.0}}, {0.15, 7.0, top_hz}, Hertz{top_hz}};
}

MissionTime at(double t_s) {
  return MissionTime{from_seconds(t_s)};
}

/// What the map shows at a time of its newest frame.
Observation seen_map(double t_s, std::uint64_t revision, double resolution_m, double latency_s) {
  Observation seen;
  seen.now = at(t_s);
  seen.map_revision = revision;
  seen.map_resolution_m = resolution_m;
  seen.latency = from_seconds(latency_s);
  seen.frequency = Hertz{top_hz};
  return seen;
}

TEST(LatencyLevels, latencies_lie_on_a_line_between_the_two_that_are_known) {
  const auto levels = levels_between({0.15, 0.30, 0.60}, 0.8, 0.2);
  ASSERT_EQ(levels.size(), 3U);
  EXPECT_DOUBLE_EQ(levels[0].latency_s, 0.8);
  EXPECT_NEAR(levels[1].latency_s, 0.4, 1e-12);  // Their geometric mean.
  EXPECT_DOUBLE_EQ(levels[2].latency_s, 0.2);
  EXPECT_NEAR(levels[1].range_slope, 0.5 * (levels[0].range_slope + levels[2].range_slope), 1e-12);
  EXPECT_GT(levels[0].range_slope, levels[2].range_slope);
}

TEST(LatencyLevels, a_single_one_has_the_fine_latency) {
  const auto levels = levels_between({0.3}, 0.8, 0.2);
  ASSERT_EQ(levels.size(), 1U);
  EXPECT_DOUBLE_EQ(levels[0].latency_s, 0.8);
}

// By hand: (14 / 7) ^ 2.2 is 4.59; half the clock takes (.9 / 1 + .05) / (.9 / 2 + .05) = 1.9
// times.
TEST(LearnedLatency, predicts_what_it_was_told_until_it_has_learned_something) {
  const LearnedLatency one = learner();
  EXPECT_NEAR(one.predicted_s({0.15, 7.0, top_hz}), 0.5, 1e-9);
  EXPECT_NEAR(one.predicted_s({0.15, 14.0, top_hz}), 2.297, 1e-3);
  EXPECT_NEAR(one.predicted_s({0.80, 7.0, 0.5 * top_hz}), 0.19, 1e-9);
  EXPECT_NEAR(one.predicted_s({0.20, 7.0, top_hz}), 0.5, 1e-9) << "as of the nearest level";
  EXPECT_NEAR(one.bounded_s({0.15, 7.0, top_hz}), 0.5 * std::exp(0.4), 1e-9);
}

TEST(LearnedLatency, does_not_learn_from_a_frame_of_the_setting_before) {
  LearnedLatency one = learner();
  one.put_in_force(coarse, at(10.0));
  const double before_s = one.predicted_s(coarse);
  one.learn(seen_map(10.2, 1, 0.80, 5.0));  // captured at 5.2 s
  one.learn(seen_map(10.4, 2, 0.15, 0.1));  // of another level
  EXPECT_EQ(one.predicted_s(coarse), before_s);
}

TEST(LearnedLatency, learns_from_a_frame_of_the_range_before_what_that_range_takes) {
  LearnedLatency one = learner();
  one.put_in_force(coarse, at(1.0));
  one.put_in_force({0.80, 7.0, top_hz}, at(10.0));
  const double before_s = one.predicted_s(coarse);
  Observation late = seen_map(10.2, 1, 0.80, 5.0);  // Captured at 5.2 s.
  for (const double absurd_m : {-1.0, 0.0, 1e-300, 1e300, std::nan("")}) {
    late.map_range_m = absurd_m;
    late.map_revision += 10;
    one.learn(late);
    EXPECT_EQ(one.predicted_s(coarse), before_s) << absurd_m;
  }
  late.map_range_m = 12.0;
  late.map_revision = 1;
  one.learn(late);
  const double after_s = one.predicted_s(coarse);
  EXPECT_GT(after_s, 2.0 * before_s);
  one.put_in_force({0.15, 7.0, top_hz}, at(11.0));
  one.put_in_force({0.80, 7.0, top_hz}, at(12.0));
  Observation rebuilt = seen_map(12.5, 2, 0.80, 50.0);  // Captured with smaller cells in force.
  rebuilt.map_range_m = 12.0;
  one.learn(rebuilt);
  EXPECT_EQ(one.predicted_s(coarse), after_s);
}

std::uint64_t issued_with(const LearnedLatency& one, double resolution_m) {
  for (const LevelBounds& level : one.bound_levels()) {
    if (level.resolution_m == resolution_m) {
      return level.issued;
    }
  }
  return 0;
}

TEST(LearnedLatency, counts_a_map_that_never_comes_as_a_miss) {
  LearnedLatency one = learner();
  one.put_in_force(coarse, at(1.0));
  one.learn(seen_map(2.0, 1, 0.80, 0.1));
  one.learn(seen_map(3.0, 1, 0.80, 0.1));
  EXPECT_EQ(one.bounds().late, 1U);
  EXPECT_EQ(issued_with(one, 0.80), 1U);
  EXPECT_EQ(issued_with(one, 0.15), 0U);
}

/// Maps of .8 m, one in each of `n` looks, `period_s` apart.
void see_maps(LearnedLatency& one, int n, double period_s, double latency_s, double from_s = 1.0) {
  for (int i = 0; i < n; ++i) {
    const double t_s = from_s + i * period_s;
    one.learn(seen_map(t_s, static_cast<std::uint64_t>(t_s * 1e3), 0.80, latency_s));
    one.put_in_force(coarse, at(t_s));
  }
}

KnobSpec rate_knob(const char* name, double hz) {
  return {name, "Hz", "mapper", {}, 0.1, 240.0, hz};
}

TEST(FrameInterval, is_the_cameras_behind_the_limits_of_its_rate) {
  DepthCameraSpec camera;
  camera.rate_hz = 20.0;
  EXPECT_EQ(frame_interval_s({}, KnobSettings{}), 0.05) << "nothing is known";
  EXPECT_EQ(frame_interval_s(camera, KnobSettings{}), 0.05);
  EXPECT_EQ(frame_interval_s(camera, KnobSettings{{rate_knob("map.rate_hz", 20.0)}}), 0.05);
  EXPECT_DOUBLE_EQ(frame_interval_s(camera, KnobSettings{{rate_knob("map.rate_hz", 15.0)}}), 0.1)
      << "each other frame";
  EXPECT_DOUBLE_EQ(frame_interval_s({}, KnobSettings{{rate_knob("map.rate_hz", 2.0)}}), 0.5);
  EXPECT_DOUBLE_EQ(frame_interval_s(camera, KnobSettings{{rate_knob("camera.rate_hz", 4.0),
                                                          rate_knob("map.rate_hz", 2.0)}}),
                   0.5);
  camera.rate_hz = 0.5;
  EXPECT_DOUBLE_EQ(frame_interval_s(camera, KnobSettings{{rate_knob("map.rate_hz", 2.0)}}), 2.0);
}

/// The factor of the bound after five minutes of maps that take .1 s each, two seconds apart, of a
/// policy that decides four times a second.
double factor_of_rare_maps(double frame_s) {
  LearnedLatencySettings settings;
  settings.frame_s = frame_s;
  LearnedLatency one = learner(settings);
  one.put_in_force(coarse, at(0.0));
  for (int look = 1; look <= 1200; ++look) {
    const int map = (look + 7) / 8;
    one.learn(seen_map(0.25 * look, static_cast<std::uint64_t>(map), 0.80, 0.1));
  }
  return one.bounds().factor;
}

TEST(LearnedLatency, bounds_the_latency_and_not_the_wait_for_a_frame) {
  EXPECT_LT(factor_of_rare_maps(2.0), 1.5);
  EXPECT_GT(factor_of_rare_maps(0.05), 3.0) << "what an interval that is not so comes to";
}

TEST(LearnedLatency, learns_that_the_computer_is_slower_than_was_said) {
  LearnedLatency one = learner();
  see_maps(one, 60, 1.0, 0.6);
  EXPECT_GT(one.predicted_s(coarse), 0.5);
  EXPECT_LT(one.predicted_s(coarse), 1.0);
}

TEST(LearnedLatency, a_map_that_was_quick_is_in_time_however_seldom_it_is_looked_for) {
  LearnedLatency one = learner();
  see_maps(one, 100, 0.25, 0.01);
  EXPECT_GT(one.bounds().issued, 90U);
  EXPECT_LT(one.bounds().late, 8U);
}

TEST(LearnedLatency, keeps_its_bounds_apart_by_level) {
  LearnedLatency one = learner();
  see_maps(one, 100, 0.25, 0.01);
  std::uint64_t issued = 0;
  for (const LevelBounds& level : one.bound_levels()) {
    issued += level.issued;
    EXPECT_EQ(level.issued > 0, level.resolution_m == 0.80) << level.resolution_m;
    ASSERT_TRUE(level.most_late);
    EXPECT_LE(static_cast<double>(level.late), *level.most_late);
  }
  EXPECT_EQ(issued, one.bounds().issued);
}

TEST(LearnedLatency, a_map_that_does_not_come_is_late_once) {
  LearnedLatency one = learner();
  see_maps(one, 20, 0.25, 0.1);
  const BoundCount before = one.bounds();
  Observation seen = seen_map(6.0, 5750, 0.80, 0.1);  // The last map that was seen.
  for (int i = 0; i < 8; ++i) {
    seen.now += std::chrono::milliseconds{250};
    one.learn(seen);
  }
  EXPECT_EQ(one.bounds().issued, before.issued + 1);
  EXPECT_EQ(one.bounds().late, before.late + 1);
}

TEST(LearnedLatency,
     with_a_constant_margin_is_late_for_good_when_costs_triple_and_nothing_is_learned) {
  LearnedLatencySettings once;
  once.bound.eta = 0.0;
  once.bound.first = std::log(1.3);
  once.learn_s = 26.0;
  LearnedLatency kept = learner(once);
  LearnedLatency calibrated = learner();
  for (LearnedLatency* one : {&kept, &calibrated}) {
    see_maps(*one, 100, 0.25, 0.1);
    const BoundCount calm = one->bounds();
    EXPECT_LE(calm.late, 10U);
    see_maps(*one, 50, 0.5, 0.3, 30.0);
    const BoundCount settled = one->bounds();
    see_maps(*one, 200, 0.5, 0.3, 60.0);
    const auto late = one->bounds().late - settled.late;
    const auto issued = one->bounds().issued - settled.issued;
    ASSERT_GT(issued, 190U);
    if (one == &kept) {
      EXPECT_EQ(late, issued);
      EXPECT_DOUBLE_EQ(one->bounds().factor, 1.3);
    } else {
      EXPECT_LE(static_cast<double>(late), 0.1 * static_cast<double>(issued));
    }
  }
}

TEST(LearnedLatency, learns_for_so_long_from_its_first_look_on_whatever_the_clock_shows_then) {
  LearnedLatencySettings half_a_minute;
  half_a_minute.learn_s = 30.0;
  LearnedLatency one = learner(half_a_minute);
  const auto shown_s = [&one](double t_s, std::uint64_t revision, double latency_s) {
    one.learn(seen_map(t_s, revision, 0.15, latency_s));
    return one.predicted_s({0.15, 7.0, top_hz});
  };
  constexpr double since_boot_s = 1e5;
  const double told_s = shown_s(since_boot_s, 1, 0.3);
  const double learned_s = shown_s(since_boot_s + 29.0, 2, 0.3);
  EXPECT_LT(learned_s, told_s);
  EXPECT_EQ(shown_s(since_boot_s + 31.0, 3, 0.1), learned_s);
}

TEST(LearnedLatency, a_slower_clock_than_asked_for_moves_the_bound) {
  LearnedLatencySettings constant;
  constant.bound.eta = 0.0;
  constant.bound.first = std::log(1.3);
  LearnedLatency one = learner(constant);
  see_maps(one, 40, 0.25, 0.1);
  const BoundCount before = one.bounds();
  for (int i = 0; i < 10; ++i) {
    Observation seen = seen_map(20.0 + 0.5 * i, static_cast<std::uint64_t>(90000 + i), 0.80, 0.19);
    seen.frequency = Hertz{0.5 * top_hz};  // .9 / 1 + .05 instead of .9 / 2 + .05: 1.9 times.
    one.learn(seen);
    one.put_in_force(coarse, seen.now);
  }
  EXPECT_GE(one.bounds().issued, before.issued + 9);
  EXPECT_EQ(one.bounds().late, before.late);
}

}  // namespace
}  // namespace flyball
