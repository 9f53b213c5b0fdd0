// SPDX-License-Identifier: BSD-3-Clause
#include "reference/visibility.h"

#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

Observation cruising(double t_s, double known_free_m) {
  Observation seen;
  seen.now = MissionTime{from_seconds(t_s)};
  seen.phase = MissionPhase::cruise;
  seen.known_free_m = known_free_m;
  return seen;
}

TEST(Visibility, is_what_the_world_shows_within_the_range) {
  Visibility visibility{20.0};
  for (int i = 0; i < 20; ++i) {
    visibility.note(cruising(0.25 * i, 6.0), 13.0);
  }
  EXPECT_NEAR(visibility.distance_m(), 6.0, 0.1);
}

TEST(Visibility, is_longer_at_once_and_shorter_after_about_a_second) {
  Visibility visibility{5.0};
  visibility.note(cruising(0.0, 9.0), 13.0);
  EXPECT_EQ(visibility.distance_m(), 9.0);
  visibility.note(cruising(0.25, 5.0), 13.0);
  EXPECT_GT(visibility.distance_m(), 7.5);
  for (int i = 2; i < 5; ++i) {
    visibility.note(cruising(0.25 * i, 5.0), 13.0);
  }
  EXPECT_LT(visibility.distance_m(), 6.5);
}

TEST(Visibility, stays_the_same_while_the_vehicle_flies_on_with_one_map) {
  Visibility visibility{10.0};
  for (int i = 0; i < 12; ++i) {
    Observation seen = cruising(10.0 + 0.25 * i, 8.0 - 4.0 * 0.25 * i);
    seen.speed_m_s = 4.0;
    seen.map_revision = 7;
    seen.map_age = from_seconds(0.5 + 0.25 * i);
    visibility.note(seen, 25.0);
  }
  EXPECT_NEAR(visibility.distance_m(), 10.0, 1e-6);  // 8 m and what was flown since the capture.
}

TEST(Visibility, takes_latency_for_the_age_of_a_map_whose_age_is_not_known) {
  Visibility visibility{5.0};
  Observation seen = cruising(10.0, 8.0);
  seen.speed_m_s = 4.0;
  seen.map_revision = 1;
  seen.latency = from_seconds(0.5);
  visibility.note(seen, 25.0);
  EXPECT_NEAR(visibility.distance_m(), 10.0, 1e-6);
}

TEST(Visibility, tries_longer_ranges_where_only_the_range_ended_it) {
  Visibility visibility{7.0};
  for (int i = 0; i < 8; ++i) {
    visibility.note(cruising(0.25 * i, 6.5), 7.0);
  }
  EXPECT_GT(visibility.distance_m(), 2.0 * 7.0);
  for (int i = 0; i < 200; ++i) {
    visibility.note(cruising(2.0 + 0.25 * i, 6.5), 7.0);
  }
  EXPECT_LE(visibility.distance_m(), 1e3);
}

TEST(Visibility, coarse_cells_end_farther_before_the_range_than_fine_ones) {
  for (const double cell_m : {0.15, 1.20}) {
    Visibility visibility{7.0};
    for (int i = 0; i < 8; ++i) {
      Observation seen = cruising(0.25 * i, 7.5);
      seen.map_resolution_m = cell_m;
      visibility.note(seen, 9.6);
    }
    EXPECT_EQ(visibility.distance_m() > 9.6, cell_m > 1.0) << cell_m;
  }
}

/// A map that was captured half a second ago and is free up to 9 m.
Observation half_a_second_old(double t_s, std::uint64_t revision) {
  Observation seen = cruising(t_s, 9.0);
  seen.map_revision = revision;
  seen.latency = from_seconds(0.2);
  seen.map_age = from_seconds(0.5);
  return seen;
}

TEST(Visibility, a_frame_from_before_a_longer_range_does_not_say_that_the_world_ends_the_view) {
  Visibility visibility{9.0};
  visibility.note(half_a_second_old(1.0, 1), 9.6);
  const double tried_m = visibility.distance_m();
  EXPECT_GT(tried_m, 9.6);
  visibility.note(half_a_second_old(1.25, 2), 13.2);  // Taken at .75 s.
  EXPECT_GE(visibility.distance_m(), tried_m);
  for (std::uint64_t i = 0; i < 20; ++i) {  // Now it is the world.
    visibility.note(half_a_second_old(2.0 + 0.25 * static_cast<double>(i), 3 + i), 13.2);
  }
  EXPECT_NEAR(visibility.distance_m(), 9.0, 0.1);
}

TEST(Visibility, learns_nothing_before_cruise_and_from_what_is_no_number) {
  Visibility visibility{7.0};
  Observation seen = cruising(1.0, 2.0);
  seen.phase = MissionPhase::take_off;
  visibility.note(seen, 13.0);
  visibility.note(cruising(2.0, std::numeric_limits<double>::quiet_NaN()), 13.0);
  visibility.note(cruising(3.0, std::numeric_limits<double>::infinity()), 13.0);
  EXPECT_EQ(visibility.distance_m(), 7.0);
}

}  // namespace
}  // namespace flyball
