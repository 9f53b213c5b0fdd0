// SPDX-License-Identifier: BSD-3-Clause
#include "started_policy.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double lowest_hz = 806.4e6;  // Of `conformance_knobs`.
constexpr double top_hz = 2035.2e6;

std::unique_ptr<Policy> energy_clock(Duration reaction = GuardSettings{}.reaction_time()) {
  BoardModel board = conformance_board();
  board.vehicle.reaction_time = reaction;
  StartedPolicy started = start_policy("energy_clock", {}, conformance_knobs(), board);
  EXPECT_TRUE(started.status);
  return std::move(started.policy);
}

double clock_hz(const Decision& wish) {
  EXPECT_EQ(wish.size(), 1U) << "the map is the application's";
  return wish.size() == 1 ? wish.begin()->value : 0.0;
}

Observation cruising(double t_s, double resolution_m, double rotor_w) {
  Observation seen;
  seen.now = MissionTime{from_seconds(t_s)};
  seen.phase = MissionPhase::cruise;
  seen.speed_m_s = 3.0;
  seen.speed_limit_m_s = 10.0;
  seen.known_free_m = 7.0;
  seen.map_revision = 1;
  seen.max_deceleration_m_s2 = 6.0;
  seen.map_resolution_m = resolution_m;
  seen.frequency = Hertz{top_hz};
  seen.busy_cores = 2.0;
  seen.rotor_power = Watts{rotor_w};
  return seen;
}

TEST(EnergyClock, where_latency_limits_the_speed_of_a_heavy_vehicle_it_is_the_highest) {
  EXPECT_EQ(clock_hz(energy_clock()->decide(cruising(1.0, 0.15, 350.0))), top_hz);
}

TEST(EnergyClock, at_the_missions_own_limit_of_speed_it_drops) {
  Observation seen = cruising(1.0, 0.80, 20.0);
  seen.speed_limit_m_s = 1.0;
  EXPECT_LT(clock_hz(energy_clock()->decide(seen)), top_hz);
}

TEST(EnergyClock, not_where_the_application_looks_so_far_that_maps_take_long) {
  Observation seen = cruising(1.0, 0.80, 350.0);
  seen.speed_limit_m_s = 3.0;
  seen.map_range_m = 25.0;
  EXPECT_EQ(clock_hz(energy_clock()->decide(seen)), top_hz);
}

TEST(EnergyClock, not_where_the_next_path_is_so_short_that_latency_limits_the_speed_after_all) {
  Observation seen = cruising(1.0, 0.15, 300.0);
  seen.speed_limit_m_s = seen.speed_m_s = 1.0;
  EXPECT_LT(clock_hz(energy_clock()->decide(seen)), top_hz);
  seen.known_free_m = 1.0;  // A view in the next room, or a wall.
  EXPECT_EQ(clock_hz(energy_clock()->decide(seen)), top_hz);
}

TEST(EnergyClock, nor_where_the_vehicle_brakes_so_late_that_latency_limits_the_speed) {
  Observation seen = cruising(1.0, 0.15, 300.0);
  seen.speed_limit_m_s = seen.speed_m_s = 2.0;
  EXPECT_LT(clock_hz(energy_clock()->decide(seen)), top_hz);
  EXPECT_EQ(clock_hz(energy_clock(std::chrono::seconds{2})->decide(seen)), top_hz);
}

TEST(EnergyClock, nor_where_the_mission_mostly_waits_for_the_computer) {
  const auto policy = energy_clock();
  Observation seen = cruising(0.0, 0.15, 300.0);
  seen.speed_limit_m_s = seen.speed_m_s = 1.0;
  const auto clock_at = [&](double t_s, double speed_m_s) {
    seen.now = MissionTime{from_seconds(t_s)};
    seen.speed_m_s = speed_m_s;
    return clock_hz(policy->decide(seen));
  };
  EXPECT_LT(clock_at(0.0, 1.0), top_hz);
  double t_s = 0.0;
  for (; t_s < 10.0; t_s += 0.25) {
    EXPECT_EQ(clock_at(t_s + 0.25, 0.0), top_hz);
  }
  EXPECT_EQ(clock_at(t_s + 0.25, 1.0), top_hz) << "it has stood for 10 s of the last minute";
  for (; t_s < 400.0; t_s += 0.25) {
    (void)clock_at(t_s + 0.5, 1.0);
  }
  EXPECT_LT(clock_at(t_s + 0.5, 1.0), top_hz) << "that was long ago";
}

