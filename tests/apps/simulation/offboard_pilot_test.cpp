// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
#include "flyball/runtime/modeled/virtual_executor.h"
#include "flyball/simulation/realtime_flight.h"

#include "autopilot/offboard_rig.h"
#include "autopilot/udp_autopilot.h"
#include "short_delivery.h"
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr Duration part = 2ms;  // Of a flight: the step of the stand-in's physics.

struct FlownByAutopilot {
  kit::StandInAutopilot autopilot;
  std::string told{};
  AutopilotLink link;

  explicit FlownByAutopilot(const kit::StandInRules& rules)
      : autopilot{rules, kit::shipped_airframe()},
        link{std::make_unique<kit::MemoryStream>(autopilot),
             [this](const std::string& sentence) { told += sentence + "\n"; }} {}

  /// In virtual time: the autopilot moves on with the simulator's queue. `at` is called there, too.
  Result<MissionRecord> fly(const Scenario& scenario,
                            const std::function<void(MissionTime)>& at = {}) {
    MissionHooks hooks;
    hooks.autopilot = &link;
    hooks.executor = [this, at](const Graph& graph, const Platform& platform, EventQueue& queue,
                                const OperatingPoint& start) {
      queue.every(MissionTime{part}, part, EventOrder::physics, [this, at, &queue] {
        autopilot.step(part);
        if (at) {
          at(queue.now());
        }
      });
      return std::make_unique<VirtualExecutor>(graph, platform, queue, start);
    };
    return flyball::fly(scenario, hooks);
  }
};

TEST(OffboardPilot, a_delivery_is_flown_by_either_autopilot) {
  for (const AutopilotKind kind : {AutopilotKind::px4, AutopilotKind::ardupilot}) {
    FlownByAutopilot flown{kit::safe_rules(kind)};
    const auto record = flown.fly(kit::short_delivery());
    ASSERT_TRUE(record) << record.error().message;
    const Summary& summary = record->summary;
    EXPECT_EQ(summary.status, MissionStatus::succeeded) << to_string(summary.failure) << flown.told;
    EXPECT_GT(summary.distance_m, 30.0);  // 15 m there and back.
    EXPECT_GT(summary.energy_rotor_j, 0.0);
    EXPECT_FALSE(flown.autopilot.is_armed());
    EXPECT_LT(flown.autopilot.moved_m().head<2>().norm(), 1.0);  // Home again.
    EXPECT_EQ(flown.autopilot.bad_targets(), 0);
  }
}

TEST(OffboardPilot, a_flight_repeats_to_the_bit_in_virtual_time) {
  const auto hash = [] {
    FlownByAutopilot flown{kit::safe_rules(AutopilotKind::px4)};
    const auto record = flown.fly(kit::short_delivery());
    return record ? record->summary.trace_hash : record.error().message;
  };
  EXPECT_EQ(hash(), hash());
}

TEST(OffboardPilot, takes_about_the_energy_of_the_simulated_flight) {
  for (const char* model : {"regression", "thrust"}) {
    Scenario scenario = kit::short_delivery();
    scenario.vehicle.rotor_power = model;
    FlownByAutopilot flown{kit::safe_rules(AutopilotKind::px4)};
    const auto real = flown.fly(scenario);
    ASSERT_TRUE(real);
    const Summary simulated = kit::flown(scenario).summary;
    const auto power_w = [](const Summary& s) { return s.energy_rotor_j / s.mission_time_s; };
    // The autopilot's start and disarming take seconds in which its rotors rest or idle.
    EXPECT_NEAR(power_w(real->summary) / power_w(simulated), 1.0, 0.25) << model;
  }
}

TEST(OffboardPilot, a_flight_without_an_autopilot_that_answers_is_an_error) {
  kit::StandInRules rules;
  rules.deaf_to = mav::command_message_interval;
  FlownByAutopilot flown{rules};
  const auto record = flown.fly(kit::short_delivery());
  ASSERT_FALSE(record);
  EXPECT_NE(record.error().message.find("did not answer"), std::string::npos);
}

