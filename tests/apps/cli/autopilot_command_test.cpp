// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
// compiled-alone

#include "autopilot/udp_autopilot.h"
#include "flyball_program.h"
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// A delivery that goes on for as long as anybody lets it, with a camera that any machine can draw.
const std::string flight =
    "run delivery_forest --executor realtime --set camera.width_px=32 --set camera.height_px=18 "
    "--out flight";

TEST(AutopilotCommand, refuses_an_autopilot_for_a_modeled_computer) {
  const FlyballProgram flyball;
  const auto refused = flyball.run("run delivery_forest --autopilot udp:127.0.0.1:14540");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.errors, "flyball: --autopilot flies in real time; add --executor realtime\n");
  EXPECT_TRUE(flyball.place.is_empty());
}

TEST(AutopilotCommand, refuses_addresses_that_cannot_be_and_says_what_can) {
  const FlyballProgram flyball;
  for (const auto& [address, sentence] :
       {std::pair{"udp:192.168.1.7:14540", "MAVLink router"},
        std::pair{"tcp:127.0.0.1:5760", "is no address of an autopilot"},
        std::pair{"serial:/dev/ttyACM0:12345", "is no speed of a serial line"}}) {
    const auto refused = flyball.run(flight + " --autopilot " + address);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.errors.find(sentence), std::string::npos) << refused.errors;
    EXPECT_EQ(std::count(refused.errors.begin(), refused.errors.end(), '\n'), 1);
    EXPECT_TRUE(flyball.place.is_empty());
  }
}

TEST(AutopilotCommand, leaves_nothing_behind_when_the_autopilot_cannot_be_flown) {
  kit::StandInRules rules;
  rules.type = 1;  // An aeroplane.
  const kit::UdpAutopilot autopilot{rules};
  const FlyballProgram flyball;
  const auto refused =
      flyball.run(flight + " --mcap flight.mcap --autopilot " + autopilot.address());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("flies no multirotor"), std::string::npos) << refused.errors;
  EXPECT_EQ(refused.output, "");
  EXPECT_TRUE(flyball.place.is_empty());
}

TEST(AutopilotCommand, lands_the_vehicle_when_it_is_interrupted) {
  kit::UdpAutopilot autopilot{kit::StandInRules{}};
  const ScratchFolder place;
  // By then it is up, on a machine that is not very slow; on any other one there is less to land.
  const std::string line = "cd '" + place.path() + "' && timeout --preserve-status -s INT 12 '" +
                           FlyballProgram::binary() + "' " + flight + " --autopilot " +
                           autopilot.address() + " > out 2> err";
  const int status = std::system(line.c_str());  // NOLINT(cert-env33-c): the test's own words
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130) << place.content("err");
  const kit::StandInAutopilot& flown = autopilot.stop();
  EXPECT_FALSE(flown.is_armed()) << place.content("err");
  EXPECT_FALSE(flown.is_up());
  EXPECT_NE(place.content("err").find("PX4 is connected"), std::string::npos)
      << place.content("err");
}

}  // namespace
}  // namespace flyball
