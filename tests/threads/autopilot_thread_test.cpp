// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/vehicles/autopilot_link.h"

#include "autopilot/autopilot_in_memory.h"
#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

/// A link with a thread of its own. Time passes where `fly` and `be_busy` let it, in steps of 10
/// ms.
struct ThreadedLink {
  explicit ThreadedLink(const kit::StandInRules& rules = {}) : paced{rules} {}
  ~ThreadedLink() { paced.run_freely(true); }
  ThreadedLink(const ThreadedLink&) = delete;
  ThreadedLink& operator=(const ThreadedLink&) = delete;

  bool connect() {
    const bool is_there = link.connect({Vec3{1.0, 2.0, 0.1}, 0.0}, {}).ok();
    paced.run_freely(false);
    begun = paced.now();
    return is_there;
  }
  [[nodiscard]] MissionTime now() const { return MissionTime{paced.now() - begun}; }
  void be_busy(Duration by) { paced.let_pass(by); }
  bool fly(Duration at_most, const std::function<bool()>& done = {}) {
    for (const MissionTime end = now() + at_most; now() < end;) {
      paced.let_pass(10ms);
      link.step(now());
      if (done && done()) {
        return true;
      }
    }
    return false;
  }
  bool take_off() {
    link.obey({FlightCommand::Kind::take_off, 2.0});
    return fly(20s, [this] { return link.status().manoeuvre_done; });
  }

  kit::PacedAutopilot paced;
  std::string told{};
  Duration begun{};
  AutopilotLink link{std::make_unique<kit::PacedAutopilot::Stream>(paced),
                     [this](const std::string& sentence) { told += sentence + "\n"; },
                     [this] { return paced.now(); }};
};

TEST(AutopilotThread, streams_set_points_while_its_caller_is_busy) {
  ThreadedLink one;
  ASSERT_TRUE(one.connect());
  ASSERT_TRUE(one.take_off()) << one.told;
  Setpoint setpoint;
  setpoint.stamp = one.now();
  setpoint.p_WB = one.link.motion().X_WB.translation();
  setpoint.v_WB = {1.0, 0.0, 0.0};
  one.link.follow(setpoint);
  const std::size_t before = one.paced.autopilot.targets().size();
  one.be_busy(400ms);
  const auto& targets = one.paced.autopilot.targets();
  ASSERT_EQ(targets.size() - before, 20U);  // 50 Hz.
  // Each is the flight's last one, moved on; x of the mission is east.
  EXPECT_NEAR(targets.back().p_m[1] - targets[before].p_m[1], 0.38, 1e-3);
}

TEST(AutopilotThread, a_set_point_is_as_old_as_the_mission_says_though_a_step_came_late) {
  ThreadedLink one;
  ASSERT_TRUE(one.connect());
  const MissionTime late{one.now() + 10ms};  // The mission begins, and is told 300 ms later.
  one.be_busy(310ms);
  one.link.step(late);
  ASSERT_TRUE(one.take_off()) << one.told;
  Setpoint setpoint;
  setpoint.stamp = one.now() - 200ms;
  setpoint.p_WB = one.link.motion().X_WB.translation();
  setpoint.v_WB = {1.0, 0.0, 0.0};
  one.link.follow(setpoint);
  one.be_busy(20ms);
  const double start_east_m = kit::StandInRules{}.local_start_N.y() - 1.0;  // W's x there is 1.
  EXPECT_NEAR(static_cast<double>(one.paced.autopilot.targets().back().p_m[1]) - start_east_m,
              setpoint.p_WB.x() + 0.22, 0.011);
}

TEST(AutopilotThread, lands_the_vehicle_of_a_flight_that_hangs) {
  ThreadedLink one;
  ASSERT_TRUE(one.connect());
  ASSERT_TRUE(one.take_off()) << one.told;
  one.be_busy(4900ms);
  EXPECT_NE(one.paced.autopilot.commands().back().command, mav::command_land);
  one.be_busy(200ms);
  EXPECT_EQ(one.paced.autopilot.commands().back().command, mav::command_land);
  one.be_busy(20s);
  EXPECT_FALSE(one.paced.autopilot.is_armed());
  one.link.step(one.now());
  EXPECT_NE(one.link.failure().find("not moved on for 5 s"), std::string::npos);
  EXPECT_NE(one.told.find("not moved on for 5 s"), std::string::npos) << one.told;
}

TEST(AutopilotThread, lands_by_its_own_thread_when_the_flight_ends) {
  ThreadedLink one;
  ASSERT_TRUE(one.connect());
  ASSERT_TRUE(one.take_off()) << one.told;
  one.link.begin_landing();
  one.paced.run_freely(true);
  one.link.await_landing({});
  EXPECT_FALSE(one.paced.autopilot.is_armed());
  const int beats = one.paced.autopilot.heartbeats();
  one.paced.autopilot.step(3s);
  EXPECT_EQ(one.paced.autopilot.heartbeats(), beats);  // Flyball has fallen silent.
}

}  // namespace
}  // namespace flyball