TEST(OffboardPilot, a_flight_ends_when_somebody_takes_over_and_says_so) {
  FlownByAutopilot flown{kit::safe_rules(AutopilotKind::px4)};
  const auto record = flown.fly(kit::short_delivery(60.0), [&flown](MissionTime now) {
    if (now == MissionTime{10s}) {
      flown.autopilot.switch_mode(kit::StandInAutopilot::px4_position);
    }
  });
  ASSERT_TRUE(record);
  EXPECT_EQ(record->summary.failure, MissionFailure::autopilot);
  EXPECT_NEAR(record->summary.mission_time_s, 10.5, 0.6);  // A heartbeat a second.
  EXPECT_NE(flown.told.find("somebody took over"), std::string::npos) << flown.told;
  EXPECT_TRUE(flown.autopilot.is_up());  // Nobody made it land.
}

TEST(OffboardPilot, a_jump_of_the_autopilots_estimate_does_not_throw_the_vehicle) {
  FlownByAutopilot flown{kit::safe_rules(AutopilotKind::px4)};
  double fastest_m_s = 0.0;
  const auto record = flown.fly(kit::short_delivery(60.0), [&](MissionTime now) {
    fastest_m_s = std::max(fastest_m_s, flown.autopilot.truth().v_WB.norm());
    if (now == MissionTime{10s}) {
      flown.autopilot.jump({4.0, -3.0, 1.0});
    }
  });
  ASSERT_TRUE(record);
  EXPECT_EQ(record->summary.status, MissionStatus::succeeded) << to_string(record->summary.failure);
  EXPECT_NE(flown.told.find("jumped by 5.1 m"), std::string::npos) << flown.told;
  EXPECT_LT(flown.autopilot.moved_m().head<2>().norm(), 1.0);  // Home, where it really began.
  EXPECT_LT(fastest_m_s, 1.1 * record->summary.max_speed_m_s);
}

/// By satellites only, and much worse than they are.
Scenario drifting_delivery() {
  Scenario scenario = kit::short_delivery(150.0);
  scenario.kernels.localizer = "gps";
  scenario.gps.wander_m = 3.0;
  scenario.gps.wander_time_s = 600.0;
  scenario.vehicle.tracking_error_m = 0.3;
  return scenario;
}

/// A flight controller goes by its own estimate, so a velocity that is added to its set-points does
/// not take the vehicle to where the localizer wants it: the set-points themselves have to be
/// there.
TEST(OffboardPilot, follows_a_localizer_that_drifts_from_the_autopilots_estimate) {
  for (const AutopilotKind kind : {AutopilotKind::px4, AutopilotKind::ardupilot}) {
    FlownByAutopilot flown{kit::safe_rules(kind)};
    const auto record = flown.fly(drifting_delivery());
    ASSERT_TRUE(record) << record.error().message;
    const Summary& summary = record->summary;
    // It is flown as asked, and ends where the localizer, not the world, has the goal.
    EXPECT_EQ(summary.failure, MissionFailure::misdelivered)
        << to_string(summary.failure) << flown.told;
    EXPECT_GT(summary.quality.at("localization_error_m_max"), 1.0);
    EXPECT_LT(summary.quality.at("off_path_m_p95"), 0.4);
  }
}

TEST(SimulatedPilot, follows_a_localizer_that_drifts_as_an_autopilot_does) {
  EXPECT_EQ(kit::flown(drifting_delivery()).summary.failure, MissionFailure::misdelivered);
}

/// Outside the declared error the reference waits for the vehicle.
TEST(OffboardPilot, flies_at_speed_with_the_tracking_error_that_its_autopilot_keeps) {
  kit::StandInRules rules = kit::safe_rules(AutopilotKind::px4);
  rules.swing_m = 0.4;
  const auto flown_with = [&rules](double tracking_error_m) {
    FlownByAutopilot flown{rules};
    Scenario scenario = kit::short_delivery(60.0);
    scenario.vehicle.tracking_error_m = tracking_error_m;
    const auto record = flown.fly(scenario);
    EXPECT_TRUE(record);
    return record->summary;
  };
  const Summary trusted = flown_with(0.02);
  const Summary declared = flown_with(0.3);
  EXPECT_GT(trusted.quality.at("off_path_m_p95"), 0.1);
  EXPECT_LT(declared.quality.at("off_path_m_p95"), 0.3);
  EXPECT_EQ(declared.status, MissionStatus::succeeded) << to_string(declared.failure);
  EXPECT_LT(declared.mission_time_s, 0.8 * trusted.mission_time_s);
}

