// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/guard.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Free up to a plane x = `wall_m`, behind which every cell is in `beyond`.
class HalfSpace final : public OccupancyView {
 public:
  HalfSpace(double wall_m, CellState beyond) : wall_m_{wall_m}, beyond_{beyond} {}
  [[nodiscard]] double resolution_m() const override { return 0.1; }
  [[nodiscard]] CellState state(const Vec3& p_W) const override {
    return p_W.x() < wall_m_ ? CellState::free : beyond_;
  }
  [[nodiscard]] CellState body_state(const Vec3& p_WB, const Cylinder& body) const override {
    return state(p_WB + body.radius_m * Vec3::UnitX());
  }
  [[nodiscard]] bool has_occupied(const Aabb& box) const override {
    return state(box.max) == CellState::occupied;
  }
  [[nodiscard]] bool segment_hits(const Vec3& from,
                                  const Vec3& to,
                                  const Cylinder& body) const override {
    return body_state(from, body) == CellState::occupied ||
           body_state(to, body) == CellState::occupied;
  }
  [[nodiscard]] double obstacle_density(const Vec3&, double, double) const override { return 0.0; }
  [[nodiscard]] double nearest_obstacle_m(const Vec3&, double limit_m, double) const override {
    return limit_m;
  }

 private:
  double wall_m_;
  CellState beyond_;
};

constexpr Cylinder body{0.5, 0.2};

class KnownFreeDistance : public testing::Test {
 protected:
  const Path path = Path::polyline({Vec3::Zero(), 20.0 * Vec3::UnitX()});
  const Path nowhere{};
};

TEST(SafeSpeed, agrees_with_the_paper) {
  // MAVBench: 8.83 to 1.57 m/s for 0 to 4 s
  EXPECT_NEAR(safe_speed(6.0, 0.0, 6.5), 8.83, 0.005);
  EXPECT_NEAR(safe_speed(6.0, 4.0, 6.5), 1.57, 0.005);
}

TEST(SafeSpeed, is_the_root_of_reaction_and_braking_distance) {
  for (const double a : {0.5, 6.0}) {
    for (const double delta : {0.0, 0.1, 4.0, 1e4}) {
      for (const double d : {0.01, 1.0, 50.0}) {
        const double v = safe_speed(a, delta, d);
        EXPECT_NEAR(v * delta + v * v / (2.0 * a), d, 1e-9 * d);
      }
    }
  }
}

TEST(SafeSpeed, is_zero_without_distance) {
  EXPECT_EQ(safe_speed(6.0, 1.0, 0.0), 0.0);
  EXPECT_EQ(safe_speed(6.0, 1.0, -3.0), 0.0);
  EXPECT_EQ(safe_speed(6.0, 0.0, 0.0), 0.0);
}

TEST(SafeSpeed, is_zero_for_a_reaction_that_is_no_time) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double delta_s : {-1e-9, -7.9e9, infinity, -infinity, std::nan("")}) {
    EXPECT_EQ(safe_speed(6.0, delta_s, 10.0), 0.0) << delta_s;
  }
  EXPECT_EQ(safe_speed(6.0, 1.0, std::nan("")), 0.0);
}

TEST_F(KnownFreeDistance, ends_before_the_first_cell_that_is_not_free) {
  for (const CellState beyond : {CellState::unknown, CellState::occupied}) {
    const HalfSpace map{5.0, beyond};
    const double free_m = known_free_distance(map, {&path, 1.0, 15.0}, body);
    EXPECT_LE(free_m, 3.5);         // 5 m less the body's radius, from 1 m on
    EXPECT_GE(free_m, 3.5 - 0.05);  // and less than one step too short
  }
}

TEST_F(KnownFreeDistance, reaches_no_further_than_the_horizon_or_the_path) {
  const HalfSpace map{100.0, CellState::unknown};
  EXPECT_EQ(known_free_distance(map, {&path, 1.0, 7.01}, body), 7.01);
  EXPECT_EQ(known_free_distance(map, {&path, 1.0, 70.0}, body), 19.0);
  EXPECT_EQ(known_free_distance(map, {&path, 25.0, 70.0}, body), 0.0);
}

