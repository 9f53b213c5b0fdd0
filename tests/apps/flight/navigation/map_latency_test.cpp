// SPDX-License-Identifier: BSD-3-Clause
#include "flight/navigation/map_latency.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

const MapTerms fine{0.15, 7.0, Hertz{2e9}};
const MapTerms coarse{0.60, 13.0, Hertz{2e9}};

/// Maps of one length, one after the other, under the terms of whoever asks.
struct Stream {
  void make(const MapTerms& terms, int n, Duration latency, Duration expected) {
    for (int i = 0; i < n; ++i) {
      const MissionTime captured = now;
      maps.note_terms(now, terms);
      now += latency;
      publish(captured, terms.resolution_m, expected);
    }
  }
  void publish(MissionTime captured, double resolution_m, Duration expected) {
    maps.published({++number, captured, now, resolution_m}, now, expected);
  }
  MapLatency maps;
  MissionTime now{1s};
  std::uint64_t number{};
};

TEST(MapLatency, begins_with_what_the_platform_expects) {
  MapLatency maps;
  maps.note_terms(MissionTime{1s}, fine);
  maps.note_terms(MissionTime{2s}, coarse);
  maps.published({1, MissionTime{1900ms}, MissionTime{2100ms}, 0.60}, MissionTime{2100ms}, 300ms);
  EXPECT_NEAR(to_seconds(maps.latency_bound()), 0.3, 1e-6);  // It was begun under other terms.
  EXPECT_NEAR(to_seconds(maps.interval_bound()), 0.3, 1e-6);
}

TEST(MapLatency, bounds_both_by_the_worst_of_late) {
  Stream stream;
  stream.make(fine, 5, 400ms, 1s);
  stream.make(fine, 1, 600ms, 1s);
  stream.make(fine, 5, 400ms, 1s);
  EXPECT_NEAR(to_seconds(stream.maps.latency_bound()), 0.66, 1e-6);
  EXPECT_NEAR(to_seconds(stream.maps.interval_bound()), 0.66, 1e-6);
}

TEST(MapLatency, tells_what_share_of_its_bound_a_map_took) {
  Stream stream;
  stream.make(fine, 5, 400ms, 1s);
  stream.make(fine, 1, 880ms, 1s);
  EXPECT_NEAR(stream.maps.budget_use(), 2.0, 1e-6);
  stream.make(fine, 1, 484ms, 1s);
  EXPECT_NEAR(stream.maps.budget_use(), 0.5, 1e-6);
}

TEST(MapLatency, holds_no_map_against_a_setting_under_which_it_was_not_made) {
  Stream stream;
  stream.make(fine, 5, 400ms, 1s);
  const Duration before = stream.maps.latency_bound();
  const MissionTime captured = stream.now;
  stream.now += 300ms;
  stream.maps.note_terms(stream.now, {0.15, 7.0, Hertz{0.5e9}});  // Slower, half way through.
  stream.now += 3s;
  stream.maps.note_terms(stream.now, fine);
  stream.publish(captured, 0.15, 1s);
  EXPECT_EQ(stream.maps.latency_bound(), before);
  EXPECT_GT(stream.maps.budget_use(), 7.0);  // It was late all the same.
}

TEST(MapLatency, counts_a_map_of_other_cells_for_none) {
  Stream stream;
  stream.make(coarse, 5, 100ms, 200ms);
  const Duration before = stream.maps.latency_bound();
  const MissionTime captured = stream.now;
  stream.now += 2s;
  stream.publish(captured, 0.15, 200ms);
  EXPECT_EQ(stream.maps.latency_bound(), before);
}

TEST(MapLatency, scales_with_the_clock_that_the_platform_prices) {
  Stream stream;
  stream.make(fine, 5, 400ms, 1s);
  stream.make({0.15, 7.0, Hertz{1e9}}, 1, 700ms, 2s);
  EXPECT_NEAR(to_seconds(stream.maps.latency_bound()), 0.88, 1e-6);  // 1.1 x .4 of 2 s
}

TEST(MapLatency, a_map_that_was_begun_at_a_lower_clock_has_the_time_that_it_had_then) {
  const MapTerms slow{0.15, 7.0, Hertz{1e9}};
  Stream stream;
  stream.make(slow, 5, 800ms, 2s);
  const MissionTime captured = stream.now;
  stream.now += 700ms;
  stream.maps.note_terms(stream.now, fine);  // Twice as fast, shortly before it is there.
  stream.publish(captured, 0.15, 1s);
  EXPECT_NEAR(stream.maps.budget_use(), 0.7 / 0.88, 1e-6);
  EXPECT_NEAR(to_seconds(stream.maps.latency_bound()), 0.44, 1e-6);
}

TEST(MapLatency, a_lowered_clock_stretches_what_is_in_force) {
  Stream stream;
  stream.make(fine, 5, 400ms, 1s);
  stream.maps.stretch(1.5);
  EXPECT_NEAR(to_seconds(stream.maps.latency_bound()), 0.66, 1e-6);
  EXPECT_NEAR(to_seconds(stream.maps.interval_bound()), 0.66, 1e-6);
}

TEST(MapLatency, expects_of_a_new_range_what_the_nearest_one_showed) {
  Stream stream;
  stream.make(fine, 5, 400ms, 1s);
  stream.make({0.15, 14.0, Hertz{2e9}}, 5, 800ms, 8s);
  stream.make({0.15, 8.0, Hertz{2e9}}, 1, 10ms, 1500ms);
  EXPECT_LT(to_seconds(stream.maps.latency_bound()), 0.02);
  Stream fresh;
  fresh.make(fine, 5, 400ms, 1s);
  fresh.make({0.15, 14.0, Hertz{2e9}}, 5, 800ms, 8s);
  fresh.maps.note_terms(fresh.now, {0.15, 8.0, Hertz{2e9}});
  fresh.publish(fresh.now - 2s, 0.15, 1500ms);  // Begun before: only the seed is known.
  EXPECT_NEAR(to_seconds(fresh.maps.latency_bound()), 1.5 * 0.44, 1e-6);
}

TEST(MapLatency, expects_of_new_cells_what_the_nearest_ones_showed) {
  Stream stream;
  stream.make(coarse, 5, 300ms, 1s);
  stream.make({0.30, 13.0, Hertz{2e9}}, 5, 400ms, 2s);
  stream.maps.note_terms(stream.now, fine);
  stream.publish(stream.now - 2s, 0.15, 4s);  // Begun before: only the seed is known.
  EXPECT_NEAR(to_seconds(stream.maps.latency_bound()), 4.0 * 0.22, 1e-6);
}

TEST(MapLatency, survives_a_computer_that_is_free) {
  Stream stream;
  stream.make(fine, 3, 10ms, 0ms);
  EXPECT_NEAR(to_seconds(stream.maps.latency_bound()), 0.011, 1e-6);
}

}  // namespace
}  // namespace flyball
