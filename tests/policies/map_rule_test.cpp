// SPDX-License-Identifier: BSD-3-Clause
#include "mission_energy/map_rule.h"

#include "flyball/governors/policy_conformance.h"

#include "cruising.h"
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

using Given = std::map<std::string, ParameterValue>;

Result<MapRule> made(const Given& given = {},
                     const KnobSettings& knobs = conformance_knobs(),
                     const VehicleModel& vehicle = {}) {
  const auto resolved = Parameters::resolve("policy", MapRule::parameters(), given);
  return MapRule::make("policy \"mine\"", std::get<Parameters>(resolved), knobs, vehicle);
}

std::string refusal(const Given& given, const KnobSettings& knobs = conformance_knobs()) {
  auto rule = made(given, knobs);
  return rule ? "" : rule.error().message;
}

/// Of a mapper that takes any cells from these on.
KnobSettings any_resolution(double least_m = 0.15) {
  std::vector<KnobSpec> specs = conformance_knobs().specs();
  specs.front().legal.clear();
  specs.front().min = least_m;
  return KnobSettings{specs};
}

std::vector<double> cells_of(const MapRule& rule) {
  std::vector<double> all_m;
  for (const LatencyLevel& level : rule.levels(0.5, 0.1)) {
    all_m.push_back(level.resolution_m);
  }
  return all_m;
}

TEST(MapRule, has_all_cells_of_a_lattice_between_its_ends) {
  auto rule = made({{"fine_m", 0.30}, {"coarse_m", 0.80}});
  ASSERT_TRUE(rule.ok());
  EXPECT_EQ(cells_of(*rule), (std::vector<double>{0.30, 0.60, 0.80}));
}

// By hand: sqrt(.15 * .8) = .3464.
TEST(MapRule, has_cells_with_equal_ratios_near_two_where_the_mapper_takes_any) {
  const auto cells = cells_of(*made({{"coarse_m", 0.8}}, any_resolution()));
  ASSERT_EQ(cells.size(), 3U);
  EXPECT_EQ(cells.front(), 0.15);
  EXPECT_NEAR(cells[1], 0.3464, 1e-4);
  EXPECT_EQ(cells.back(), 0.80);
  EXPECT_EQ(cells_of(*made({{"coarse_m", 0.2}}, any_resolution())),
            (std::vector<double>{0.15, 0.20}));
}

TEST(MapRule, begins_with_the_finest_cells_that_the_mapper_has) {
  EXPECT_EQ(made({})->levels(0.5, 0.1).front().resolution_m, 0.15);
  std::vector<KnobSpec> specs = conformance_knobs().specs();
  ASSERT_EQ(specs.front().name, "map.resolution_m");
  specs.front().legal.insert(specs.front().legal.begin(), 0.075);
  EXPECT_EQ(made({}, KnobSettings{specs})->levels(0.5, 0.1).front().resolution_m, 0.075);
  EXPECT_EQ(made({}, any_resolution())->levels(0.5, 0.1).front().resolution_m, 0.15);
}

TEST(MapRule, has_smaller_cells_for_doors_where_the_mapper_takes_any) {
  EXPECT_EQ(cells_of(*made({}, any_resolution(0.02))),
            (std::vector<double>{0.05, 0.15, 0.30, 0.60}));
  EXPECT_EQ(cells_of(*made({{"door_m", 0.0}}, any_resolution(0.02))).front(), 0.15);
  EXPECT_EQ(cells_of(*made({{"fine_m", 0.04}}, any_resolution(0.02))).front(), 0.04);
  EXPECT_EQ(cells_of(*made({}, any_resolution(0.10))).front(), 0.10) << "as near as it has them";
  // By hand: four times the cells take a fifth, so a third takes 5 ^ (ln 3 / ln 4) = 3.58 times.
  EXPECT_NEAR(made({}, any_resolution(0.02))->levels(0.5, 0.1).front().latency_s, 1.79, 0.005);
}

