// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "flyball/runtime/board/linux_board.h"

#include "fake_kernel.h"
#include "fake_trees.h"
#include "killed_session.h"
#include <ctime>
#include <utility>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Lines = std::vector<std::string>;
using Numbers = std::vector<int>;
using Plant = void (*)(const fake::Tree&);

constexpr Duration second = std::chrono::seconds{1};
const std::string policy0 = "/sys/devices/system/cpu/cpufreq/policy0/";

class LinuxBoardTest : public testing::Test {
 protected:
  LinuxBoardTest() {
    options_.keeper.run_folder = tree_.root() + "/run";
    options_.measure_clock = [this] { return measured_; };
  }
  LinuxBoard& open(Plant plant) {
    plant(tree_);
    auto opened = LinuxBoard::open(kernel_, options_);
    EXPECT_TRUE(opened.ok()) << opened.error().message;
    board_ = std::move(*opened);
    return *board_;
  }
  void as_tx2() {
    options_.file.core_order = {0, 3, 4, 5};
    options_.file.cores_if_asked = {1, 2};
    options_.file.may_unplug_cores = true;
    options_.file.ignored_zones = {"PMIC-Die"};
  }

  fake::Tree tree_{};
  fake::Kernel kernel_{tree_.root()};
  LinuxBoardOptions options_{};
  std::optional<Hertz> measured_{};
  std::unique_ptr<LinuxBoard> board_{};
};

TEST_F(LinuxBoardTest, governs_a_tx2_and_leaves_it_as_it_was) {
  as_tx2();
  LinuxBoard& board = open(fake::plant_tx2_r32);
  const auto before = tree_.all();
  EXPECT_EQ(board.model().max_cores, 4);
  EXPECT_EQ(board.model().frequencies.size(), 12U);
  board.request({3, Hertz{1574.4e6}});
  board.refresh(second);
  EXPECT_EQ(board.read().granted, (OperatingPoint{3, Hertz{1574.4e6}}));
  EXPECT_EQ(board.active_cpus(), (Numbers{0, 3, 4}));
  EXPECT_NEAR(board.read().computer_power.value(), 19.008 * 0.208, 1e-9);
  EXPECT_DOUBLE_EQ(board.read().temperature_c, 43.0);
  EXPECT_DOUBLE_EQ(board.read().trip_c, 95.5);
  EXPECT_TRUE(board.notes().empty()) << board.notes().front();
  EXPECT_TRUE(board.close().empty());
  auto after = tree_.all();
  after[policy0 + "scaling_cur_freq"] = before.at(policy0 + "scaling_cur_freq");  // a reading
  EXPECT_EQ(after, before);
}

TEST_F(LinuxBoardTest, switches_cores_on_before_clocks_and_off_after_them) {
  as_tx2();
  options_.use_cores_if_asked = true;
  options_.unplug_cores = true;
  LinuxBoard& board = open(fake::plant_tx2_r32);
  board.request({6, Hertz{2035.2e6}});
  board.request({1, Hertz{345.6e6}});
  EXPECT_EQ(
      kernel_.writes,
      (Lines{"cpu1/online=1", "cpu2/online=1", "policy0/scaling_governor=userspace",
             "policy0/scaling_setspeed=2035200", "policy0/scaling_setspeed=345600", "cpu2/online=0",
             "cpu1/online=0", "cpu5/online=0", "cpu4/online=0", "cpu3/online=0"}));
}

TEST_F(LinuxBoardTest, sets_all_clusters_of_an_orin) {
  LinuxBoard& board = open(fake::plant_orin);
  board.request({8, Hertz{1190.4e6}});
  EXPECT_EQ(kernel_.writes,
            (Lines{"policy0/scaling_governor=userspace", "policy0/scaling_setspeed=1190400",
                   "policy4/scaling_governor=userspace", "policy4/scaling_setspeed=1190400"}));
  ASSERT_EQ(board.notes().size(), 1U);
  EXPECT_EQ(board.notes()[0],
            "nvpmodel (process 301) sets clocks too; wait until it has ended; its mode stays a "
            "limit");
}