TEST(OffboardPilot, rotor_power_is_what_the_autopilot_measures) {
  kit::StandInRules rules = kit::safe_rules(AutopilotKind::px4);
  rules.battery_a = 20.0F;  // 400 W with the computer.
  FlownByAutopilot flown{rules};
  const auto record = flown.fly(kit::short_delivery());
  ASSERT_TRUE(record);
  const Summary& summary = record->summary;
  EXPECT_NEAR(summary.energy_rotor_j + summary.energy_computer_j, 400.0 * summary.mission_time_s,
              20.0);
  EXPECT_NEAR(summary.quality.at("rotor_power_measured_percent"), 100.0, 1e-6);
  EXPECT_EQ(summary.quality.at("autopilot_battery_percent"), 83.0);
  const std::vector<double> seen_percent = kit::observed(*record, "battery_percent");
  ASSERT_FALSE(seen_percent.empty());
  EXPECT_EQ(seen_percent.back(), 83.0) << "policies see it, too";
}

TEST(OffboardPilot, a_vehicle_whose_positions_stop_coming_brakes) {
  FlownByAutopilot flown{kit::safe_rules(AutopilotKind::px4)};
  double fastest_m_s = 0.0;
  double later_m_s = 0.0;
  const auto record = flown.fly(kit::short_delivery(60.0), [&](MissionTime now) {
    const double speed_m_s = flown.autopilot.truth().v_WB.norm();
    if (now == MissionTime{10s}) {
      fastest_m_s = speed_m_s;
      flown.autopilot.rules().never_sends = MavLocalPosition::kind.id;
    } else if (now == MissionTime{16s}) {
      later_m_s = speed_m_s;
      flown.autopilot.rules().never_sends = kit::StandInRules{}.never_sends;
    }
  });
  ASSERT_TRUE(record);
  EXPECT_GT(fastest_m_s, 1.0);
  EXPECT_LT(later_m_s, 0.2);
  EXPECT_EQ(record->summary.status, MissionStatus::succeeded)
      << to_string(record->summary.failure) << flown.told;
}

TEST(OffboardPilot, a_vehicle_in_the_air_is_landed_when_the_mission_is_over) {
  FlownByAutopilot flown{kit::safe_rules(AutopilotKind::ardupilot)};
  Scenario scenario = kit::short_delivery(60.0);
  scenario.mission.time_limit_s = 10.0;
  const auto record = flown.fly(scenario);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->summary.failure, MissionFailure::time_limit);
  EXPECT_FALSE(flown.autopilot.is_armed());
  EXPECT_LT(flown.autopilot.moved_m().z(), 0.05);
}

TEST(OffboardPilot, flies_in_real_time_through_udp) {
  kit::UdpAutopilot autopilot{kit::safe_rules(AutopilotKind::px4)};
  auto stream = open_byte_stream(autopilot.address());
  ASSERT_TRUE(stream) << stream.error().message;
  std::string told;
  AutopilotLink link{std::move(*stream),
                     [&told](const std::string& sentence) { told += sentence + "\n"; },
                     [] { return Duration{std::chrono::steady_clock::now().time_since_epoch()}; }};
  // A small camera, so that maps are made in time on a slow machine under a sanitizer as well.
  Scenario scenario = kit::short_delivery();
  scenario.camera.width_px = 32;
  scenario.camera.height_px = 18;
  scenario.mission.time_limit_s = 9.0;
  MissionHooks hooks;
  hooks.autopilot = &link;
  hooks.executor = in_real_time({});
  const auto record = fly(scenario, hooks);
  ASSERT_TRUE(record) << record.error().message;
  EXPECT_NE(told.find("PX4 is connected"), std::string::npos) << told;
  const kit::StandInAutopilot& flown = autopilot.stop();
  EXPECT_GT(flown.targets().size(), 50U);
  EXPECT_EQ(flown.bad_targets(), 0);
  // A machine that is far too slow leaves the vehicle to its fail-safe, and says so.
  const bool was_left = record->summary.failure == MissionFailure::autopilot;
  EXPECT_TRUE(was_left || record->summary.failure == MissionFailure::time_limit) << told;
  EXPECT_TRUE(was_left || !flown.is_armed()) << told;
}

}  // namespace
}  // namespace flyball
