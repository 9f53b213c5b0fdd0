// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board/board_report.h"

#include "fake_kernel.h"
#include "fake_trees.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Without the line of the clock meter, which tells of the machine that the test runs on.
std::string report(const fake::Kernel& kernel, const BoardFile& board) {
  std::string text = board_report(kernel, discover_board(kernel), board);
  const std::size_t begin = text.find("clock meter");
  text.erase(begin, text.find('\n', begin) + 1 - begin);
  return text;
}

TEST(BoardReport, tells_of_a_tx2) {
  const fake::Tree tree;
  fake::plant_tx2_r32(tree);
  BoardFile board;
  board.name = "jetson_tx2";
  board.core_order = {0, 3, 4, 5};
  board.cores_if_asked = {1, 2};
  board.may_unplug_cores = true;
  board.ignored_zones = {"PMIC-Die"};
  EXPECT_EQ(report(fake::Kernel{tree.root()}, board),
            "board        jetson_tx2 (NVIDIA Jetson TX2 Developer Kit), Linux 4.9.253-tegra\n"
            "clock        cores 0, 3, 4, 5: 12 from 345.6 MHz to 2035.2 MHz (tegra_cpufreq, "
            "schedutil), may be set\n"
            "cores        0, 3, 4, 5 on-line; 1, 2 off-line; taken in the order 0, 3, 4, 5; a "
            "program of your own may ask for 1, 2 too; a program of your own may have idle ones "
            "switched off\n"
            "power        by VDD_IN\n"
            "rails        VDD_IN 3.954 W, VDD_SYS_CPU 0.836 W\n"
            "heat         MCPU-therm 43 C, takes clocks away from 95.5 C on\n");
}

TEST(BoardReport, names_the_file_that_may_not_be_written_and_the_way_out) {
  const fake::Tree tree;
  fake::plant_pi5(tree);
  fake::Kernel kernel{tree.root()};
  kernel.refused["scaling_max_freq"] = EACCES;
  const std::string text = report(kernel, {});
  EXPECT_NE(text.find("may not be set: /sys/devices/system/cpu/cpufreq/policy0/scaling_max_freq "
                      "cannot be written: Permission denied; run as root, or see: flyball board "
                      "setup --print\n"),
            std::string::npos)
      << text;
  EXPECT_NE(
      text.find("power        not measured: there is no input rail (VDD_IN, VIN) and no RAPL\n"),
      std::string::npos);
  EXPECT_NE(text.find("are never switched off on this board\n"), std::string::npos);
}

TEST(BoardReport, names_rivals_and_hidden_counters) {
  const fake::Tree tree;
  fake::plant_x86(tree);
  fake::Kernel kernel{tree.root()};
  kernel.unreadable["energy_uj"] = EACCES;
  const std::string text = report(kernel, {});
  EXPECT_NE(text.find("by both limits, because there is no governor \"userspace\""),
            std::string::npos);
  EXPECT_NE(text.find("rival        thermald (process 812)"), std::string::npos);
  EXPECT_NE(
      text.find("power        not measured: /sys/class/powercap/intel-rapl:0/energy_uj may not "
                "be read; run as root"),
      std::string::npos)
      << text;
}

TEST(BoardSetupScript, is_a_script_that_a_shell_can_read) {
  const ScratchFolder folder;
  const std::string script = folder.file("setup.sh", board_setup_script());
  // NOLINTNEXTLINE(cert-env33-c): the test's own words
  EXPECT_EQ(std::system(("sh -n '" + script + "'").c_str()), 0);
  for (const char* part :
       {"udev/rules.d/99-flyball.rules", "scaling_setspeed", "energy_uj", "d /run/flyball",
        "z /run/flyball/board.*", "rtprio", "perf_event_paranoid"}) {
    EXPECT_NE(board_setup_script().find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace flyball
