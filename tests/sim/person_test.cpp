// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "flyball/sim/person.h"

#include "flyball/sim/world.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

MissionTime at_s(double t_s) {
  return MissionTime{from_seconds(t_s)};
}

TEST(Person, goes_evenly_from_point_to_point_and_rests_at_both_ends) {
  Person person;
  person.walk = {{1.0, {0.0, 0.0, 0.0}}, {3.0, {4.0, 0.0, 0.0}}};
  EXPECT_DOUBLE_EQ(person.at(at_s(0.0)).foot_W.x(), 0.0);
  EXPECT_DOUBLE_EQ(person.at(at_s(2.0)).foot_W.x(), 2.0);
  EXPECT_DOUBLE_EQ(person.at(at_s(9.0)).foot_W.x(), 4.0);
  EXPECT_DOUBLE_EQ(person.centre_W(at_s(9.0)).z(), 0.5 * person.height_m);
}

TEST(Person, looks_where_it_goes_and_keeps_looking_there_when_it_stops) {
  Person person;
  person.heading_rad = 2.0;
  person.walk = {{1.0, {0.0, 0.0, 0.0}}, {3.0, {0.0, 4.0, 0.0}}, {60.0, {0.0, 4.0, 0.0}}};
  EXPECT_DOUBLE_EQ(person.at(at_s(0.0)).heading_rad, 2.0);
  EXPECT_NEAR(person.at(at_s(2.0)).heading_rad, std::acos(0.0), 1e-12);
  EXPECT_NEAR(person.at(at_s(30.0)).heading_rad, std::acos(0.0), 1e-12);
}

class Walk : public testing::Test {
 protected:
  const Aabb area{{-20.0, -15.0, 0.0}, {20.0, 15.0, 0.0}};
  const std::vector<WalkObstacle> trees{{{5.0, 5.0, 0.0}, 2.0}, {{-8.0, 0.0, 0.0}, 3.0}};
  [[nodiscard]] Person walker(std::uint64_t seed) const {
    Person person;
    person.walk = random_walk(Vec3::Zero(), area, trees, {}, {seed, "walk"});
    return person;
  }
};

TEST_F(Walk, stays_in_its_area_and_out_of_obstacles_at_every_moment) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Person person = walker(seed);
    for (double t_s = 0.0; t_s < 300.0; t_s += 0.25) {
      const Vec3 p = person.at(at_s(t_s)).foot_W;
      ASSERT_TRUE(area.contains(p)) << "seed " << seed << ", " << t_s << " s";
      for (const WalkObstacle& tree : trees) {
        ASSERT_GE((p - tree.centre_W).norm(), tree.radius_m - 1e-9);
      }
    }
  }
}

TEST_F(Walk, sprints_now_and_then_and_is_never_faster_than_a_sprint) {
  const WalkStyle style;
  const Person person = walker(7);
  double fastest = 0.0;
  double way_m = 0.0;
  for (double t_s = 0.0; t_s < style.duration_s; t_s += 0.1) {
    const double step_m = (person.at(at_s(t_s + 0.1)).foot_W - person.at(at_s(t_s)).foot_W).norm();
    fastest = std::max(fastest, step_m / 0.1);
    way_m += step_m;
  }
  EXPECT_GT(fastest, 2.0);
  EXPECT_LT(fastest, 1.15 * style.sprint_m_s + 1e-6);
  EXPECT_GT(way_m / style.duration_s, 0.8 * style.speed_m_s);
}

TEST_F(Walk, is_the_same_for_a_seed_and_another_for_another) {
  EXPECT_EQ(walker(3).at(at_s(50.0)).foot_W, walker(3).at(at_s(50.0)).foot_W);
  EXPECT_GT((walker(3).at(at_s(50.0)).foot_W - walker(4).at(at_s(50.0)).foot_W).norm(), 0.1);
}

TEST_F(Walk, of_somebody_walled_in_is_a_wait) {
  const std::vector<WalkObstacle> ring{{{0.0, 0.0, 0.0}, 10.0}};
  const auto walk = random_walk(Vec3::Zero(), area, ring, {}, {1, "walk"});
  EXPECT_EQ(walk.back().foot_W, Vec3::Zero());
  EXPECT_GE(walk.back().time_s, WalkStyle{}.duration_s);
}

TEST(DistanceToPeople, is_between_the_surfaces_of_two_upright_cylinders) {
  Person person;
  person.walk = {{0.0, {3.0, 0.0, 0.0}}, {10.0, {13.0, 0.0, 0.0}}};
  const Cylinder body{0.4, 0.1};
  const std::vector<Person> people{person};
  EXPECT_NEAR(distance_to_people_m(people, at_s(0.0), {0.0, 0.0, 1.0}, body, 5.0), 2.3, 1e-12);
  EXPECT_NEAR(distance_to_people_m(people, at_s(1.0), {0.0, 0.0, 1.0}, body, 5.0), 3.3, 1e-12);
  EXPECT_NEAR(distance_to_people_m(people, at_s(0.0), {3.0, 0.0, 3.0}, body, 5.0), 1.15, 1e-12);
  EXPECT_EQ(distance_to_people_m(people, at_s(0.0), {3.0, 0.0, 1.0}, body, 5.0), 0.0);
  EXPECT_EQ(distance_to_people_m(people, at_s(0.0), {90.0, 0.0, 1.0}, body, 5.0), 5.0);
}

}  // namespace
}  // namespace flyball
