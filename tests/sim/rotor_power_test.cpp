// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/sim/rotor_power.h"

#include "flight.h"
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

const Vec3 calm = Vec3::Zero();

VehicleState flying(const Vec3& v_WB, const Vec3& a_WB = Vec3::Zero()) {
  VehicleState state;
  state.v_WB = v_WB;
  state.a_WB = a_WB;
  state.rotor_rev_s = {60.0, 60.0, 60.0, 60.0};
  return state;
}

/// After the low-pass has settled.
double settled_w(const VehicleState& state, double payload_kg = 0.0, const Vec3& wind_W = calm) {
  RegressionPower power{shipped_airframe("matrice_100")};
  double power_w = 0.0;
  for (int i = 0; i < 100; ++i) {
    power_w = power.update(state, payload_kg, wind_W, 0.1);
  }
  return power_w;
}

TEST(RotorPower, hovers_at_b9_and_a_gram_costs_b7) {
  EXPECT_NEAR(settled_w(flying(calm)), 251.7, 1e-9);
  EXPECT_NEAR(settled_w(flying(calm), 0.5), 251.7 + 0.197 * 500.0, 1e-9);
}

TEST(RotorPower, is_eq_1_term_by_term) {
  EXPECT_NEAR(settled_w(flying({3.0, 4.0, 0.0})), 251.7 - 2.595 * 5.0, 1e-9);
  EXPECT_NEAR(settled_w(flying({0.0, 0.0, -2.0})), 251.7 + 18.321 * 2.0, 1e-9);
  EXPECT_NEAR(settled_w(flying({5.0, 0.0, 0.0}, {0.0, -2.0, 0.0})),
              251.7 - 2.595 * 5.0 + 0.116 * 2.0 + 0.824 * 5.0 * 2.0, 1e-6);
  EXPECT_NEAR(settled_w(flying({0.0, 0.0, 2.0}, {0.0, 0.0, -1.0})),
              251.7 + 18.321 * 2.0 + 31.745 + 13.282 * 2.0, 1e-6);
  EXPECT_NEAR(settled_w(flying({2.0, 1.0, 0.0}), 0.0, {3.0, -1.0, 7.0}),
              251.7 - 2.595 * std::sqrt(5.0) + 1.43 * 5.0, 1e-9);
}

TEST(RotorPower, takes_speeds_beyond_fifteen_for_fifteen) {
  EXPECT_NEAR(settled_w(flying({30.0, 0.0, 0.0})), 251.7 - 2.595 * 15.0, 1e-9);
}

TEST(RotorPower, never_falls_below_half_of_hovering) {
  EXPECT_NEAR(settled_w(flying({15.0, 0.0, 0.0}), 0.0, {-20.0, 0.0, 0.0}), 0.5 * 251.7, 1e-9);
}

TEST(RotorPower, filters_the_acceleration_with_half_a_second) {
  RegressionPower power{shipped_airframe("matrice_100")};
  double power_w = 0.0;
  for (int i = 0; i < 500; ++i) {
    power_w = power.update(flying(calm, {0.0, 0.0, 1.0}), 0.0, calm, 0.001);
  }
  EXPECT_NEAR(power_w, 251.7 + 31.745 * (1.0 - std::exp(-1.0)), 1e-6);
  for (int i = 0; i < 5000; ++i) {  // Jitter of the same size, which |a| would rectify
    power_w = power.update(flying(calm, {0.0, 0.0, i % 2 == 0 ? 1.0 : -1.0}), 0.0, calm, 0.001);
  }
  EXPECT_NEAR(power_w, 251.7, 0.1);
}

TEST(RotorPower, rotors_at_rest_take_none) {
  RegressionPower power{shipped_airframe("matrice_100")};
  EXPECT_EQ(power.update(VehicleState{}, 0.5, calm, 0.001), 0.0);
}

TEST(RotorPower, thrust_model_agrees_with_eq_1_in_a_hover) {
  Flight flight;
  flight.run(1.0);
  EXPECT_NEAR(flight.vehicle.shaft_power_w(), 176.0, 2.0);
  EXPECT_NEAR(thrust_power_w(flight.vehicle, 0.70), 251.7, 0.02 * 251.7);
}

TEST(RotorPower, thrust_model_knows_that_payload_costs_its_three_halves_power) {
  Flight bare;
  Flight loaded{1.0};
  const double weight_ratio = loaded.vehicle.mass_kg() / bare.vehicle.mass_kg();
  EXPECT_NEAR(loaded.vehicle.shaft_power_w() / bare.vehicle.shaft_power_w(),
              std::pow(weight_ratio, 1.5), 0.02);
}

TEST(RotorPowerDeathTest, refuses_an_airframe_without_coefficients) {
  RegressionPower power{shipped_airframe("f450")};
  EXPECT_DEATH((void)power.update(flying(calm), 0.0, calm, 0.001), "f450");
}

}  // namespace
}  // namespace flyball