Observation in_a_room(std::uint32_t planner_failures) {
  Observation seen;
  seen.phase = MissionPhase::cruise;
  seen.speed_limit_m_s = 1.0;
  seen.speed_m_s = 0.5;
  seen.planner_failures = planner_failures;
  return seen;
}

TEST(MapRule, takes_cells_for_doors_after_two_plans_have_failed_in_a_room) {
  auto rule = made({}, any_resolution(0.02));
  const auto cells_m = [&](const Observation& seen) { return rule->look(seen, 0.15).cells_m; };
  EXPECT_EQ(cells_m(in_a_room(1)), 0.15);
  EXPECT_EQ(cells_m(in_a_room(2)), 0.05);
  EXPECT_EQ(cells_m(in_a_room(0)), 0.05) << "larger ones would close the door behind it";
  Observation outside = in_a_room(0);
  outside.speed_limit_m_s = 10.0;
  EXPECT_GE(cells_m(outside), 0.15);
  outside.planner_failures = 5;
  EXPECT_EQ(cells_m(outside), 0.15) << "there they take long";
  EXPECT_EQ(cells_m(in_a_room(1)), 0.15) << "of another room nobody knows yet";
  Observation exploring = in_a_room(5);
  exploring.progress_unit = ProgressUnit::cubic_metre;
  EXPECT_EQ(cells_m(exploring), 0.15) << "all rooms would have to be seen anew";
}

/// What a computer is expected to take before the first map: .5 s with the smallest cells and 7 m.
LearnedLatency expected_of(const MapRule& rule) {
  return {{}, rule.levels(0.5, 0.1), rule.home(), Hertz{2e9}};
}

/// The longest range of each level, of 30 m at most.
std::vector<double> longest_ranges_m(const DepthCameraSpec& camera,
                                     const KnobSettings& knobs = conformance_knobs()) {
  VehicleModel vehicle;
  vehicle.depth_camera = camera;
  auto rule = made({}, knobs, vehicle);
  std::vector<double> ranges_m;
  for (const LatencyLevel& level : rule->levels(0.5, 0.1)) {
    MapNeeds far;
    far.cells_m = level.resolution_m;
    far.least_range_m = 30.0;
    ranges_m.push_back(rule->setting(far, expected_of(*rule)).range_m);
  }
  return ranges_m;
}

// By hand: (r / 2 + .4193) / .0657 is 7.5 and 8.7 m; (.71 / 4 + .4193) / .0657 is 9.1 m.
TEST(MapRule, looks_no_farther_than_noise_leaves_gaps_in_a_lattice) {
  const auto ranges_m = longest_ranges_m(DepthCameraSpec{});
  const std::vector<double> expected_m{7.52, 8.67, 9.08};
  ASSERT_EQ(ranges_m.size(), expected_m.size());
  for (std::size_t i = 0; i < expected_m.size(); ++i) {
    EXPECT_NEAR(ranges_m[i], expected_m[i], 0.051) << "found in steps of .05 m";
  }
}

// By hand: (.6 / 2 + .4193) / .0657 is 10.9 m.
TEST(MapRule, looks_as_far_as_noise_is_half_a_cell_without_a_lattice) {
  const auto ranges_m = longest_ranges_m(DepthCameraSpec{}, any_resolution());
  EXPECT_NEAR(ranges_m.front(), 7.52, 0.051);
  EXPECT_NEAR(ranges_m.back(), 10.95, 0.051);
}

Observation between_trees(double gap_m) {
  Observation seen;
  seen.phase = MissionPhase::cruise;
  seen.speed_limit_m_s = 10.0;
  seen.narrowest_gap_m = gap_m;
  return seen;
}