TEST_F(KnownFreeDistance, is_zero_where_the_body_stands_in_unknown_space) {
  const HalfSpace map{0.4, CellState::unknown};
  EXPECT_EQ(known_free_distance(map, {&path, 0.0, 7.0}, body), 0.0);
  EXPECT_EQ(known_free_distance(map, {&nowhere, 0.0, 7.0}, body), 0.0);
}

TEST(Guard, reacts_after_tick_command_age_and_brake_lag) {
  GuardSettings settings;
  settings.tick = std::chrono::milliseconds{10};
  settings.command_age = std::chrono::milliseconds{30};
  settings.brake_lag = std::chrono::milliseconds{200};
  EXPECT_EQ(Guard{settings}.reaction_time(), std::chrono::milliseconds{240});
}

TEST(Guard, brakes_exactly_above_the_safe_speed_of_its_reaction_time) {
  const Guard guard{GuardSettings{}};
  const double t_b = to_seconds(guard.reaction_time());
  for (const double d : {0.05, 0.5, 3.0, 12.0}) {
    const double v = safe_speed(guard.settings().max_deceleration_m_s2, t_b, d);
    EXPECT_FALSE(guard.must_brake(v * (1.0 - 1e-9), d));
    EXPECT_TRUE(guard.must_brake(v * (1.0 + 1e-9), d));
  }
}

TEST(Guard, stops_for_a_bound_that_is_zero_negative_or_not_finite) {
  const Guard guard{GuardSettings{}};
  for (const double bound_s : {0.0, -1e-9, -0.1, -7.9e9, -1e300, 5.6e9, 1e300,
                               std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_EQ(guard.cruise_speed(from_seconds(bound_s), 10.0), 0.0) << bound_s;
  }
}

TEST(Guard, cruises_at_the_safe_speed_of_bound_and_reaction_time) {
  const Guard guard{GuardSettings{}};
  const double delta_s = 0.63 + to_seconds(guard.reaction_time());
  EXPECT_EQ(guard.cruise_speed(std::chrono::milliseconds{630}, 6.5), safe_speed(6.0, delta_s, 6.5));
}

TEST(Guard, brakes_where_a_speed_or_a_distance_is_not_a_number) {
  const Guard guard{GuardSettings{}};
  EXPECT_TRUE(guard.must_brake(1.0, std::nan("")));
  EXPECT_TRUE(guard.must_brake(std::nan(""), 10.0));
}

TEST(Guard, does_not_brake_a_vehicle_that_stands) {
  const Guard guard{GuardSettings{}};
  EXPECT_FALSE(guard.must_brake(0.0, 0.0));
  EXPECT_TRUE(guard.must_brake(0.01, 0.0));
}

TEST(LatencyWindow, starts_with_its_seed) {
  LatencyWindow window{std::chrono::milliseconds{700}};
  EXPECT_EQ(window.bound(), std::chrono::milliseconds{700});
  window.add(std::chrono::milliseconds{100});
  EXPECT_EQ(window.bound(), std::chrono::milliseconds{110});
}

TEST(LatencyWindow, forgets_the_worst_after_twenty_samples) {
  LatencyWindow window{std::chrono::milliseconds{0}};
  window.add(std::chrono::milliseconds{500});
  for (int i = 0; i < 19; ++i) {
    window.add(std::chrono::milliseconds{100 + i});
    EXPECT_EQ(window.bound(), std::chrono::milliseconds{550});
  }
  window.add(std::chrono::milliseconds{50});
  EXPECT_EQ(window.bound(), std::chrono::microseconds{129800});
}

TEST(TrackingTube, grows_with_speed) {
  const TrackingTube tube{0.1, 0.02};
  EXPECT_DOUBLE_EQ(tube.radius_m(0.0), 0.1);
  EXPECT_DOUBLE_EQ(tube.radius_m(5.0), 0.2);
}

}  // namespace
}  // namespace flyball
