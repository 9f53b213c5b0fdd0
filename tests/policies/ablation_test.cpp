// SPDX-License-Identifier: BSD-3-Clause
// Each part, left out, is missed where it matters and nowhere else.
#include "mission_energy/ablation.h"

#include "cruising.h"
#include "started_policy.h"

#include <gtest/gtest.h>

namespace {

using namespace std::chrono_literals;

using flyball::kit::cruising;
using flyball::kit::top_hz;

struct Rule {
  explicit Rule(const std::string& without)
      : started{flyball::start_policy("mission_energy", {{"without", without}})} {}
  double wish(const flyball::Observation& seen, const std::string& knob) {
    for (const auto& wish : started.policy->decide(seen)) {
      if (knob == wish.knob) {
        return wish.value;
      }
    }
    ADD_FAILURE() << "no wish for " << knob;
    return 0.0;
  }
  flyball::StartedPolicy started;
};

flyball::Observation before_a_door() {
  flyball::Observation seen = cruising();
  seen.narrowest_gap_m = 0.8;
  seen.gap_distance_m = seen.nearest_obstacle_m = 4.0;
  return seen;
}

/// What the rule wishes after it has flown on like this for half a minute.
double later(const std::string& without, flyball::Observation seen, const std::string& knob) {
  Rule rule{without};
  for (int i = 0; i < 120; ++i) {
    seen.now += 250ms;
    ++seen.map_revision;
    seen.map_resolution_m = rule.wish(seen, "map.resolution_m");
  }
  return rule.wish(seen, knob);
}

TEST(Ablation, leaves_out_nothing_unless_asked) {
  const flyball::ParameterSpec spec = flyball::Ablation::parameter();
  EXPECT_EQ(std::get<std::string>(spec.fallback), spec.choices.front());
  EXPECT_EQ(spec.choices.front(), "nothing");
}

TEST(Ablation, starts_without_each_of_the_parts) {
  for (const std::string& part : flyball::Ablation::parameter().choices) {
    Rule rule{part};
    ASSERT_TRUE(rule.started.status.ok()) << part;
    EXPECT_GT(rule.wish(cruising(), "map.resolution_m"), 0.0) << part;
  }
}

TEST(Ablation, without_resolution_has_the_finest_cells_everywhere) {
  EXPECT_GT(later("nothing", cruising(), "map.resolution_m"), 0.15);
  EXPECT_EQ(later("resolution", cruising(), "map.resolution_m"), 0.15);
}

TEST(Ablation, without_range_keeps_one_range) {
  EXPECT_EQ(later("range", cruising(), "map.range_m"),
            later("range", before_a_door(), "map.range_m"));
}

TEST(Ablation, without_clock_keeps_the_highest_one) {
  flyball::Observation slow = cruising();
  slow.speed_m_s = slow.speed_limit_m_s = 3.0;
  slow.rotor_power = flyball::Watts{20.0};
  EXPECT_LT(later("nothing", slow, "cpu.frequency_hz"), top_hz);
  EXPECT_EQ(later("clock", slow, "cpu.frequency_hz"), top_hz);
  slow.phase = flyball::MissionPhase::wait;
  EXPECT_LT(later("nothing", slow, "cpu.frequency_hz"), top_hz);
  EXPECT_EQ(later("clock", slow, "cpu.frequency_hz"), top_hz);
}

TEST(Ablation, without_gaps_has_large_cells_before_a_door) {
  EXPECT_EQ(later("nothing", before_a_door(), "map.resolution_m"), 0.15);
  EXPECT_GT(later("gaps", before_a_door(), "map.resolution_m"), 0.15);
}

/// Cells in a wide place behind a door, where the mission is slow.
double behind_the_door_m(const std::string& without) {
  Rule rule{without};
  flyball::Observation seen = before_a_door();
  for (int i = 0; i < 160; ++i) {
    if (i == 40) {
      const flyball::MissionTime now = seen.now;
      seen = cruising();
      seen.now = now;
      seen.map_resolution_m = 0.15;
    }
    seen.speed_m_s = seen.speed_limit_m_s = 2.0;
    seen.latency = seen.map_resolution_m > 0.15 ? 100ms : 1500ms;  // So small cells are too slow.
    seen.now += 250ms;
    seen.map_revision = static_cast<std::uint64_t>(i) + 2;
    seen.map_resolution_m = rule.wish(seen, "map.resolution_m");
  }
  return seen.map_resolution_m;
}

TEST(Ablation, without_declared_zones_does_not_keep_the_finest_cells_behind_a_door) {
  EXPECT_EQ(behind_the_door_m("nothing"), 0.15);
  EXPECT_GT(behind_the_door_m("declared_zones"), 0.15);
}

TEST(Ablation, without_a_noise_limit_looks_farther_with_a_noisy_camera) {
  flyball::BoardModel board;
  board.vehicle.depth_camera = flyball::DepthCameraSpec{};
  ASSERT_TRUE(board.vehicle.depth_camera->rgbd_noise);
  const auto resolved = flyball::Parameters::resolve("ablation", {flyball::Ablation::parameter()},
                                                     {{"without", std::string{"noise_limit"}}});
  const flyball::Ablation without{std::get<flyball::Parameters>(resolved)};
  EXPECT_LT(without.begins_with(board).vehicle.depth_camera->noise_m(10.0), 1e-9);
  EXPECT_GT(board.vehicle.depth_camera->noise_m(10.0), 0.1);
}

}  // namespace
