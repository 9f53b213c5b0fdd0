// SPDX-License-Identifier: BSD-3-Clause
#include "reference/horizon_search.h"

#include "flyball/governors/policy_conformance.h"
#include "flyball/governors/speed_limit.h"

#include "search_knobs.h"
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double search_top_hz = 2e9;
constexpr double slow_hz = 0.5e9;
constexpr double step_m = 4.0;
constexpr std::size_t places = 16;
constexpr double deceleration_m_s2 = 3.0;

std::vector<MapSetting> points() {
  std::vector<MapSetting> all;
  for (const double cells_m : {0.15, 0.80}) {
    for (const double clock_hz : {slow_hz, 1e9, search_top_hz}) {
      all.push_back({cells_m, 12.0, clock_hz});
    }
  }
  return all;
}

HorizonSettings without_obstacles() {
  HorizonSettings settings;
  settings.spacing_m = std::numeric_limits<double>::infinity();
  return settings;
}

/// Fine and coarse cells, one range, three clocks.
struct Made {
  explicit Made(const HorizonSettings& settings = without_obstacles())
      : search{*ClockSearch::make({},
                                  {{0.15, 0.5, 2.2}, {0.80, 0.1, 1.0}},
                                  kit::search_knobs({slow_hz, 1e9, search_top_hz}),
                                  *conformance_board().power)},
        horizon{settings, search, points()} {
    PlaceLimits open;
    open.around = {6.0, deceleration_m_s2, 1e9};
    open.coarsest_m = 0.80;
    limits.assign(places, open);
    for (std::size_t i = 0; i < places; ++i) {
      truth.places.push_back({step_m * static_cast<double>(i), 6.0, 24.0, 20.0});
    }
    set_frames(0.5, 0.1);
  }

  /// At the top clock; in proportion to 1 / f at others.
  void set_frames(double fine_s, double coarse_s) {
    truth.frame_s.clear();
    for (std::size_t i = 0; i < places; ++i) {
      for (const MapSetting& one : horizon.points()) {
        truth.frame_s.push_back((one.resolution_m < 0.5 ? fine_s : coarse_s) * search_top_hz /
                                one.clock_hz);
      }
    }
  }

  EnergyEstimate choose(double speed_m_s) {
    const auto best = horizon.choose(search, truth, limits, speed_m_s);
    EXPECT_TRUE(best.has_value());
    return best.value_or(EnergyEstimate{});
  }

  ClockSearch search;
  HorizonSearch horizon;
  Foresight truth;
  std::vector<PlaceLimits> limits;
};

/// Eq. 2 with the bound that the vehicle's own speed limit has.
double fastest_m_s(double frame_s) {
  return SpeedLimit{deceleration_m_s2}.speed_m_s(response_s({}, 1.1 * frame_s),
                                                 free_ahead_m({0.0, 12.0, 0.0}, 1e9));
}

TEST(HorizonSearch, in_the_open_holds_the_limit_of_speed_at_the_cheapest_clock_that_does) {
  Made one;
  one.set_frames(0.5, 0.05);
  // Of 12 m ahead: at .5 GHz a frame takes .2 s, and is soon enough for 6 m/s.
  ASSERT_GE(fastest_m_s(0.05 * search_top_hz / slow_hz), 6.0);
  const EnergyEstimate quick = one.choose(6.0);
  EXPECT_EQ(quick.setting, (MapSetting{0.80, 12.0, slow_hz}));
  EXPECT_EQ(quick.speed_m_s, 6.0);
  one.set_frames(0.5, 0.10);
  ASSERT_LT(fastest_m_s(0.10 * search_top_hz / slow_hz), 6.0);
  ASSERT_GE(fastest_m_s(0.10 * search_top_hz / 1e9), 6.0);
  EXPECT_EQ(one.choose(6.0).setting, (MapSetting{0.80, 12.0, 1e9}));
}

// At a speed that does not change, the sum over the path is that of one metre times its length.
TEST(HorizonSearch, of_a_straight_at_the_limit_takes_the_joules_of_its_metres) {
  Made one;
  one.limits.assign(places, [&] {
    PlaceLimits only_top = one.limits.front();
    only_top.needs_top_clock = true;
    return only_top;
  }());
  one.search.put_in_force({0.80, 12.0, search_top_hz}, {});
  const EnergyEstimate best = one.choose(6.0);
  ASSERT_EQ(best.setting, (MapSetting{0.80, 12.0, search_top_hz}));
  const double watts =
      (one.search.rotor_power(6.0) + one.search.computer_power(best.setting, 0.1)).value();
  EXPECT_NEAR(best.joules_per_m, watts / 6.0, 1e-9 * watts);
}

