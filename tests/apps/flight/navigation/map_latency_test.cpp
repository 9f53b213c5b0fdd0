// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/map_latency.h"

#include "flyball/flight/navigation/path_follower.h"
#include "flyball/runtime/random.h"

#include "mission_rig.h"
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

const MapTerms fine{0.15, 7.0, Hertz{2e9}, 4};
const MapTerms coarse{0.60, 13.0, Hertz{2e9}, 4};

MapTerms at_clock(MapTerms terms, double hz) {
  terms.clock = Hertz{hz};
  return terms;
}

MapTerms on_cores(MapTerms terms, int cores) {
  terms.cores = cores;
  return terms;
}

MapTerms within(MapTerms terms, double range_m) {
  terms.range_m = range_m;
  return terms;
}

/// 1 s for `fine`: as the volume in cells, and against the clock.
Duration price_of(const MapTerms& terms) {
  const double edges = terms.range_m / 7.0 * 0.15 / terms.resolution_m;
  return from_seconds(edges * edges * edges * 2e9 / terms.clock.value());
}

double price_s(const MapTerms& terms) {
  return to_seconds(price_of(terms));
}

/// Maps of one length, one after the other, under the terms of whoever asks.
struct Stream {
  void make(const MapTerms& terms, int n, Duration latency) {
    for (int i = 0; i < n; ++i) {
      const MissionTime captured = now;
      maps.note_terms(now, terms);
      now += latency;
      publish(captured, terms.resolution_m);
    }
  }
  void publish(MissionTime captured, double resolution_m, double range_m = 0.0) {
    maps.published({++number, captured, resolution_m, nullptr, range_m}, now);
  }
  /// The other terms come into force at once; the map that is being made belongs to neither.
  void turn_to(const MapTerms& terms) {
    now += 1s;
    maps.note_terms(now, terms);
    publish(now - 10s, terms.resolution_m);
  }
  [[nodiscard]] double latency_bound_s() const { return to_seconds(maps.latency_bound()); }
  [[nodiscard]] double interval_bound_s() const { return to_seconds(maps.interval_bound()); }
  MapLatency maps{{price_of, 1ms}};
  MissionTime now{1s};
  std::uint64_t number{};
};

TEST(MapLatency, has_no_bound_before_the_first_map) {
  Stream stream;
  EXPECT_FALSE(stream.maps.note_terms(MissionTime{1s}, fine));
  EXPECT_FALSE(stream.maps.note_terms(MissionTime{2s}, coarse));
  EXPECT_EQ(stream.maps.latency_bound(), Duration::zero());
  EXPECT_EQ(stream.maps.interval_bound(), Duration::zero());
}

TEST(MapLatency, begins_with_the_platforms_price) {
  Stream stream;
  stream.turn_to(fine);
  stream.turn_to(coarse);
  EXPECT_NEAR(stream.latency_bound_s(), price_s(coarse), 1e-6);
  EXPECT_NEAR(stream.interval_bound_s(), price_s(coarse), 1e-6);
}

TEST(MapLatency, bounds_both_by_the_worst_of_late) {
  Stream stream;
  stream.make(fine, 5, 400ms);
  stream.make(fine, 1, 600ms);
  stream.make(fine, 5, 400ms);
  EXPECT_NEAR(stream.latency_bound_s(), 0.66, 1e-6);
  EXPECT_NEAR(stream.interval_bound_s(), 0.66, 1e-6);
}

TEST(MapLatency, tells_what_share_of_its_bound_a_map_took) {
  Stream stream;
  stream.make(fine, 5, 400ms);
  stream.make(fine, 1, 880ms);
  EXPECT_NEAR(stream.maps.budget_use(), 2.0, 1e-6);
  stream.make(fine, 1, 484ms);
  EXPECT_NEAR(stream.maps.budget_use(), 0.5, 1e-6);
}

TEST(MapLatency, holds_no_map_against_a_setting_under_which_it_was_not_made) {
  Stream stream;
  stream.make(fine, 5, 400ms);
  const Duration before = stream.maps.latency_bound();
  const MissionTime captured = stream.now;
  stream.now += 300ms;
  stream.maps.note_terms(stream.now, at_clock(fine, 0.5e9));  // Slower, half way through.
  stream.now += 3s;
  stream.maps.note_terms(stream.now, fine);
  stream.publish(captured, 0.15);
  EXPECT_EQ(stream.maps.latency_bound(), before);
  EXPECT_NEAR(stream.maps.budget_use(), 3.3 / (4.0 * 0.44), 1e-6) << "it was late all the same";
}