TEST_F(LinuxBoardTest, says_who_else_sets_the_clocks_of_a_pc) {
  LinuxBoard& board = open(fake::plant_x86);
  EXPECT_EQ(board.notes(),
            (Lines{"power-profiles-daemon (process 640) sets clocks too; stop it: systemctl stop "
                   "power-profiles-daemon",
                   "thermald (process 812) sets clocks too; stop it: systemctl stop thermald"}));
  EXPECT_EQ(board.power_source(), "psys");
}

TEST_F(LinuxBoardTest, sets_the_clock_again_where_somebody_else_has_changed_it) {
  LinuxBoard& board = open(fake::plant_pi5);
  board.request({4, Hertz{2000e6}});
  tree_.put(policy0 + "scaling_governor", "powersave\n");
  fake::put_process(tree_, 99, "tuned");
  board.refresh(second);
  EXPECT_EQ(tree_.get(policy0 + "scaling_governor"), "userspace\n");
  const std::size_t count = board.notes().size();
  ASSERT_GE(count, 2U);
  EXPECT_EQ(board.notes()[count - 2],
            "somebody else has changed the limits or the governor of the clock; it is set again");
  EXPECT_EQ(board.notes()[count - 1],
            "tuned (process 99) sets clocks too; stop it: systemctl stop tuned");
}

TEST_F(LinuxBoardTest, believes_the_measured_clock_where_the_driver_lies) {
  LinuxBoard& board = open(fake::plant_pi5);
  kernel_.lies["scaling_cur_freq"] = "2400000\n";
  measured_ = Hertz{1503e6};
  board.request({4, Hertz{2400e6}});
  board.refresh(second);
  EXPECT_EQ(board.clock().requested, Hertz{2400e6});
  EXPECT_EQ(board.clock().reported, Hertz{2400e6});
  EXPECT_EQ(board.clock().measured, Hertz{1500e6});
  EXPECT_EQ(board.read().granted.frequency, Hertz{1500e6});
  const Lines& notes = board.notes();
  ASSERT_EQ(notes.size(), 3U);  // the first: no power meter
  EXPECT_EQ(notes[1],
            "scaling_cur_freq says 2400 MHz and the cores run at 1500 MHz; the measured clock is "
            "believed");
  board.refresh(2 * second);
  EXPECT_EQ(board.notes().size(), 3U);  // each once
}

// The simulator's thread is bound to a spare core: on a TX2 to one of the Denver cores.
TEST_F(LinuxBoardTest, believes_no_clock_that_was_measured_on_a_core_of_another_kind) {
  as_tx2();
  LinuxBoard& board = open(fake::plant_tx2_r32);
  board.request({4, Hertz{1420.8e6}});
  measured_ = Hertz{2035.2e6};
  kernel_.current_core = 2;
  board.refresh(second);
  EXPECT_FALSE(board.clock().measured);
  EXPECT_EQ(board.read().granted.frequency, Hertz{1420.8e6});
  EXPECT_TRUE(board.notes().empty()) << board.notes().front();
  kernel_.current_core = 5;
  board.refresh(2 * second);
  EXPECT_EQ(board.read().granted.frequency, Hertz{2035.2e6});
}

TEST_F(LinuxBoardTest, believes_no_clock_that_only_one_of_two_clusters_can_have) {
  fake::plant_orin(tree_);
  const std::string policy4 = "/sys/devices/system/cpu/cpufreq/policy4/";
  tree_.put(policy4 + "scaling_max_freq", "1497600\n");
  LinuxBoard& board = open([](const fake::Tree&) {});
  board.request({8, Hertz{1984e6}});
  measured_ = Hertz{1497.6e6};
  kernel_.current_core = 7;
  board.refresh(second);
  EXPECT_EQ(board.read().granted.frequency, Hertz{1984e6});
  board.request({8, Hertz{1190.4e6}});
  measured_ = Hertz{729.6e6};
  board.refresh(2 * second);
  EXPECT_EQ(board.read().granted.frequency, Hertz{729.6e6});
}

