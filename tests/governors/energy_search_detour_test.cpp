// SPDX-License-Identifier: BSD-3-Clause
// How the search prices paths around obstacles.
#include "flyball/governors/energy_search.h"
#include "flyball/governors/policy_conformance.h"

#include "search_knobs.h"
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double top_hz = 2e9;

EnergySearch search_with(const EnergySearchSettings& settings) {
  const std::vector<SearchLevel> levels{{0.15, 0.5, 2.2, 25.0, 7.0, top_hz},
                                        {0.80, 0.1, 1.0, 25.0, 7.0, top_hz}};
  return *EnergySearch::make(settings, levels, {7.0, 12.0}, kit::search_knobs({top_hz}),
                             *conformance_board().power);
}

/// A place where the mission allows 1 m/s.
Surroundings slow_place() {
  Surroundings around;
  around.speed_limit_m_s = 1.0;
  around.visibility_m = 1e9;
  around.coarsest_m = 0.80;
  return around;
}

MissionTime at(double t_s) {
  return MissionTime{from_seconds(t_s)};
}

EnergySearchSettings among_obstacles() {
  EnergySearchSettings settings;
  settings.spacing_m = 20.0;
  return settings;
}

TEST(EnergySearchDetour, a_path_around_obstacles_is_longer_by_cells_and_by_a_late_view) {
  const EnergySearch one = search_with(among_obstacles());
  const EnergySearch plain = search_with({});
  const Surroundings slow = slow_place();
  const MapSetting setting{0.80, 12.0, top_hz};
  const EnergyEstimate dear = one.estimate(setting, slow);
  const double shows_m =
      12.0 - 0.80 - EnergySearchSettings{}.margin_m - dear.speed_m_s * dear.response_s;
  const double longer_m = 0.80 + std::hypot(shows_m, 5.0) - shows_m;
  EXPECT_NEAR(dear.joules_per_m,
              (1.0 + longer_m / 20.0) * plain.estimate(setting, slow).joules_per_m, 1e-9);
}

TEST(EnergySearchDetour, where_the_mission_is_slow_sees_far_in_the_finest_cells) {
  EnergySearch one = search_with(among_obstacles());
  Surroundings room = slow_place();
  EXPECT_EQ(one.choose(room, {}).setting.range_m, 12.0);
  room.visibility_m = 7.0;
  const MapSetting setting = one.choose(room, at(1.0)).setting;
  EXPECT_EQ(setting.range_m, 7.0);
  EXPECT_EQ(setting.resolution_m, 0.15);
}

TEST(EnergySearchDetour, takes_nothing_that_responds_too_late_if_anything_is_sooner) {
  EnergySearch one = search_with(among_obstacles());
  Surroundings room = slow_place();
  room.is_enclosed = true;
  room.coarsest_m = 0.15;
  EXPECT_EQ(one.choose(room, {}).setting.range_m, 12.0);
  room.most_response_s = 2.0;  // .5 s at 7 m, 1.6 at 12.
  EXPECT_EQ(one.choose(room, at(1.0)).setting.range_m, 7.0);
  room.most_response_s = 0.1;
  EXPECT_EQ(one.choose(room, at(2.0)).setting.resolution_m, 0.15);
  room.most_response_s = 2.0;
  Observation quick;  // The room ends most rays; the open behind its door does not.
  quick.map_resolution_m = 0.15;
  quick.latency = from_seconds(0.05);
  quick.frequency = Hertz{top_hz};
  for (quick.map_revision = 1; quick.map_revision <= 60; ++quick.map_revision) {
    quick.now = at(3.0 + static_cast<double>(quick.map_revision));
    one.learn(quick);
    EXPECT_EQ(one.choose(room, quick.now).setting.range_m, 7.0);
  }
  quick.latency = from_seconds(0.01);
  for (; quick.map_revision <= 120; ++quick.map_revision) {
    quick.now = at(3.0 + static_cast<double>(quick.map_revision));
    one.learn(quick);
    EXPECT_EQ(one.choose(room, quick.now).setting.range_m, 7.0);
  }
  room.is_enclosed = false;  // Here ten times as long is expected, .33 s.
  EXPECT_EQ(one.choose(room, quick.now).setting.range_m, 12.0);
  room.most_response_s = 0.4;
  EXPECT_EQ(one.choose(room, quick.now).setting.range_m, 7.0);
}

}  // namespace
}  // namespace flyball