TEST(MapLatency, counts_a_map_of_other_cells_for_none) {
  Stream stream;
  stream.make(coarse, 5, 100ms);
  const Duration before = stream.maps.latency_bound();
  const MissionTime captured = stream.now;
  stream.now += 2s;
  stream.publish(captured, 0.15);
  EXPECT_EQ(stream.maps.latency_bound(), before);
}

TEST(MapLatency, counts_a_frame_of_the_range_before_for_that_range) {
  Stream stream;
  stream.make(within(fine, 14.0), 1, 100ms);
  const MissionTime captured = stream.now;
  stream.now += 100ms;
  stream.maps.note_terms(stream.now, fine);
  stream.now += 1900ms;
  stream.publish(captured, 0.15, 14.0);  // 2 s of 8, so that 7 m take a quarter of 1 s.
  EXPECT_NEAR(stream.latency_bound_s(), 1.1 * 0.25, 1e-6);
  stream.now += 1ms;
  stream.maps.note_terms(stream.now, within(fine, 14.0));
  EXPECT_NEAR(stream.latency_bound_s(), 1.1 * 2.0, 1e-6);
}

TEST(MapLatency, follows_the_clock_that_the_platform_prices) {
  Stream stream;
  stream.make(fine, 5, 400ms);
  EXPECT_TRUE(stream.maps.note_terms(stream.now, at_clock(fine, 1e9)));
  EXPECT_NEAR(stream.latency_bound_s(), 0.88, 1e-6);
  EXPECT_NEAR(stream.interval_bound_s(), 0.88, 1e-6);
  EXPECT_FALSE(stream.maps.note_terms(stream.now, at_clock(fine, 1e9))) << "as before";
}

TEST(MapLatency, keeps_the_slowest_setting_until_the_map_that_it_may_have_begun_is_there) {
  Stream stream;
  stream.make(fine, 5, 400ms);
  stream.maps.note_terms(stream.now, at_clock(fine, 1e9));
  EXPECT_FALSE(stream.maps.note_terms(stream.now + 1ms, at_clock(fine, 4e9)));
  EXPECT_NEAR(stream.latency_bound_s(), 0.88, 1e-6);
  stream.now += 700ms;
  stream.publish(stream.now - 700ms, 0.15);
  EXPECT_NEAR(stream.maps.budget_use(), 0.7 / 0.88, 1e-6);
  EXPECT_NEAR(stream.latency_bound_s(), 0.22, 1e-6);
}

// Each fall of the clock used to stretch the bound, and no rise took that back.
TEST(MapLatency, does_not_ratchet_up_when_a_knob_goes_to_and_fro) {
  Stream stream;
  stream.make(fine, 5, 400ms);
  for (int i = 0; i < 1000; ++i) {
    stream.now += 20ms;
    stream.maps.note_terms(stream.now, i % 2 == 0 ? at_clock(fine, 0.5e9) : fine);
  }
  EXPECT_NEAR(stream.latency_bound_s(), 4.0 * 0.44, 1e-6);
  stream.publish(stream.now - 10s, 0.15);
  EXPECT_NEAR(stream.latency_bound_s(), 0.44, 1e-6);
}

TEST(MapLatency, does_not_depend_on_the_order_of_changes) {
  const std::vector<MapTerms> visited{at_clock(fine, 0.4e9), coarse, within(fine, 20.0),
                                      on_cores(coarse, 1), at_clock(within(coarse, 3.0), 0.6e9)};
  std::vector<Duration> bounds;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Stream stream;
    stream.make(fine, 5, 400ms);
    stream.make(coarse, 5, 100ms);
    RandomStream draw{seed, "order"};
    for (int i = 0; i < 50; ++i) {
      stream.maps.note_terms(stream.now, visited[draw.next() % visited.size()]);
    }
    for (const MapTerms& terms : visited) {  // Each of them at least once.
      stream.maps.note_terms(stream.now, terms);
    }
    bounds.push_back(stream.maps.latency_bound());
    stream.turn_to(fine);
    bounds.push_back(stream.maps.latency_bound());
  }
  for (std::size_t i = 2; i < bounds.size(); ++i) {
    EXPECT_EQ(bounds[i], bounds[i - 2]);
  }
}