// By hand: ((3 - .71) / 4 + .4193) / .0657 is 15.1 m, and only whole metres count.
TEST(MapRule, looks_farther_where_the_gaps_that_it_sees_are_wide) {
  VehicleModel vehicle;
  vehicle.depth_camera = DepthCameraSpec{};
  auto rule = made({}, conformance_knobs(), vehicle);
  const auto clear_m = [&](const Observation& seen) {
    return rule->look(seen, 0.60).clear_range_m;
  };
  EXPECT_EQ(clear_m(between_trees(3.0)), 15.0);
  EXPECT_EQ(clear_m(between_trees(6.0)), 15.0) << "nothing is seen; as the last one";
  EXPECT_LT(clear_m(between_trees(0.8)), 7.0) << "a door";
  EXPECT_LT(clear_m(between_trees(6.0)), 7.0) << "the next may be a door, too";
  Observation fast = between_trees(3.0);
  fast.speed_m_s = 12.0;
  EXPECT_EQ(clear_m(fast), 14.0) << "nobody says what lies beyond 20 m";
  fast.slower_zone_m = 40.0;
  EXPECT_EQ(clear_m(fast), 15.0);
  fast.slower_zone_m = 17.0;
  EXPECT_EQ(clear_m(fast), 11.0) << "half a second before the zone's doors";
  Observation slow = between_trees(3.0);
  slow.speed_limit_m_s = 1.0;
  EXPECT_EQ(clear_m(slow), 0.0) << "narrow places are declared";
  EXPECT_EQ(clear_m(between_trees(6.0)), 0.0) << "none was seen since then";
  EXPECT_EQ(made({})->look(between_trees(3.0), 0.60).clear_range_m, 0.0);
}

TEST(MapRule, looks_as_far_as_noise_lets_it_where_wide_gaps_are_seen) {
  VehicleModel vehicle;
  vehicle.depth_camera = DepthCameraSpec{};
  auto rule = made({}, conformance_knobs(), vehicle);
  MapNeeds needs;
  needs.cells_m = 0.60;
  EXPECT_NEAR(rule->setting(needs, expected_of(*rule)).range_m, 9.08, 0.051);
  needs.clear_range_m = 15.1;
  EXPECT_EQ(rule->setting(needs, expected_of(*rule)).range_m, 15.1);
}

double range_m(double cells_m, const Given& given = {}) {
  MapNeeds needs;
  needs.cells_m = cells_m;
  const auto rule = made(given, any_resolution(0.02));
  return rule->setting(needs, expected_of(*rule)).range_m;
}

// Those of gap_switch are 10, 15 and 22 m.
TEST(MapRule, looks_farther_with_larger_cells_whose_maps_take_less_time) {
  EXPECT_NEAR(range_m(0.15), 10.0, 1e-9);
  EXPECT_NEAR(range_m(0.30), 15.0, 0.2);
  EXPECT_NEAR(range_m(0.60), 22.0, 0.1);
  EXPECT_NEAR(range_m(0.60, {{"range_m", 5.0}}), 11.0, 0.1);
  EXPECT_EQ(range_m(0.60, {{"most_range_m", 12.0}}), 12.0);
}

// Time grows with R^2.2, and each step of the range is a fifth.
TEST(MapRule, looks_as_far_with_smaller_cells_as_the_computer_has_time_for) {
  const auto rule = made({}, any_resolution(0.02));
  MapNeeds doors;
  doors.cells_m = 0.05;
  const auto range_where_7_m_take = [&](double seconds) {
    const LearnedLatency latency{
        {}, {{0.05, seconds, 2.2}, {0.15, 0.1, 2.2}}, rule->home(), Hertz{2e9}};
    return rule->setting(doors, latency).range_m;
  };
  EXPECT_EQ(range_where_7_m_take(0.1), 10.0) << "no farther than with larger cells";
  EXPECT_NEAR(range_where_7_m_take(0.2), 8.0 * 0.8, 1e-9) << "8 m take .27 s, 6.4 m .16 s";
  EXPECT_NEAR(range_where_7_m_take(1.0), 10.0 * std::pow(0.8, 5), 1e-9) << "3.7 m take .25 s";
  EXPECT_EQ(range_where_7_m_take(50.0), 2.0) << "the knob's least: the next door is seen";
}

