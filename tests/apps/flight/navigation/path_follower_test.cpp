// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/path_follower.h"

#include "mission_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;
using kit::GridMap;

struct Ride {
  explicit Ride(double known_to_m, const Scenario& scenario = kit::MissionRig::one_core())
      : map{kit::corridor(known_to_m)}, rig{map, scenario}, follower{rig.brief} {
    follower.set_knobs(rig.knobs);
    follower.hover_at(Vec3{0, 0, 1.5}, 0.0);
    follower.set_latency_bound(200ms);
    EXPECT_TRUE(follower.adopt(Path::polyline({Vec3{0, 0, 1.5}, Vec3{50, 0, 1.5}}), 0.0));
    follower.refresh_known_free(map);
  }
  void tick(int n) {
    for (int i = 0; i < n; ++i) {
      now += 20ms;
      follower.map_captured(now);
      follower.refresh_known_free(map);
      follower.tick(now, 20ms, Vec3::Zero());
    }
  }
  GridMap map;
  kit::MissionRig rig;
  PathFollower follower;
  MissionTime now{};
};

TEST(PathFollower, stops_before_the_first_place_that_is_not_known_free) {
  Ride ride{20.0};
  ride.tick(2000);
  EXPECT_LT(ride.follower.s_m(), 20.0 - 0.325);  // The body's radius short of unknown space.
  EXPECT_GT(ride.follower.s_m(), 19.0);
  EXPECT_LT(ride.follower.speed_m_s(), 0.1);
}

TEST(PathFollower, faces_a_heading_where_it_comes_to_stand_and_where_it_hovers) {
  Ride ride{60.0};
  ride.follower.face(2.0);
  ride.tick(200);
  EXPECT_NEAR(ride.follower.yaw_rad(), 0.0, 0.01) << "on the way it looks ahead";
  ride.tick(3000);
  ASSERT_TRUE(ride.follower.stands_still());
  EXPECT_NEAR(ride.follower.yaw_rad(), 2.0, 0.01);
  ride.follower.hover_at(Vec3{0, 0, 1.5}, 0.0);
  ride.follower.face(-1.0);
  ride.tick(200);
  EXPECT_NEAR(ride.follower.yaw_rad(), -1.0, 0.01);
}

TEST(PathFollower, turns_to_its_heading_while_it_brakes_at_the_end_of_a_known_path) {
  Ride ride{60.0};
  ride.follower.face(0.3);
  while (!ride.follower.stands_still()) {
    EXPECT_TRUE(ride.follower.yaw_rad() == 0.0 || ride.follower.s_m() > 49.5);
    ride.tick(1);
  }
  EXPECT_NEAR(ride.follower.yaw_rad(), 0.3, 0.01);
}

TEST(PathFollower, flies_slower_with_a_larger_latency) {
  Ride quick{60.0};
  Ride slow{60.0};
  slow.follower.set_latency_bound(2s);
  quick.tick(100);
  slow.tick(100);
  EXPECT_GT(quick.follower.speed_m_s(), 1.3 * slow.follower.speed_m_s());
}

TEST(PathFollower, never_exceeds_the_guards_speed_at_any_tick) {
  Ride ride{30.0};
  for (int i = 0; i < 1500; ++i) {
    ride.tick(1);
    const double v = ride.follower.speed_m_s();
    const double stop_m = v * v / (2.0 * 6.0);
    // Free space is looked up in steps of .075 m from the moving reference: it can shrink by one.
    EXPECT_LE(stop_m, ride.follower.known_free_m() + 0.075) << "at tick " << i;
  }
}

TEST(PathFollower, arrives_at_the_end_of_a_known_path) {
  Ride ride{60.0};
  ride.tick(3000);
  EXPECT_TRUE(ride.follower.is_at_end());
  EXPECT_EQ(ride.follower.speed_m_s(), 0.0);
}

// With a second of latency as reaction time the last decimetre but one centimetre takes 2.5 s, the
// last centimetre but one millimetre as long again.
TEST(PathFollower, does_not_creep_to_the_end_of_a_known_path_when_maps_are_late) {
  Ride ride{60.0};
  ride.follower.set_latency_bound(1s);
  while (ride.follower.s_m() < ride.follower.path().length_m() - 0.1) {
    ride.tick(1);
  }
  ride.tick(125);  // 2.5 s.
  EXPECT_TRUE(ride.follower.is_at_end());
}

TEST(PathFollower, stops_at_a_committed_stop_and_goes_on_with_the_next_plan) {
  Ride ride{60.0};
  ride.tick(50);
  const double splice_m = ride.follower.stop_point_m(5.0);
  ride.follower.commit_stop(splice_m);
  ride.tick(500);
  EXPECT_NEAR(ride.follower.s_m(), splice_m, 0.01);
  EXPECT_FALSE(ride.follower.is_at_end());
  const Vec3 from = ride.follower.position_W();
  ASSERT_TRUE(ride.follower.adopt(Path::polyline({from, Vec3{40, 2, 1.5}}), splice_m));
  ride.follower.refresh_known_free(ride.map);
  ride.tick(2000);
  EXPECT_NEAR((ride.follower.position_W() - Vec3{40, 2, 1.5}).norm(), 0.0, 0.02);
}