TEST(MapLatency, expects_of_a_new_range_what_the_nearest_one_showed) {
  Stream stream;
  stream.make(fine, 5, 400ms);
  stream.make(within(fine, 14.0), 5, 800ms);
  stream.turn_to(within(fine, 8.0));
  EXPECT_NEAR(stream.latency_bound_s(), price_s(within(fine, 8.0)) * 0.44, 1e-6);
  stream.make(within(fine, 8.0), 1, 10ms);
  EXPECT_LT(stream.latency_bound_s(), 0.02) << "what it shows itself counts more";
}

TEST(MapLatency, expects_of_new_cells_what_the_nearest_ones_showed) {
  const MapTerms middle{0.30, 13.0, Hertz{2e9}, 4};
  Stream stream;
  stream.make(coarse, 5, from_seconds(0.3 * price_s(coarse)));
  stream.make(middle, 5, from_seconds(0.2 * price_s(middle)));
  stream.turn_to(fine);
  EXPECT_NEAR(stream.latency_bound_s(), 0.22, 1e-6);
}

TEST(MapLatency, expects_fewer_cores_to_take_at_most_as_many_times_longer) {
  Stream stream;
  stream.make(fine, 5, 400ms);
  stream.turn_to(on_cores(fine, 1));
  EXPECT_NEAR(stream.latency_bound_s(), 4.0 * 0.44, 1e-6);
  stream.make(on_cores(fine, 1), 5, 500ms);
  EXPECT_NEAR(stream.latency_bound_s(), 0.55, 1e-6);
  stream.turn_to(on_cores(fine, 2));
  EXPECT_NEAR(stream.latency_bound_s(), 0.55, 1e-6) << "more cores are not known to be faster";
}

TEST(MapLatency, stays_within_the_least_price_and_a_minute) {
  for (const MapTerms& terms : {within(fine, 0.001), at_clock(within(fine, 1e6), 1.0)}) {
    Stream stream;
    stream.turn_to(terms);
    for (const Duration bound : {stream.maps.latency_bound(), stream.maps.interval_bound()}) {
      EXPECT_GE(bound, 1ms);
      EXPECT_LE(bound, longest_latency_bound);
    }
  }
}

TEST(MapLatency, does_not_fill_the_memory_with_settings_that_never_come_back) {
  Stream stream;
  for (int i = 0; i < 1000; ++i) {
    stream.make(within(fine, 2.0 + 0.01 * i), 1, 400ms);
  }
  stream.make(within(fine, 7.0), 5, 400ms);
  EXPECT_NEAR(stream.latency_bound_s(), 0.44, 1e-6);
}

TEST(MapLatency, survives_a_computer_that_is_free) {
  MapLatency maps{{[](const MapTerms&) { return Duration::zero(); }, Duration::zero()}};
  maps.note_terms(MissionTime{1s}, fine);
  maps.published({1, MissionTime{1s}, 0.15, nullptr}, MissionTime{1010ms});
  EXPECT_NEAR(to_seconds(maps.latency_bound()), 0.011, 1e-6);
}

TEST(MapLatency, asks_for_the_clock_that_is_granted_not_for_the_one_that_was_wished) {
  const kit::GridMap map = kit::corridor(10.0);
  kit::MissionRig rig{map};
  KnobsInForce knobs = *rig.knobs;
  knobs.computer = {2, Hertz{0.5e9}};
  EXPECT_EQ(terms_of(knobs, *rig.brief).clock.value(), 0.5e9);
  EXPECT_EQ(terms_of(knobs, *rig.brief).cores, 2);
}

/// The terms while one frame in so many is mapped, and one in so many located by.
MapTerms with_intervals(MapTerms terms, Duration frames, Duration fixes = {}) {
  terms.frame_interval = frames;
  terms.fix_interval = fixes;
  return terms;
}

