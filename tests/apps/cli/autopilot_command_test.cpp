// SPDX-License-Identifier: BSD-3-Clause
// test-label: closed_loop
// compiled-alone

#include "autopilot/pgm_bytes.h"
#include "autopilot/udp_autopilot.h"
#include "flyball_program.h"
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

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

/// The program beside the test, which can end it.
class ProgramBeside {
 public:
  explicit ProgramBeside(const std::string& arguments) {
    const std::string line = "cd '" + place.path() + "' && { '" + FlyballProgram::binary() + "' " +
                             arguments +
                             " > out 2> err & echo $! > pid; wait $!; echo $? > code; } &";
    EXPECT_EQ(std::system(line.c_str()), 0);  // NOLINT(cert-env33-c): the test's own words
  }
  /// Waits until `happened`, or the program has ended.
  void await(const std::function<bool()>& happened) const {
    while (!happened() && place.content("code").empty()) {
      std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }
  }
  void terminate() const { send(SIGTERM); }
  void send(int signal) const { ::kill(std::stoi(place.content("pid")), signal); }
  [[nodiscard]] std::string exit_code() const {
    await([] { return false; });
    return place.content("code");
  }
  ScratchFolder place;
};

TEST(AutopilotCommand, lands_the_vehicle_when_it_is_interrupted) {
  kit::UdpAutopilot autopilot{kit::StandInRules{}};
  const ProgramBeside program{flight + " --autopilot " + autopilot.address()};
  program.await([&autopilot] { return autopilot.is_up(); });
  program.terminate();
  EXPECT_EQ(program.exit_code(), "143\n");
  const std::string said = program.place.content("err");
  const kit::StandInAutopilot& flown = autopilot.stop();
  EXPECT_FALSE(flown.is_armed()) << said;
  EXPECT_FALSE(flown.is_up()) << said;
  EXPECT_NE(said.find("PX4 is connected"), std::string::npos) << said;
  EXPECT_NE(said.find("lands before the program ends"), std::string::npos) << said;
  EXPECT_NE(program.place.content("flight/summary.json").find("interrupted"), std::string::npos);
}

/// A terminal that closes and its shell each say so, within milliseconds.
TEST(AutopilotCommand, a_signal_that_comes_twice_at_once_lands_the_vehicle_too) {
  std::signal(SIGHUP, SIG_DFL);  // Who runs the tests by `nohup` has it ignored, by children, too.
  kit::UdpAutopilot autopilot{kit::StandInRules{}};
  const ProgramBeside program{flight + " --autopilot " + autopilot.address()};
  program.await([&autopilot] { return autopilot.is_up(); });
  program.send(SIGHUP);
  program.send(SIGCONT);  // So that the two are not one.
  std::this_thread::sleep_for(std::chrono::milliseconds{2});
  program.send(SIGHUP);
  EXPECT_EQ(program.exit_code(), "129\n");
  EXPECT_FALSE(autopilot.stop().is_armed()) << program.place.content("err");
  EXPECT_NE(program.place.content("flight/summary.json").find("interrupted"), std::string::npos);
}

/// Writes images of open space into a pipe for as long as somebody reads them.
class CameraBeside {
 public:
  explicit CameraBeside(const std::string& pipe) : pipe_{pipe} {
    EXPECT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    std::signal(SIGPIPE, SIG_IGN);  // The program may end first.
    thread_ = std::thread{[this] { run(); }};
  }
  ~CameraBeside() {
    is_ending_ = true;
    thread_.join();
  }
  CameraBeside(const CameraBeside&) = delete;
  CameraBeside& operator=(const CameraBeside&) = delete;

 private:
  void run() const {
    const std::string image =
        kit::pgm_bytes(32, 18, std::vector<std::uint16_t>(std::size_t{32} * 18, 65535));
    int pipe = -1;
    while (!is_ending_) {
      std::this_thread::sleep_for(std::chrono::milliseconds{50});
      pipe = pipe < 0 ? open(pipe_.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC) : pipe;
      if (pipe >= 0 && write(pipe, image.data(), image.size()) < 0) {
        break;
      }
    }
    close(pipe);
  }

  std::string pipe_;
  std::atomic<bool> is_ending_{false};
  std::thread thread_{};
};

TEST(AutopilotCommand, flies_by_the_images_of_a_pipe) {
  kit::UdpAutopilot autopilot{kit::StandInRules{}};
  const ScratchFolder folder;
  const CameraBeside camera{folder.path("depth")};
  const ProgramBeside program{flight + " --autopilot " + autopilot.address() + " --depth-camera '" +
                              folder.path("depth") + "'"};
  program.await([&autopilot] { return autopilot.is_up(); });
  program.terminate();
  EXPECT_EQ(program.exit_code(), "143\n") << program.place.content("err");
  EXPECT_FALSE(autopilot.stop().is_armed()) << program.place.content("err");
}

TEST(AutopilotCommand, refuses_a_depth_camera_that_cannot_be) {
  const FlyballProgram flyball;
  const auto no_pipe = flyball.run(flight + " --depth-camera - < /dev/null");
  EXPECT_EQ(no_pipe.exit_code, 2);
  EXPECT_NE(no_pipe.errors.find("standard input is no pipe"), std::string::npos) << no_pipe.errors;
  EXPECT_TRUE(flyball.place.is_empty());
  const ScratchFolder folder;
  ASSERT_EQ(mkfifo(folder.path("depth").c_str(), 0600), 0);
  const auto simulated = flyball.run(flight + " --depth-camera '" + folder.path("depth") + "'");
  EXPECT_EQ(simulated.exit_code, 2);
  EXPECT_NE(simulated.errors.find("add --autopilot"), std::string::npos) << simulated.errors;
  EXPECT_TRUE(flyball.place.is_empty());
}

/// Its thread may not be there yet when the process is forked that restores the computer's clocks.
TEST(AutopilotCommand, opens_the_depth_camera_after_the_computer) {
  const FlyballProgram flyball;
  const auto refused = flyball.run(
      "run delivery_forest --executor virtual --set-clocks --depth-camera - < /dev/null");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("--set-clocks is of no use"), std::string::npos) << refused.errors;
}

TEST(AutopilotCommand, leaves_nothing_behind_when_it_is_interrupted_before_the_flight) {
  kit::StandInRules rules;
  rules.never_sends = MavLocalPosition::kind.id;
  kit::UdpAutopilot autopilot{rules};
  const ProgramBeside program{flight + " --autopilot " + autopilot.address()};
  program.await([&autopilot] { return autopilot.is_greeted(); });
  program.terminate();
  EXPECT_EQ(program.exit_code(), "143\n") << program.place.content("err");
  EXPECT_FALSE(std::filesystem::exists(program.place.path("flight")));
}

}  // namespace
}  // namespace flyball
