// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/newest_map.h"

#include "grid_map.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

const Aabb room_W{Vec3::Zero(), Vec3{4.0, 4.0, 2.0}};

FramePrice one_second() {
  return {[](const MapTerms&) { return Duration{1s}; }, Duration{1ms}};
}

MapRevision revision_at(MissionTime captured, std::uint64_t number) {
  return {number, captured, 0.2, std::make_shared<const kit::GridMap>(room_W, 0.2), 7.0};
}

TEST(NewestMap, is_a_declared_one_where_nothing_is_published) {
  NewestMap newest{one_second()};
  EXPECT_FALSE(newest.has_map());
  newest.declare(revision_at({}, 1).map);
  EXPECT_TRUE(newest.has_map());
  EXPECT_EQ(newest.published(), nullptr) << "it is no map that was made";
  EXPECT_EQ(newest.age_bound(), Duration::zero());
}

TEST(NewestMap, is_as_late_as_the_time_from_its_capture_to_its_publication) {
  NewestMap newest{one_second()};
  newest.note_terms(MissionTime{1s}, {});
  const MapRevision revision = revision_at(MissionTime{2s}, 3);
  newest.note(revision, MissionTime{2400ms});
  EXPECT_EQ(newest.latency(), Duration{400ms});
  EXPECT_EQ(newest.captured(), MissionTime{2s});
  EXPECT_EQ(newest.revision().number, 3U);
  EXPECT_EQ(newest.published(), revision.map);
  EXPECT_GT(newest.age_bound(), Duration::zero());
}

TEST(NewestMap, is_used_first_once) {
  NewestMap newest{one_second()};
  EXPECT_FALSE(newest.first_use(MissionTime{1s}));
  newest.note_terms(MissionTime{1s}, {});
  newest.note(revision_at(MissionTime{2s}, 1), MissionTime{2400ms});
  const auto use = newest.first_use(MissionTime{2500ms});
  ASSERT_TRUE(use);
  EXPECT_NEAR(use->sensor_to_command_s, 0.5, 1e-9);
  EXPECT_GT(use->budget_use, 0.0);
  EXPECT_FALSE(newest.first_use(MissionTime{2600ms}));
}

}  // namespace
}  // namespace flyball
