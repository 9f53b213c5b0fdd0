// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/atmosphere.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

// ISO 2533 by geopotential height, which is 4 m less than geometric height at 5 km.
TEST(Atmosphere, has_the_pressures_of_the_standard) {
  EXPECT_NEAR(standard_pressure_pa(0.0), 101325.0, 1e-6);
  EXPECT_NEAR(standard_pressure_pa(500.0), 95460.8, 1.0);
  EXPECT_NEAR(standard_pressure_pa(1000.0), 89874.6, 1.0);
  EXPECT_NEAR(standard_pressure_pa(5000.0), 54019.9, 1.0);
}

TEST(Atmosphere, height_inverts_pressure) {
  for (const double height_m : {-50.0, 0.0, 3.0, 400.0, 2500.0}) {
    EXPECT_NEAR(pressure_height_m(standard_pressure_pa(height_m)), height_m, 1e-6);
  }
}

}  // namespace
}  // namespace flyball
