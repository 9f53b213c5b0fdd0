// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/sim/battery.h"

#include "flyball/sim/rotor_power.h"

#include "flight.h"
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Chen & Rincon-Mora 2006, eq. 2, written out again.
double open_circuit_v(double s) {
  return -1.031 * std::exp(-35.0 * s) + 3.685 + 0.2156 * s - 0.1178 * s * s + 0.3201 * s * s * s;
}

TEST(Battery, shows_its_open_circuit_voltage_at_rest) {
  for (const double charge : {1.0, 0.5, 0.1}) {
    EXPECT_NEAR(Battery(6, 4.5, charge).voltage_v(), 6.0 * open_circuit_v(charge), 1e-12);
  }
}

TEST(Battery, counts_the_charge_that_the_current_takes) {
  Battery battery{6, 4.5};
  double taken_as = 0.0;
  for (int i = 0; i < 60000; ++i) {
    battery.draw(300.0, 0.01);
    taken_as += 300.0 / battery.voltage_v() * 0.01;
  }
  ASSERT_FALSE(battery.is_empty());
  EXPECT_NEAR(1.0 - battery.charge(), taken_as / (3600.0 * 4.5), 1e-9);
  EXPECT_GT(1.0 - battery.charge(), 0.4);
}

TEST(Battery, settles_at_the_resistances_of_the_scaled_cell) {
  // One 850 mAh cell at half charge: V = Voc - i (Rs + R1 + R2) once the transients are over, with
  // the resistances at s = .5 and the fitted factor .3.
  Battery battery{1, 0.85, 0.5};
  const double before = battery.charge();
  for (int i = 0; i < 1500; ++i) {
    battery.draw(0.01, 1.0);  // A current too small to change the charge much
  }
  const double current_a = (before - battery.charge()) * 0.85 * 3600.0 / 1500.0;
  const double ohm = 0.3 * (0.07446 + 0.04669 + 0.04984);
  EXPECT_NEAR(battery.voltage_v(), open_circuit_v(battery.charge()) - current_a * ohm, 1e-5);
}

TEST(Battery, sags_under_load_and_recovers) {
  Battery battery{6, 4.5, 0.6};
  const double rested_v = battery.voltage_v();
  battery.draw(600.0, 0.001);
  const double at_once_v = battery.voltage_v();
  EXPECT_LT(at_once_v, rested_v - 0.1);
  for (int i = 0; i < 600; ++i) {
    battery.draw(600.0, 0.1);
  }
  const double loaded_v = battery.voltage_v();
  EXPECT_LT(loaded_v, at_once_v - 0.1);
  for (int i = 0; i < 30000; ++i) {
    battery.draw(0.0, 0.1);
  }
  EXPECT_GT(battery.voltage_v(), loaded_v + 0.3);
  EXPECT_NEAR(battery.voltage_v(), 6.0 * open_circuit_v(battery.charge()), 0.01);
}

TEST(Battery, does_not_depend_on_the_step) {
  Battery fine{6, 4.5};
  Battery coarse{6, 4.5};
  for (int i = 0; i < 300000; ++i) {
    fine.draw(250.0, 0.001);
  }
  for (int i = 0; i < 3000; ++i) {
    coarse.draw(250.0, 0.1);
  }
  EXPECT_NEAR(fine.charge(), coarse.charge(), 1e-5);
  EXPECT_NEAR(fine.voltage_v(), coarse.voltage_v(), 1e-3);
}

TEST(Battery, empties_at_three_volts_a_cell_and_stays_empty) {
  Battery battery{6, 4.5, 0.3};
  double last_v = battery.voltage_v();
  int steps = 0;
  while (!battery.is_empty()) {
    last_v = battery.voltage_v();
    battery.draw(400.0, 0.1);
    ASSERT_LT(++steps, 100000);
  }
  EXPECT_GE(last_v, 18.0);
  EXPECT_LT(battery.voltage_v(), 18.0);
  const double left = battery.charge();
  battery.draw(400.0, 10.0);
  battery.draw(0.0, 1000.0);
  EXPECT_TRUE(battery.is_empty());
  EXPECT_EQ(battery.charge(), left);
}

TEST(Battery, empties_when_no_current_can_give_the_power) {
  Battery battery{6, 4.5};
  battery.draw(1e5, 0.001);
  EXPECT_TRUE(battery.is_empty());
}

double hover_minutes(const Airframe& airframe, double payload_kg) {
  RegressionPower power{airframe};
  Battery battery{airframe.battery_cells, airframe.battery_ah};
  VehicleState hovering;
  hovering.rotor_rev_s = {61.0, 61.0, 61.0, 61.0};
  constexpr double dt_s = 0.1;
  double t_s = 0.0;
  while (!battery.is_empty()) {
    battery.draw(power.update(hovering, payload_kg, Vec3::Zero(), dt_s), dt_s);
    t_s += dt_s;
  }
  return t_s / 60.0;
}

TEST(Battery, lasts_as_long_as_the_maker_of_the_default_vehicle_says) {
  const Airframe airframe = shipped_airframe("matrice_100");
  const struct {
    double payload_kg;
    double maker_min;
  } rows[] = {{0.0, 22.0}, {0.5, 17.0}, {1.0, 13.0}};  // TB47D, hovering, without a computer
  for (const auto& row : rows) {
    const double minutes = hover_minutes(airframe, row.payload_kg);
    std::printf("hover with %.1f kg: %.1f min (maker %.0f)\n", row.payload_kg, minutes,
                row.maker_min);
    EXPECT_NEAR(minutes, row.maker_min, 0.1 * row.maker_min);
  }
}

TEST(BatteryDeathTest, refuses_to_begin_empty) {
  EXPECT_DEATH(Battery(6, 4.5, 0.0), "charge=0");
}

}  // namespace
}  // namespace flyball