TEST_F(LinuxBoardTest, says_that_less_is_granted) {
  as_tx2();
  kernel_.cap_khz = 1420800;
  LinuxBoard& board = open(fake::plant_tx2_r32);
  board.request({4, Hertz{2035.2e6}});
  board.refresh(second);
  EXPECT_EQ(board.read().granted.frequency, Hertz{1420.8e6});
  EXPECT_EQ(board.notes(),
            (Lines{"the board grants 1420.8 MHz where 2035.2 MHz are requested: heat, "
                   "the power mode or the firmware limits it"}));
}

TEST_F(LinuxBoardTest, measures_on_and_writes_nothing_while_heat_limits_the_clock) {
  as_tx2();
  LinuxBoard& board = open(fake::plant_tx2_r32);
  kernel_.cooled_khz = 1420800;
  board.request({4, Hertz{2035.2e6}});
  measured_ = Hertz{1420.8e6};
  board.refresh(second);
  const Lines writes = kernel_.writes;
  measured_.reset();  // A counter of cycles has nothing new while the program rests.
  board.refresh(2 * second);
  EXPECT_EQ(kernel_.writes, writes);
  EXPECT_EQ(board.clock().measured, Hertz{1420.8e6});
}

TEST_F(LinuxBoardTest, sets_the_clock_of_a_cluster_when_it_has_come_back) {
  LinuxBoard& board = open(fake::plant_orin);
  const auto plug = [this](const char* is_on) {
    for (const char* core : {"4", "5", "6", "7"}) {
      tree_.put("/sys/devices/system/cpu/cpu" + std::string{core} + "/online", is_on);
    }
  };
  plug("0\n");
  board.request({8, Hertz{1190.4e6}});
  board.refresh(second);
  EXPECT_EQ(kernel_.writes,
            (Lines{"policy0/scaling_governor=userspace", "policy0/scaling_setspeed=1190400"}));
  plug("1\n");
  board.refresh(2 * second);
  EXPECT_EQ(kernel_.writes.back(), "policy4/scaling_setspeed=1190400");
  EXPECT_EQ(board.notes().size(), 2U) << "of nvpmodel, and that cores were switched";
}

TEST_F(LinuxBoardTest, keeps_the_clock_that_there_is_where_files_are_read_only) {
  as_tx2();
  kernel_.refused["scaling_governor"] = EACCES;
  LinuxBoard& board = open(fake::plant_tx2_r32);
  board.request({2, Hertz{345.6e6}});
  board.refresh(second);
  board.request({2, Hertz{499.2e6}});
  EXPECT_EQ(board.notes(),
            (Lines{"\"userspace\" cannot be written to " + policy0 +
                   "scaling_governor: Permission denied; the clock stays as it is; run as root, or "
                   "let a group write it: flyball board setup --print"}));
  EXPECT_EQ(board.read().granted, (OperatingPoint{2, Hertz{2035.2e6}}));
  EXPECT_TRUE(board.model().frequencies.empty());  // not a knob any more
}

TEST_F(LinuxBoardTest, estimates_the_power_where_there_is_no_rail) {
  PowerCost prior;
  prior.board_w = 2.5;
  options_.power_prior = prior;
  LinuxBoard& board = open(fake::plant_pi5);
  board.refresh(second);
  EXPECT_EQ(board.power_source(), "estimate");
  EXPECT_EQ(board.read().computer_power, Watts{2.5});
  EXPECT_EQ(board.notes(),
            (Lines{"the board's power is not measured: it has no input rail (VDD_IN, "
                   "VIN) and no RAPL; it is estimated from clock and work"}));
}