TEST(MapLatency, expects_the_interval_in_force_before_one_has_been_measured) {
  Stream stream;
  stream.make(coarse, 30, 50ms);
  const Duration before = stream.maps.age_bound();
  EXPECT_NEAR(to_seconds(before), 0.11, 1e-6);
  ASSERT_TRUE(stream.maps.note_terms(stream.now, with_intervals(coarse, 200ms)));
  EXPECT_NEAR(stream.interval_bound_s(), 0.22, 1e-6);
  EXPECT_NEAR(stream.latency_bound_s(), 0.055, 1e-6) << "a map takes no longer than before";
  const Guard guard{{}};
  for (const double free_m : {0.5, 2.0, 7.0, 20.0}) {
    EXPECT_LT(guard.cruise_speed(stream.maps.age_bound(), free_m),
              guard.cruise_speed(before, free_m));
  }
}

TEST(MapLatency, bounds_the_age_of_each_map_while_the_camera_is_turned_down_and_up) {
  Stream stream;
  stream.make(coarse, 30, 50ms);
  for (const Duration interval : {200ms, 50ms, 400ms, 100ms, 0ms}) {
    const MapTerms terms = with_intervals(coarse, interval);
    stream.maps.note_terms(stream.now, terms);
    for (int i = 0; i < 30; ++i) {
      const MissionTime captured = stream.now;
      stream.now += 30ms;
      stream.publish(captured, terms.resolution_m);
      stream.now = captured + std::max<Duration>(interval, 50ms);
      // Just before the next map, which takes as long as this one.
      EXPECT_GE(stream.maps.age_bound(), stream.now + 30ms - captured) << i;
    }
  }
  EXPECT_NEAR(stream.interval_bound_s(), 0.055, 1e-6) << "the slow times are not held against it";
}

TEST(MapLatency, adds_how_long_the_place_is_carried_on_without_a_frame) {
  Stream stream;
  stream.make(coarse, 30, 50ms);
  const double before_s = to_seconds(stream.maps.age_bound());
  ASSERT_TRUE(stream.maps.note_terms(stream.now, with_intervals(coarse, {}, 250ms)));
  EXPECT_NEAR(to_seconds(stream.maps.age_bound()), before_s + 0.25, 1e-6);
}

class RatesInForce : public testing::Test {
 protected:
  static Scenario with_rates() {
    Scenario scenario = kit::MissionRig::one_core();
    scenario.knobs.camera_rate = scenario.knobs.localizer_rate = true;
    return scenario;
  }
  void turn(const std::string& knob, double value) { ASSERT_TRUE(rig.set(knob, value)) << knob; }
  [[nodiscard]] double frames_s() const {
    return to_seconds(terms_of(*rig.knobs, *rig.brief).frame_interval);
  }
  [[nodiscard]] double fixes_s() const {
    return to_seconds(terms_of(*rig.knobs, *rig.brief).fix_interval);
  }
  kit::GridMap map{kit::corridor(10.0)};
  kit::MissionRig rig{map, with_rates()};
};

TEST_F(RatesInForce, are_no_matter_while_no_frame_is_left_out) {
  EXPECT_EQ(frames_s(), 0.0);
  EXPECT_EQ(fixes_s(), 0.0);
}

TEST_F(RatesInForce, of_camera_and_map_make_the_interval_between_maps) {
  turn("camera.rate_hz", 5.0);
  EXPECT_NEAR(frames_s(), 0.2, 1e-9);
  turn("map.rate_hz", 10.0);
  EXPECT_NEAR(frames_s(), 0.2, 1e-9) << "the camera is slower";
  turn("camera.rate_hz", 20.0);
  EXPECT_NEAR(frames_s(), 0.1, 1e-9);
  EXPECT_EQ(fixes_s(), 0.0) << "a localizer that takes no images knows its place at all times";
}

TEST_F(RatesInForce, of_camera_and_localizer_make_the_interval_between_fixes) {
  rig.brief->sees_its_place = true;
  turn("localizer.rate_hz", 5.0);
  EXPECT_NEAR(fixes_s(), 0.2, 1e-9);
  EXPECT_EQ(frames_s(), 0.0);
  turn("localizer.rate_hz", 20.0);
  turn("camera.rate_hz", 4.0);
  EXPECT_NEAR(fixes_s(), 0.25, 1e-9);
}

}  // namespace
}  // namespace flyball