TEST(MapRule, takes_only_what_the_knobs_allow) {
  std::vector<KnobSpec> specs = conformance_knobs().specs();
  specs[1].max = specs[1].fallback = 6.0;
  ASSERT_EQ(specs[1].name, "map.range_m");
  const auto rule = made({}, KnobSettings{specs});
  MapNeeds needs;
  needs.cells_m = 0.355;
  needs.least_range_m = 22.0;
  const MapSetting setting = rule->setting(needs, expected_of(*rule));
  EXPECT_EQ(setting.range_m, 6.0);
  EXPECT_EQ(setting.resolution_m, 0.30) << "of the lattice";
  EXPECT_EQ(rule->range_m(), 6.0);
}

TEST(MapRule, may_look_nearer_where_the_mission_is_slow) {
  auto rule = made();
  Observation seen = between_trees(0.8);
  EXPECT_EQ(rule->look(seen, 0.60).least_range_m, 7.0);
  seen.speed_limit_m_s = 1.0;
  EXPECT_EQ(rule->look(seen, 0.60).least_range_m, 0.0);
  for (const ProgressUnit unit : {ProgressUnit::cubic_metre, ProgressUnit::square_metre}) {
    seen.progress_unit = unit;
    EXPECT_EQ(rule->look(seen, 0.60).least_range_m, 7.0) << "progress is what a view shows";
  }
  seen.progress_unit = ProgressUnit::metre;
  EXPECT_EQ(rule->look(seen, 0.60).least_range_m, 0.0);
}

TEST(MapRule, looks_as_far_as_a_camera_without_noise) {
  DepthCameraSpec camera;
  camera.rgbd_noise = false;
  for (const double range_m : longest_ranges_m(camera)) {
    EXPECT_EQ(range_m, 20.0);
  }
}

TEST(MapRule, keeps_the_shortest_range_with_a_camera_that_cannot_tell_a_cell) {
  DepthCameraSpec noisy;
  noisy.extra_noise_m = 0.5;
  DepthCameraSpec short_sighted;
  short_sighted.max_range_m = 5.0;
  for (const DepthCameraSpec& camera : {noisy, short_sighted}) {
    for (const double range_m : longest_ranges_m(camera)) {
      EXPECT_EQ(range_m, 7.0);
    }
  }
}

TEST(MapRule, has_no_cells_in_which_the_ground_reaches_up_to_the_vehicle) {
  const auto coarsest_m = [](double clearance_m, const KnobSettings& knobs, const Given& given) {
    VehicleModel vehicle;
    vehicle.ground_clearance_m = clearance_m;
    return made(given, knobs, vehicle)->levels(0.5, 0.1).back().resolution_m;
  };
  EXPECT_EQ(coarsest_m(0.5, conformance_knobs(), {}), 0.30);
  EXPECT_EQ(coarsest_m(0.5, any_resolution(), {}), 0.50);
  for (const KnobSettings& knobs : {conformance_knobs(), any_resolution()}) {
    EXPECT_EQ(coarsest_m(0.6, knobs, {}), 0.60);
    EXPECT_EQ(coarsest_m(5.0, knobs, {}), 0.60) << "larger ones gain nothing";
    EXPECT_EQ(coarsest_m(0.5, knobs, {{"coarse_m", 0.8}}), 0.80) << "as given";
  }
}

TEST(MapRule, has_no_cells_which_the_ceiling_fills_down_to_the_vehicle) {
  auto rule = made();
  Observation seen = kit::cruising();
  seen.map_resolution_m = 0.15;
  for (const auto& [headroom_m, coarsest_m] :
       {std::pair{0.0, 0.6}, std::pair{0.5, 0.6}, std::pair{0.4, 0.3}, std::pair{0.1, 0.15}}) {
    seen.now += 10s;
    seen.headroom_m = headroom_m;
    EXPECT_EQ(rule->look(seen, 0.15).cells_m, coarsest_m) << headroom_m;
  }
}

TEST(MapRule, takes_the_body_of_its_vehicle) {
  VehicleModel small;
  small.narrow_width_m = 0.35;
  EXPECT_EQ(made({}, conformance_knobs(), small)->body_m(), 0.35);
  EXPECT_EQ(made({{"body_m", 0.5}}, conformance_knobs(), small)->body_m(), 0.5);
}

