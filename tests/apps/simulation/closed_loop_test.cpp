// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
#include "simulation/closed_loop.h"

#include "flyball/runtime/modeled/virtual_executor.h"

#include "short_delivery.h"
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

double number(const MemoryRecorder::Row& row, std::string_view name) {
  for (const auto& field : row.fields) {
    if (field.name == name) {
      return std::get<double>(field.value);
    }
  }
  ADD_FAILURE() << "no field " << name;
  return 0.0;
}

TEST(ClosedLoop, energy_is_the_integral_of_the_recorded_power) {
  const MissionRecord record = kit::flown(kit::short_delivery());
  double rotor_j = 0.0;
  double computer_j = 0.0;
  for (const auto& row : record.trace->rows()) {
    if (row.channel == "state") {
      rotor_j += 0.1 * number(row, "rotor_w");
      computer_j += 0.1 * number(row, "computer_w");
    }
  }
  // Rows stand 10 to the second, the sum is taken at 100: rotor power moves within a row.
  EXPECT_NEAR(rotor_j, record.summary.energy_rotor_j, 0.02 * rotor_j);
  EXPECT_NEAR(computer_j, record.summary.energy_computer_j, 0.03 * computer_j);
}

TEST(ClosedLoop, battery_loses_about_what_rotors_and_computer_took) {
  const Summary summary = kit::flown(kit::short_delivery()).summary;
  const double capacity_j = 22.2 * 4.5 * 3600.0;  // TB47D: nominal volts times rated charge.
  const double used_j =
      0.01 * (summary.battery_start_percent - summary.battery_end_percent) * capacity_j;
  // A full pack stands at 24.6 V, a tenth above nominal: fewer coulombs for the same joules.
  EXPECT_NEAR(used_j / summary.energy_total_j(), 22.2 / 24.2, 0.04);
}

TEST(ClosedLoop, flies_the_same_whenever_its_pictures_are_rendered) {
  MissionHooks hooks;
  std::size_t jobs = 0;
  hooks.job = [&](const NodeSpec& node, const JobRecord& job) {
    jobs += node.name.empty() || job.ended < job.started ? 0U : 1U;
  };
  const auto later = fly(kit::short_delivery(), hooks);
  EXPECT_GT(jobs, 100U);
  hooks.rendering = Rendering::at_once;
  const auto at_once = fly(kit::short_delivery(), hooks);
  ASSERT_TRUE(later && at_once);
  EXPECT_EQ(later->summary.trace_hash, at_once->summary.trace_hash);
}

TEST(ClosedLoop, publishes_a_depth_image_when_the_cameras_delay_has_passed) {
  Scenario scenario = kit::short_delivery();
  const auto first_release = [&scenario] {
    std::optional<MissionTime> released;
    MissionHooks hooks;
    hooks.job = [&released](const NodeSpec& node, const JobRecord& job) {
      released = released || node.name != "points" ? released : std::optional{job.released};
    };
    const auto record = fly(scenario, hooks);
    EXPECT_TRUE(record && record->summary.status == MissionStatus::succeeded);
    return released;
  };
  const Duration frame = from_seconds(1.0 / scenario.camera.rate_hz);
  EXPECT_EQ(first_release(), MissionTime{frame});
  scenario.camera.delay_s = 0.03;
  EXPECT_EQ(first_release(), MissionTime{frame + from_seconds(0.03)});
}

/// Flies with a listener on one topic of the vehicle.
template <class T, class Listen>
void fly_and_hear(const Scenario& scenario, const char* topic, const Listen& listen) {
  MissionHooks hooks;
  hooks.executor = [&](const Graph& graph, const Platform& platform, EventQueue& queue,
                       const OperatingPoint& start) {
    auto executor = std::make_unique<VirtualExecutor>(graph, platform, queue, start);
    executor->subscribe<T>(graph.find<T>(topic).value(), listen);
    return executor;
  };
  const auto record = fly(scenario, hooks);
  ASSERT_TRUE(record) << record.error().message;
}

TEST(ClosedLoop, brings_as_many_fixes_a_second_as_the_receiver_makes) {
  for (const double rate_hz : {0.5, 10.0, 30.0, 70.0, 100.0}) {
    Scenario scenario = kit::short_delivery();
    scenario.mission.time_limit_s = 4.0;
    scenario.gps.rate_hz = rate_hz;
    int fixes = 0;
    fly_and_hear<NavigationSample>(scenario, "navigation",
                                   [&](const NavigationSample& seen) { fixes += seen.has_fix; });
    EXPECT_NEAR(fixes, 4.0 * rate_hz, 1.0) << rate_hz;
  }
}

// The figure of `ImuSpec` is the square of 3.08 m/s^2, in hover; the tello's rotors turn 3.4 times
// as fast as the Matrice's in theirs.
TEST(ClosedLoop, shakes_every_airframe_as_was_measured_in_hover) {
  for (const char* airframe : {"matrice_100", "tello"}) {
    Scenario scenario = kit::short_delivery();
    scenario.vehicle.airframe = airframe;
    scenario.vehicle.payload_kg = airframe == std::string{"tello"} ? 0.02 : 0.5;
    scenario.kernels.localizer = "visual_inertial";
    scenario.camera.width_px = 32;
    scenario.camera.height_px = 18;
    scenario.mission.time_limit_s = 6.0;
    double sum_m2_s4 = 0.0;
    int samples = 0;
    fly_and_hear<ImuSample>(scenario, "imu", [&](const ImuSample& felt) {
      // With so few pixels it is lost in the climb, and stands by then to search for its place.
      const bool is_flying = felt.stamp > MissionTime{std::chrono::seconds{4}};
      sum_m2_s4 += is_flying ? felt.f_B.y() * felt.f_B.y() : 0.0;
      samples += is_flying ? 1 : 0;
    });
    ASSERT_GT(samples, 300);
    EXPECT_NEAR(std::sqrt(sum_m2_s4 / samples), 3.08, 0.5) << airframe;
  }
}

}  // namespace
}  // namespace flyball
