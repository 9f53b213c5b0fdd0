// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/vehicles/autopilot_link.h"

#include "autopilot/autopilot_in_memory.h"
#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

/// A line over which nothing can be sent any more, while nothing says so to who listens.
class CutLine final : public ByteStream {
 public:
  CutLine(kit::StandInAutopilot& autopilot, const bool& is_cut)
      : line_{autopilot}, is_cut_{is_cut} {}
  Status send(const std::vector<std::uint8_t>& bytes) override {
    return is_cut_ ? Status{Error{ErrorCode::unavailable, "the line is cut"}} : line_.send(bytes);
  }
  Status receive(std::vector<std::uint8_t>& bytes) override { return line_.receive(bytes); }
  Duration wait(Duration at_most) override { return line_.wait(at_most); }

 private:
  kit::MemoryStream line_;
  const bool& is_cut_;
};

struct LinkedAutopilot {
  explicit LinkedAutopilot(const kit::StandInRules& rules = {})
      : autopilot{rules, kit::shipped_airframe()} {}

  Status connect(const std::function<bool()>& stop = {}) {
    return link.connect({Vec3{1.0, 2.0, 0.1}, 0.0}, stop);
  }
  void fly(Duration by) {
    for (const MissionTime end = now + by; now < end; now += 10ms) {
      autopilot.step(10ms);
      link.step(now);
    }
  }

  kit::StandInAutopilot autopilot;
  std::string told{};
  bool is_cut{};
  AutopilotLink link{std::make_unique<CutLine>(autopilot, is_cut),
                     [this](const std::string& sentence) { told += sentence + "\n"; }};
  MissionTime now{};
};

TEST(AutopilotLink, connects_and_says_to_whom) {
  LinkedAutopilot one;
  ASSERT_TRUE(one.connect());
  EXPECT_EQ(one.told, "PX4 is connected\n");
  EXPECT_TRUE(one.link.motion().X_WB.translation().isApprox(Vec3{1.0, 2.0, 0.1}, 1e-4));
  EXPECT_TRUE(one.link.motion().is_fresh);
  EXPECT_FALSE(one.link.motion().rotors_turn);
}

TEST(AutopilotLink, a_refused_autopilot_is_an_error_with_its_sentence) {
  kit::StandInRules rules;
  rules.maker = 13;
  LinkedAutopilot one{rules};
  const Status connected = one.connect();
  ASSERT_FALSE(connected);
  EXPECT_NE(connected.error().message.find("MAV_AUTOPILOT 13"), std::string::npos);
}

TEST(AutopilotLink, stops_waiting_when_it_is_told_to) {
  LinkedAutopilot one;
  one.autopilot.be_silent(true);
  int asked = 0;
  EXPECT_FALSE(one.connect([&asked] { return ++asked > 10; }));
  EXPECT_EQ(asked, 11);
}

TEST(AutopilotLink, follows_set_points_that_are_stamped_in_mission_time) {
  kit::StandInRules rules;
  rules.unanswered_first = 3;  // The link is two seconds older than the mission.
  LinkedAutopilot one{rules};
  ASSERT_TRUE(one.connect());
  one.link.obey({FlightCommand::Kind::take_off, 2.0});
  one.fly(12s);
  ASSERT_TRUE(one.link.status().manoeuvre_done) << one.link.failure();
  EXPECT_TRUE(one.link.motion().rotors_turn);
  const Vec3 from_W = one.link.motion().X_WB.translation();
  for (int i = 0; i < 100; ++i) {
    Setpoint setpoint;
    setpoint.stamp = one.now;
    setpoint.p_WB = from_W + Vec3{0.02 * i, 0.0, 0.0};
    setpoint.v_WB = {1.0, 0.0, 0.0};
    one.link.follow(setpoint);
    one.fly(20ms);
  }
  EXPECT_NEAR(one.link.motion().X_WB.translation().x() - from_W.x(), 2.0, 0.2);
}

TEST(AutopilotLink, lands_a_vehicle_that_is_up_when_the_flight_ends) {
  LinkedAutopilot one;
  ASSERT_TRUE(one.connect());
  one.link.obey({FlightCommand::Kind::take_off, 2.0});
  one.fly(12s);
  int turns = 0;
  one.link.begin_landing();
  EXPECT_EQ(one.autopilot.commands().back().command, mav::command_land);
  one.link.await_landing([&turns] {
    ++turns;
    return true;
  });
  EXPECT_FALSE(one.autopilot.is_armed());
  EXPECT_LT(one.autopilot.moved_m().z(), 0.05);
  EXPECT_GT(turns, 100);
  EXPECT_NE(one.told.find("lands before the program ends"), std::string::npos);
}

TEST(AutopilotLink, waits_for_nothing_when_the_vehicle_stands_or_somebody_took_over) {
  LinkedAutopilot one;
  ASSERT_TRUE(one.connect());
  one.link.begin_landing();
  one.link.await_landing({});
  EXPECT_EQ(one.told, "PX4 is connected\n");
  one.link.obey({FlightCommand::Kind::take_off, 2.0});
  one.fly(12s);
  one.autopilot.switch_mode(kit::StandInAutopilot::px4_position);
  one.fly(2s);
  const std::size_t asked = one.autopilot.commands().size();
  one.link.begin_landing();
  one.link.await_landing({});
  EXPECT_EQ(one.autopilot.commands().size(), asked);
  EXPECT_NE(one.told.find("somebody took over"), std::string::npos) << one.told;
}

TEST(AutopilotLink, says_once_that_its_line_is_gone_until_it_is_back) {
  LinkedAutopilot one;
  ASSERT_TRUE(one.connect());
  const std::string connected = one.told;
  one.is_cut = true;
  one.fly(5s);
  EXPECT_EQ(one.told, connected + "the line is cut\n");
  one.is_cut = false;
  one.fly(2s);
  one.is_cut = true;
  one.fly(2s);
  EXPECT_EQ(one.told, connected + "the line is cut\nthe line is cut\n");
}

TEST(AutopilotLink, gives_up_on_a_landing_that_is_always_denied) {
  kit::StandInRules rules;
  rules.denies_landing = true;
  LinkedAutopilot one{rules};
  ASSERT_TRUE(one.connect());
  one.link.obey({FlightCommand::Kind::take_off, 2.0});
  one.fly(12s);
  one.link.begin_landing();
  one.link.await_landing({});
  EXPECT_NE(one.told.find("has not landed within two minutes"), std::string::npos);
  EXPECT_TRUE(one.autopilot.is_up());  // Held until then.
}

}  // namespace
}  // namespace flyball