TEST(MapRule, says_what_contradicts_what) {
  EXPECT_NE(refusal({{"fine_m", 0.80}, {"coarse_m", 0.15}}).find("below coarse_m"),
            std::string::npos);
  EXPECT_NE(refusal({{"least_range_m", 20.0}, {"most_range_m", 10.0}}).find("below most_range_m"),
            std::string::npos);
  EXPECT_EQ(refusal({}, KnobSettings{}),
            "policy \"mine\": there is no knob map.resolution_m, map.range_m; try: flyball "
            "list knobs");
}

TEST(MapRule, needs_the_top_clock_where_only_the_finest_cells_leave_a_gap_open) {
  auto rule = made();
  Observation seen = kit::cruising();
  EXPECT_FALSE(rule->look(seen, 0.60).needs_top_clock);
  seen.now += 250ms;
  seen.narrowest_gap_m = 0.8;
  seen.gap_distance_m = 4.0;
  EXPECT_TRUE(rule->look(seen, 0.60).needs_top_clock);
}

TEST(MapRule, while_it_waits_for_a_plan_has_no_larger_cells_than_the_map) {
  auto rule = made();
  ASSERT_TRUE(rule.ok());
  Observation seen = kit::cruising();
  EXPECT_EQ(rule->look(seen, 0.30).cells_m, 0.60);
  seen.speed_m_s = 0.0;
  EXPECT_EQ(rule->look(seen, 0.30).cells_m, 0.30);
}

TEST(MapRule, takes_the_finest_cells_where_a_plan_has_failed) {
  auto rule = made();
  ASSERT_TRUE(rule.ok());
  Observation seen = kit::cruising();
  EXPECT_GT(rule->look(seen, 0.60).cells_m, 0.15);
  seen.now += 250ms;
  seen.planner_failures = 2;
  EXPECT_EQ(rule->look(seen, 0.60).cells_m, 0.15);
}

constexpr double finest_m = 0.15;
constexpr double next_finest_m = 0.30;

// Nothing near says so: the mission's limit of speed does, 20 m ahead.
TEST(MapRule, leaves_finest_cells_only_where_the_mission_is_fast_again) {
  auto rule = made();
  ASSERT_TRUE(rule.ok());
  Observation seen = kit::cruising();
  seen.speed_m_s = seen.speed_limit_m_s = 1.0;
  EXPECT_GE(rule->look(seen, next_finest_m).cells_m, 0.30);
  EXPECT_EQ(rule->look(seen, finest_m).cells_m, 0.15);
  seen.speed_limit_m_s = 6.0;
  EXPECT_GE(rule->look(seen, finest_m).cells_m, 0.30);
}

TEST(MapRule, leaves_finest_cells_again_before_it_reaches_a_slow_place) {
  auto rule = made();
  ASSERT_TRUE(rule.ok());
  Observation seen = kit::cruising();
  seen.speed_limit_m_s = 1.0;
  EXPECT_GE(rule->look(seen, finest_m).cells_m, 0.30);
}

TEST(MapRule, has_finest_cells_up_to_a_slow_place_after_a_plan_towards_it_has_failed) {
  auto rule = made();
  ASSERT_TRUE(rule.ok());
  Observation seen = kit::cruising();
  seen.planner_failures = 1;
  EXPECT_GE(rule->look(seen, next_finest_m).cells_m, 0.30) << "it may be far off in the open";
  seen.speed_limit_m_s = 1.0;
  EXPECT_EQ(rule->look(seen, next_finest_m).cells_m, 0.15);
  seen.planner_failures = 0;
  EXPECT_EQ(rule->look(seen, next_finest_m).cells_m, 0.15);
  seen.speed_limit_m_s = 6.0;
  EXPECT_GE(rule->look(seen, next_finest_m).cells_m, 0.30);
}

}  // namespace
}  // namespace flyball