TEST_F(LinuxBoardTest, says_that_energy_counters_are_hidden) {
  kernel_.unreadable["energy_uj"] = EACCES;
  LinuxBoard& board = open(fake::plant_x86);
  EXPECT_EQ(board.power_source(), "none");
  EXPECT_EQ(board.notes().back(),
            "the board's power is not measured: RAPL's counters may not be read; run as root, or "
            "see: flyball board setup --print; it is 0 W in all records");
}

TEST_F(LinuxBoardTest, keeps_cores_on_line_where_the_file_says_so) {
  options_.unplug_cores = true;
  options_.file.name = "raspberry_pi_5";
  LinuxBoard& board = open(fake::plant_pi5);
  board.request({1, Hertz{1500e6}});
  EXPECT_EQ(tree_.get("/sys/devices/system/cpu/cpu3/online"), "1\n");
  EXPECT_EQ(board.active_cpus(), (Numbers{0}));
  EXPECT_EQ(board.notes().back(),
            "cores stay on-line: the file of board raspberry_pi_5 does not allow to switch them "
            "off");
}

TEST_F(LinuxBoardTest, opens_where_no_clock_can_be_set) {
  measured_ = Hertz{2.9e9};
  LinuxBoard& board = open([](const fake::Tree& tree) { fake::put_cores(tree, 2); });
  EXPECT_EQ(board.model().max_cores, 2);
  EXPECT_TRUE(board.model().frequencies.empty());
  board.request({1, Hertz{1e9}});
  board.refresh(second);
  EXPECT_EQ(board.read().granted, (OperatingPoint{1, Hertz{2.9e9}}));
  EXPECT_EQ(board.notes().front(),
            "no clock can be set: there is no cpufreq folder with limits below /sys/devices/system/"
            "cpu (a virtual machine, or a kernel without a driver for this processor); cores are "
            "the only knob");
}

TEST_F(LinuxBoardTest, sets_no_clock_that_nothing_could_restore) {
  options_.keeper.run_folder = tree_.root() + "/no/folder";
  LinuxBoard& board = open(fake::plant_orin);
  EXPECT_TRUE(board.model().frequencies.empty());
  board.request({2, Hertz{1190.4e6}});
  board.refresh(second);
  EXPECT_EQ(board.read().granted, (OperatingPoint{2, Hertz{1984e6}}));
  EXPECT_NEAR(board.read().computer_power.value(), 5.032 * 1.2, 1e-9);
  EXPECT_TRUE(board.close().empty());
  EXPECT_TRUE(kernel_.writes.empty());
  ASSERT_FALSE(board.notes().empty());
  EXPECT_EQ(board.notes()[0],
            "the clock stays as it is, because nothing could restore it: the folder " +
                options_.keeper.run_folder +
                " for the board's lock and journal cannot be made: No such file or directory; run "
                "as root, or see: flyball board setup --print");
}

TEST_F(LinuxBoardTest, refuses_clocks_that_are_locked_unless_it_adopts_them) {
  fake::plant_tx2_r32(tree_);
  tree_.put(policy0 + "scaling_min_freq", "2035200\n");
  const auto refused = LinuxBoard::open(kernel_, options_);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message,
            "the clock of /sys/devices/system/cpu/cpufreq/policy0 is locked at 2035.2 MHz already, "
            "which jetson_clocks does; release it (jetson_clocks --restore)");
  options_.keeper.adopt = true;
  auto adopted = LinuxBoard::open(kernel_, options_);
  ASSERT_TRUE(adopted.ok());
  (*adopted)->request({1, Hertz{345.6e6}});
  EXPECT_TRUE((*adopted)->close().empty());
  EXPECT_EQ(tree_.get(policy0 + "scaling_min_freq"), "2035200\n");
}