TEST(PathFollower, brakes_for_a_committed_stop_no_harder_than_the_mission_may) {
  constexpr double limit_m_s2 = 3.0;
  Scenario gentle = kit::MissionRig::one_core();
  gentle.mission.max_acceleration_m_s2 = limit_m_s2;
  Ride ride{60.0, gentle};
  ride.tick(100);
  ride.follower.commit_stop(ride.follower.planned_stop_m());
  double hardest_m_s2 = 0.0;
  for (int i = 0; i < 500; ++i) {
    const double before_m_s = ride.follower.speed_m_s();
    ride.tick(1);
    hardest_m_s2 =
        std::max(hardest_m_s2, (before_m_s - ride.follower.speed_m_s()) / to_seconds(20ms));
  }
  EXPECT_LT(ride.follower.speed_m_s(), 0.01);
  EXPECT_GT(hardest_m_s2, 0.5 * limit_m_s2);
  EXPECT_LT(hardest_m_s2, 1.05 * limit_m_s2);
}

TEST(PathFollower, refuses_a_path_whose_start_it_has_passed) {
  Ride ride{60.0};
  ride.tick(100);
  const double passed_m = ride.follower.s_m() - 0.5;
  const Vec3 before = ride.follower.position_W();
  EXPECT_FALSE(ride.follower.adopt(Path::polyline({before, Vec3{40, 2, 1.5}}), passed_m));
  EXPECT_EQ(ride.follower.position_W(), before);
}

TEST(PathFollower, refuses_a_corner_that_it_could_not_brake_for) {
  Ride ride{60.0};
  ride.tick(100);
  const double v = ride.follower.speed_m_s();
  ASSERT_GT(v, 3.0);
  const auto corner_after = [&](double metres) {
    const double splice_m = ride.follower.s_m() + metres;
    const Vec3 at = ride.follower.path().at(splice_m).p_W;
    return ride.follower.adopt(Path::polyline({at, at + Vec3{0, 5, 0}}), splice_m);
  };
  const double stop_m = v * v / 10.0 + v * SpeedProfileLimits{}.lag_s;
  EXPECT_FALSE(corner_after(0.9 * stop_m));
  EXPECT_TRUE(corner_after(1.1 * stop_m));
}

TEST(PathFollower, does_not_trust_free_space_beyond_what_the_newest_frame_can_see) {
  Ride ride{60.0};
  ride.tick(200);
  const double body_m = ride.rig.brief->body_at(10.0).radius_m;
  const double range_m = ride.rig.knobs->value("map.range_m");
  const double delta_s = 0.2 + to_seconds(ride.follower.guard().reaction_time());
  EXPECT_NEAR(ride.follower.speed_m_s(), safe_speed(6.0, delta_s, range_m - body_m), 0.05);
}

TEST(PathFollower, goes_by_the_range_of_the_map_where_its_mapper_cuts_that_of_the_knob) {
  Ride ride{60.0};
  for (int i = 0; i < 200; ++i) {
    ride.now += 20ms;
    ride.follower.map_captured(ride.now, 4.0);
    ride.follower.refresh_known_free(ride.map);
    ride.follower.tick(ride.now, 20ms, Vec3::Zero());
  }
  const double body_m = ride.rig.brief->body_at(10.0).radius_m;
  const double delta_s = 0.2 + to_seconds(ride.follower.guard().reaction_time());
  EXPECT_NEAR(ride.follower.speed_m_s(), safe_speed(6.0, delta_s, 4.0 - body_m), 0.05);
}

TEST(PathFollower, believes_declared_space_to_any_distance_where_there_is_no_map) {
  GridMap map = kit::corridor(45.0);
  kit::MissionRig rig{map};
  rig.brief->maps_obstacles = false;
  PathFollower follower{rig.brief};
  follower.set_knobs(rig.knobs);
  follower.hover_at(Vec3{0, 0, 1.5}, 0.0);
  ASSERT_TRUE(follower.adopt(Path::polyline({Vec3{0, 0, 1.5}, Vec3{50, 0, 1.5}}), 0.0));
  follower.refresh_known_free(map);  // Once: nothing is published that would change it.
  MissionTime now{};
  double fastest_m_s = 0.0;
  for (int i = 0; i < 1500; ++i) {
    follower.tick(now += 20ms, 20ms, Vec3::Zero());
    fastest_m_s = std::max(fastest_m_s, follower.speed_m_s());
  }
  EXPECT_NEAR(fastest_m_s, 10.0, 0.05);  // The knob's limit; in sight of 7 m it would be 8.
  EXPECT_LT(follower.s_m(), 45.0 - 0.325);
  EXPECT_GT(follower.s_m(), 44.0);
  EXPECT_LT(follower.speed_m_s(), 0.1);
}

TEST(PathFollower, turns_in_place_towards_a_path_behind_it) {
  GridMap map = kit::corridor(60.0);
  kit::MissionRig rig{map};
  PathFollower follower{rig.brief};
  follower.set_knobs(rig.knobs);
  follower.hover_at(Vec3{10, 0, 1.5}, 0.0);
  ASSERT_TRUE(follower.adopt(Path::polyline({Vec3{10, 0, 1.5}, Vec3{0, 0.5, 1.5}}), 0.0));
  MissionTime now{};
  const auto tick = [&](int n) {
    for (int i = 0; i < n; ++i) {
      follower.tick(now += 20ms, 20ms, Vec3::Zero());
    }
  };
  tick(75);
  EXPECT_FALSE(follower.faces_path_since().has_value());
  tick(75);
  EXPECT_GT(std::abs(follower.yaw_rad()), 2.5);
  ASSERT_TRUE(follower.faces_path_since().has_value());
  EXPECT_NEAR(to_seconds(follower.faces_path_since()->time_since_epoch()), 2.0, 0.1);
  follower.hover_at(Vec3{10, 0, 1.5}, 0.0);
  EXPECT_FALSE(follower.faces_path_since().has_value());
}

}  // namespace
}  // namespace flyball