// An obstacle of half width 5 m every 10 m comes into view 12 - .8 - .5 m ahead, less 6 m/s times
// the response.
TEST(HorizonSearch, a_path_around_obstacles_is_longer_by_cells_and_by_a_late_view) {
  Made plain;
  Made among{HorizonSettings{}};
  for (Made* one : {&plain, &among}) {
    one->search.put_in_force({0.80, 12.0, search_top_hz}, {});
    for (PlaceLimits& there : one->limits) {
      there.needs_top_clock = true;
      there.coarsest_m = 0.80;
    }
    one->set_frames(5.0, 0.1);  // So that fine cells are not worth their time.
  }
  const EnergyEstimate straight = plain.choose(6.0);
  const EnergyEstimate around = among.choose(6.0);
  ASSERT_EQ(around.setting, straight.setting);
  const double shows_m = free_ahead_m(around.setting, 1e9) - 6.0 * response_s({}, 1.1 * 0.1);
  const double longer = 1.0 + (0.80 + std::hypot(shows_m, 5.0) - shows_m) / 10.0;
  EXPECT_NEAR(around.joules_per_m, longer * straight.joules_per_m, 1e-6 * straight.joules_per_m);
}

// From rest at 3 m/s^2 the limit of 6 m/s is reached within 6 m: two steps.
TEST(HorizonSearch, from_rest_takes_what_the_slower_beginning_costs_more) {
  Made one;
  one.search.put_in_force({0.80, 12.0, search_top_hz}, {});
  const double moving = one.choose(6.0).joules_per_m;
  const double standing = one.choose(0.0).joules_per_m;
  const auto j_m = [&](double v_m_s) { return one.search.rotor_power(v_m_s).value() / v_m_s; };
  // Mean speeds of the first two steps at most (0 + 4.5) / 2 and (4.5 + 6) / 2; computer beside.
  const double least = step_m * (j_m(2.25) + j_m(5.25) - 2.0 * j_m(6.0)) / (step_m * 15.0);
  EXPECT_GE(standing - moving, least);
  EXPECT_LE(standing - moving, 1.1 * least);
}

/// Where the vehicle has come to when finer cells are first chosen before a gap at 48 m.
double refines_at_m(double fine_s) {
  Made one;
  one.set_frames(fine_s, 0.1);
  one.search.put_in_force({0.80, 12.0, search_top_hz}, {});
  constexpr double gap_m = 48.0;
  constexpr double look_m = 8.0;
  for (double at_m = 0.0; at_m < gap_m; at_m += 1.0) {
    for (std::size_t i = 0; i < places; ++i) {
      const double on_m = gap_m - at_m - one.truth.places[i].ahead_m;
      one.limits[i].coarsest_m = on_m >= -3.0 && on_m <= look_m ? 0.15 : 0.80;
    }
    const EnergyEstimate best = one.choose(6.0);
    if (best.setting.resolution_m < 0.5) {
      return gap_m - at_m;
    }
  }
  return 0.0;
}

TEST(HorizonSearch, refines_before_a_known_gap_and_no_sooner_than_it_must) {
  const double before_m = refines_at_m(0.5);
  EXPECT_GE(before_m, 8.0);
  EXPECT_LE(before_m, 8.0 + step_m);
}

// Fine cells end at 4.4 m/s here. For one step a switch to coarse ones and back does not pay.
TEST(HorizonSearch, weighs_what_lies_farther_on) {
  Made one;
  one.set_frames(0.8, 0.1);
  one.search.put_in_force({0.15, 12.0, search_top_hz}, {});
  EXPECT_EQ(one.choose(4.0).setting.resolution_m, 0.80);
  for (std::size_t i = 1; i < places; ++i) {
    one.limits[i].coarsest_m = 0.15;
  }
  EXPECT_EQ(one.choose(4.0).setting.resolution_m, 0.15);
}

TEST(HorizonSearch, never_takes_cells_that_are_too_coarse_or_maps_that_come_too_late) {
  Made one;
  one.limits.front().coarsest_m = 0.15;
  EXPECT_EQ(one.choose(6.0).setting.resolution_m, 0.15);
  one.limits.front().most_response_s = 3.0;  // At .5 GHz a fine map takes 2 s, the next 2 more.
  EXPECT_GT(one.choose(0.0).setting.clock_hz, slow_hz);
  const auto& all = one.horizon.weighed();
  for (const EnergyEstimate& other : all) {
    const bool is_out = other.setting.resolution_m > 0.5 || other.setting.clock_hz == slow_hz;
    EXPECT_EQ(is_out, std::isinf(other.joules_per_m)) << other.setting.clock_hz;
  }
}

TEST(HorizonSearch, says_so_where_no_setting_leads_on) {
  Made one;
  for (PlaceLimits& there : one.limits) {
    there.most_response_s = 0.0;
  }
  EXPECT_FALSE(one.horizon.choose(one.search, one.truth, one.limits, 1.0).has_value());
}

}  // namespace
}  // namespace flyball