TEST_F(LinuxBoardTest, offers_an_adopted_boards_own_clocks) {
  fake::plant_x86(tree_);
  fake::run_apart(options_.keeper.run_folder, [&] {
    auto keeper = SettingsKeeper::open(kernel_, options_.keeper);
    (void)(*keeper)->write(policy0 + "scaling_min_freq", "400000");
    (void)(*keeper)->write(policy0 + "scaling_max_freq", "400000");
    kill((*keeper)->watchdog(), SIGKILL);
    kill(getpid(), SIGKILL);
  });
  options_.keeper.adopt = true;
  auto adopted = LinuxBoard::open(kernel_, options_);
  ASSERT_TRUE(adopted.ok()) << adopted.error().message;
  EXPECT_EQ((*adopted)->model().frequencies.back(), Hertz{4200e6});
}

// Cycles are counted from one look to the next, so the first look behind a change is about before.
TEST_F(LinuxBoardTest, does_not_take_the_clock_before_a_change_for_the_one_after_it) {
  as_tx2();
  Hertz mean{2035.2e6};
  options_.measure_clock = [&mean] { return std::optional{std::exchange(mean, Hertz{345.6e6})}; };
  LinuxBoard& board = open(fake::plant_tx2_r32);
  mean = Hertz{2035.2e6};
  board.request({4, Hertz{345.6e6}});
  board.refresh(second);
  EXPECT_EQ(board.read().granted.frequency, Hertz{345.6e6});
}

TEST_F(LinuxBoardTest, estimates_the_power_of_all_work_since_the_last_look) {
  PowerCost prior;
  prior.board_w = 1.0;
  prior.core_linear_w = 2.0;
  options_.power_prior = prior;
  LinuxBoard& board = open(fake::plant_pi5);
  board.refresh(second);
  const std::clock_t begin = std::clock();
  while (std::clock() - begin < CLOCKS_PER_SEC / 50) {
  }
  board.request({4, Hertz{2000e6}});  // Which changes nothing about what was done before it.
  board.refresh(second + second / 50);
  EXPECT_GE(board.read().computer_power.value(),
            prior.power(board.read().granted.frequency, 0.9).value());
}

TEST_F(LinuxBoardTest, notices_cores_that_somebody_else_switches) {
  as_tx2();
  LinuxBoard& board = open(fake::plant_tx2_r32);
  const std::string core4 = "/sys/devices/system/cpu/cpu4/online";
  tree_.put(core4, "0\n");
  board.refresh(second);
  EXPECT_EQ(board.active_cpus(), (Numbers{0, 3, 5}));
  EXPECT_EQ(board.read().granted.cores, 3);
  EXPECT_EQ(board.notes(), (Lines{"somebody else has switched cores off or on"}));
  board.request({4, Hertz{2035.2e6}});
  EXPECT_EQ(board.read().granted.cores, 3);
  EXPECT_EQ(tree_.get(core4), "0\n") << "it is not ours to switch it on";
  tree_.put(core4, "1\n");
  board.refresh(2 * second);
  EXPECT_EQ(board.active_cpus(), (Numbers{0, 3, 4, 5}));
}

TEST_F(LinuxBoardTest, sets_the_clock_later_where_a_file_could_not_be_written_for_a_moment) {
  as_tx2();
  LinuxBoard& board = open(fake::plant_tx2_r32);
  board.request({4, Hertz{1574.4e6}});
  kernel_.refused["scaling_setspeed"] = EACCES;
  board.request({4, Hertz{345.6e6}});
  EXPECT_EQ(board.read().granted.frequency, Hertz{1574.4e6});
  EXPECT_EQ(board.notes(), (Lines{"\"345600\" cannot be written to " + policy0 +
                                  "scaling_setspeed: Permission denied; it is tried again"}));
  kernel_.refused.clear();
  board.refresh(second);
  EXPECT_EQ(board.read().granted.frequency, Hertz{345.6e6});
  EXPECT_FALSE(board.model().frequencies.empty());
  EXPECT_EQ(board.notes().size(), 1U);
}

}  // namespace
}  // namespace flyball