TEST(EnergyClock, who_stands_and_waits_for_a_plan_has_the_highest) {
  const auto policy = energy_clock();
  Observation seen = cruising(1.0, 0.80, 20.0);
  seen.speed_limit_m_s = 1.0;
  seen.speed_m_s = 0.0;
  EXPECT_EQ(clock_hz(policy->decide(seen)), top_hz);
}

TEST(EnergyClock, while_the_vehicle_waits_it_is_as_low_as_the_news_allows) {
  const auto policy = energy_clock();
  Observation seen = cruising(0.0, 0.15, 0.0);
  seen.phase = MissionPhase::wait;
  (void)policy->decide(seen);
  seen.now = MissionTime{from_seconds(2.0)};
  const double fine_hz = clock_hz(policy->decide(seen));
  EXPECT_LT(fine_hz, top_hz);
  EXPECT_GT(fine_hz, lowest_hz);  // .5 s at the top clock; a second is allowed.
  seen.map_resolution_m = 0.80;
  EXPECT_EQ(clock_hz(policy->decide(seen)), lowest_hz);
}

TEST(EnergyClock, without_a_map_it_is_the_lowest) {
  const auto policy = energy_clock();
  Observation seen = cruising(0.0, 0.15, 250.0);
  seen.map_revision = 0;
  seen.known_free_m = 100.0;
  (void)policy->decide(seen);
  seen.now = MissionTime{from_seconds(2.0)};
  EXPECT_EQ(clock_hz(policy->decide(seen)), lowest_hz);
}

/// Knobs of a mapper that takes any cells, as stock OctoMap does.
KnobSettings knobs_with_any_cells() {
  std::vector<KnobSpec> specs = conformance_knobs().specs();
  specs.front().legal.clear();
  return KnobSettings{specs};
}

TEST(EnergyClock, learns_from_maps_of_cells_that_are_none_of_its_levels) {
  for (const double cells_m : {0.25, 0.30, 0.40}) {
    const StartedPolicy started = start_policy("energy_clock", {}, knobs_with_any_cells());
    ASSERT_TRUE(started.status);
    for (int map = 1; map <= 100; ++map) {
      Observation seen = cruising(0.25 * map, cells_m, 350.0);
      seen.map_revision = static_cast<std::uint64_t>(map);
      seen.map_range_m = 7.0;
      seen.latency = from_seconds(0.2);
      static_cast<void>(started.policy->decide(seen));
    }
    const auto* bounds = dynamic_cast<const BoundsLatency*>(started.policy.get());
    ASSERT_NE(bounds, nullptr);
    EXPECT_GT(bounds->bounds().issued, 90U) << cells_m << " m";
  }
}

TEST(EnergyClock, takes_the_wait_for_a_rare_frame_for_no_latency) {
  BoardModel board = conformance_board();
  board.vehicle.depth_camera.emplace().rate_hz = 0.5;
  const StartedPolicy started = start_policy("energy_clock", {}, conformance_knobs(), board);
  ASSERT_TRUE(started.status);
  for (int look = 1; look <= 1200; ++look) {
    Observation seen = cruising(0.25 * look, 0.80, 350.0);
    seen.map_revision = static_cast<std::uint64_t>((look + 7) / 8);  // One in two seconds.
    seen.map_range_m = 7.0;
    seen.latency = from_seconds(0.1);
    static_cast<void>(started.policy->decide(seen));
  }
  EXPECT_LT(dynamic_cast<const BoundsLatency&>(*started.policy).bounds().factor, 1.5);
}

TEST(EnergyClock, is_refused_without_a_map_to_reckon_with) {
  const StartedPolicy started = start_policy("energy_clock", {}, KnobSettings{});
  ASSERT_FALSE(started.status);
  EXPECT_NE(started.status.error().message.find("no knob map.resolution_m"), std::string::npos);
}

}  // namespace
}  // namespace flyball
