// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/flown_way.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

void fly(FlownWay& way, const Vec3& from_W, const Vec3& to_W) {
  const int steps = static_cast<int>(std::ceil((to_W - from_W).norm() / 0.05));
  for (int i = 0; i <= steps; ++i) {
    way.flew(from_W + (to_W - from_W) * i / steps);
  }
}

constexpr double all = 0.0;
const Vec3 home_W{0.0, 0.0, 1.5};
const Vec3 corner_W{20.0, 0.0, 1.5};
const Vec3 far_W{20.0, 10.0, 1.5};

FlownWay around_a_corner() {
  FlownWay way;
  fly(way, home_W, corner_W);
  fly(way, corner_W, far_W);
  return way;
}

double longest_piece_m(const std::vector<Vec3>& way_W) {
  double longest_m = 0.0;
  for (std::size_t i = 1; i < way_W.size(); ++i) {
    longest_m = std::max(longest_m, (way_W[i] - way_W[i - 1]).norm());
  }
  return longest_m;
}

TEST(FlownWay, leads_home_around_the_corner_by_which_the_vehicle_came) {
  const auto way_W = around_a_corner().between(far_W, home_W, all);
  ASSERT_GT(way_W.size(), 100U);
  EXPECT_LT((way_W.front() - far_W).norm(), 0.11);
  EXPECT_LT((way_W.back() - home_W).norm(), 0.11);
  EXPECT_LT(longest_piece_m(way_W), 0.2);
  for (const Vec3& p_W : way_W) {
    EXPECT_LT(std::min(std::abs(p_W.y()), std::abs(p_W.x() - 20.0)), 0.01) << p_W.transpose();
  }
}

TEST(FlownWay, leads_out_again) {
  const auto way_W = around_a_corner().between(home_W, far_W, all);
  ASSERT_FALSE(way_W.empty());
  EXPECT_LT((way_W.front() - home_W).norm(), 0.11);
  EXPECT_LT((way_W.back() - far_W).norm(), 0.11);
}

TEST(FlownWay, begins_beside_the_vehicle_or_not_at_all) {
  const FlownWay way = around_a_corner();
  const Vec3 beside_W{12.0, 2.0, 1.5};
  const auto way_W = way.between(beside_W, home_W, all);
  ASSERT_GT(way_W.size(), 2U);
  EXPECT_EQ(way_W.front(), beside_W);
  EXPECT_NEAR(way_W[1].x(), 12.0, 0.11);
  EXPECT_EQ(way_W[1].y(), 0.0);
  EXPECT_TRUE(way.between(Vec3{12.0, 4.0, 1.5}, home_W, all).empty());
}

TEST(FlownWay, is_no_longer_than_is_asked_for) {
  const auto way_W = around_a_corner().between(far_W, home_W, 15.0);
  ASSERT_FALSE(way_W.empty());
  EXPECT_NEAR((way_W.back() - Vec3{15.0, 0.0, 1.5}).norm(), 0.0, 0.21);
}

TEST(FlownWay, goes_on_from_where_the_vehicle_left_it_without_a_record) {
  FlownWay way = around_a_corner();
  fly(way, Vec3{10.0, 0.5, 1.5}, Vec3{10.0, 9.0, 1.5});
  const auto way_W = way.between(Vec3{10.0, 9.0, 1.5}, home_W, all);
  ASSERT_FALSE(way_W.empty());
  EXPECT_LT(longest_piece_m(way_W), 1.1);
  for (const Vec3& p_W : way_W) {
    EXPECT_LT(p_W.x(), 10.2) << "it does not go where the vehicle was before";
  }
}

TEST(FlownWay, begins_anew_where_the_vehicle_is_somewhere_else) {
  FlownWay way = around_a_corner();
  way.flew(Vec3{10.0, 5.0, 1.5});
  EXPECT_FALSE(way.leads_to(home_W));
  EXPECT_TRUE(way.leads_to(Vec3{10.0, 5.0, 1.5}));
}

TEST(FlownWay, leads_to_nothing_that_it_does_not_pass) {
  const FlownWay way = around_a_corner();
  EXPECT_TRUE(way.leads_to(home_W + Vec3{0.5, 0.5, 0.0}));
  EXPECT_FALSE(way.leads_to(Vec3{0.0, 10.0, 1.5}));
  EXPECT_TRUE(way.between(far_W, Vec3{0.0, 10.0, 1.5}, all).empty());
  EXPECT_FALSE(FlownWay{}.leads_to(home_W));
  EXPECT_TRUE(FlownWay{}.between(far_W, home_W, all).empty());
}

TEST(FlownWay, leaves_loops_out) {
  FlownWay way = around_a_corner();
  fly(way, far_W, corner_W);  // A dead end.
  fly(way, corner_W, Vec3{20.0, -10.0, 1.5});
  const auto way_W = way.between(Vec3{20.0, -10.0, 1.5}, home_W, all);
  ASSERT_FALSE(way_W.empty());
  EXPECT_LT(longest_piece_m(way_W), 0.5);
  const auto highest = std::max_element(way_W.begin(), way_W.end(),
                                        [](const Vec3& a, const Vec3& b) { return a.y() < b.y(); });
  EXPECT_LT(highest->y(), 1.6) << "a spur may remain, half as long as the shortest loop";
}

}  // namespace
}  // namespace flyball
