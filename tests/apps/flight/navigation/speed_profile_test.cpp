// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/speed_profile.h"

#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

double no_limit(const Vec3&) {
  return 20.0;
}

TEST(SpeedProfile, stops_at_the_end_with_the_given_deceleration) {
  const Path path = Path::polyline({Vec3{0, 0, 1}, Vec3{100, 0, 1}});
  const SpeedProfile profile{path, SpeedProfileLimits{}, no_limit};
  EXPECT_NEAR(profile.at(100.0), 0.0, 1e-9);
  const double v = profile.at(94.0);
  EXPECT_NEAR(v * v / (2.0 * 3.0) + v * SpeedProfileLimits{}.lag_s, 6.0, 1e-3);
  EXPECT_NEAR(profile.at(10.0), 20.0, 1e-9);
}

TEST(SpeedProfile, slows_down_before_a_zone_and_not_in_it) {
  const Path path = Path::polyline({Vec3{0, 0, 1}, Vec3{100, 0, 1}});
  const SpeedProfile profile{path, SpeedProfileLimits{},
                             [](const Vec3& p) { return p.x() > 50.0 ? 1.0 : 20.0; }};
  EXPECT_NEAR(profile.at(60.0), 1.0, 1e-9);
  const double v = profile.at(44.05);
  const double lag_s = SpeedProfileLimits{}.lag_s;
  EXPECT_NEAR((v * v - 1.0) / (2.0 * 3.0) + (v - 1.0) * lag_s, 6.0, 0.05);
}

TEST(SpeedProfile, crawls_through_a_corner) {
  const Path path = Path::polyline({Vec3{0, 0, 1}, Vec3{10, 0, 1}, Vec3{10, 10, 1}});
  const SpeedProfile profile{path, SpeedProfileLimits{}, no_limit};
  EXPECT_LE(profile.at(10.0), 0.051);
  EXPECT_GT(profile.at(5.0), 3.0);
}

}  // namespace
}  // namespace flyball
