// SPDX-License-Identifier: BSD-3-Clause
#include "board/core_control.h"

#include "fake_kernel.h"
#include "fake_trees.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Lines = std::vector<std::string>;
using Numbers = std::vector<int>;

class CoreControlTest : public testing::Test {
 protected:
  CoreControlTest() {
    fake::plant_tx2_r32(tree_);
    keeper_ = std::move(*SettingsKeeper::open(kernel_, {tree_.root() + "/run", false}));
  }
  CoreControl control(const Numbers& order, bool unplugs) {
    return {kernel_, *keeper_, discover_board(kernel_).cores, order, unplugs};
  }

  fake::Tree tree_{};
  fake::Kernel kernel_{tree_.root()};
  std::unique_ptr<SettingsKeeper> keeper_{};
  static constexpr Duration second = std::chrono::seconds{1};
};

TEST_F(CoreControlTest, binds_threads_and_switches_nothing) {
  CoreControl cores = control({0, 3, 4, 5}, false);
  EXPECT_EQ(cores.max_cores(), 4);
  EXPECT_TRUE(cores.attach(0).ok());
  EXPECT_TRUE(cores.plug_in(2).empty());
  EXPECT_TRUE(cores.bind().empty());
  EXPECT_TRUE(cores.unplug_rest({}).empty());
  EXPECT_EQ(kernel_.affinities, (std::vector<Numbers>{{0, 3, 4, 5}, {0, 3}}));
  EXPECT_TRUE(kernel_.writes.empty());
}

TEST_F(CoreControlTest, leaves_out_cores_that_are_off_line) {
  EXPECT_EQ(control({0, 3, 4, 5, 1, 2}, false).max_cores(), 4);
  EXPECT_EQ(control({0, 3, 4, 5, 1, 2}, true).max_cores(), 6);
}

TEST_F(CoreControlTest, switches_cores_when_asked_at_most_once_a_second) {
  CoreControl cores = control({0, 3, 4, 5}, true);
  EXPECT_TRUE(cores.plug_in(2).empty());
  EXPECT_TRUE(cores.unplug_rest({}).empty());
  EXPECT_EQ(kernel_.writes, (Lines{"cpu5/online=0", "cpu4/online=0"}));
  EXPECT_TRUE(cores.plug_in(3).empty());
  EXPECT_EQ(kernel_.writes.back(), "cpu4/online=1");
  EXPECT_EQ(cores.active(), (Numbers{0, 3, 4}));
  EXPECT_TRUE(cores.plug_in(2).empty());
  EXPECT_TRUE(cores.unplug_rest(second / 2).empty());
  EXPECT_EQ(kernel_.writes.size(), 3U);
  EXPECT_TRUE(cores.unplug_rest(second).empty());
  EXPECT_EQ(kernel_.writes.size(), 4U);
}

TEST_F(CoreControlTest, says_that_a_core_stays_and_does_not_ask_again) {
  kernel_.staying_cores = {5};
  CoreControl cores = control({0, 3, 4, 5}, true);
  EXPECT_TRUE(cores.plug_in(3).empty());
  const std::vector<Error> errors = cores.unplug_rest({});
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].message, "core 5 stays on-line; it is left idle by affinity instead");
  EXPECT_TRUE(cores.unplug_rest(2 * second).empty());
  EXPECT_EQ(kernel_.writes.size(), 1U);
}

TEST_F(CoreControlTest, goes_on_without_a_core_that_does_not_come) {
  kernel_.refused["cpu1/online"] = EIO;
  CoreControl cores = control({0, 3, 1, 2}, true);
  const std::vector<Error> errors = cores.plug_in(3);
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].message,
            "core 1 does not come on-line (\"1\" cannot be written to /sys/devices/system/cpu/cpu1/"
            "online: Input/output error); the others do its work");
  EXPECT_EQ(cores.active(), (Numbers{0, 3, 2}));
}

TEST_F(CoreControlTest, forgets_threads_that_have_ended) {
  CoreControl cores = control({0, 3}, false);
  EXPECT_TRUE(cores.attach(7).ok());
  kernel_.refused_affinity = ESRCH;
  EXPECT_TRUE(cores.bind().empty());
  kernel_.refused_affinity = EPERM;
  EXPECT_TRUE(cores.bind().empty());
  EXPECT_FALSE(cores.attach(8).ok());
  EXPECT_EQ(cores.bind().size(), 1U);
}

TEST_F(CoreControlTest, takes_the_order_of_the_boards_file) {
  const std::vector<BoardCore> cores = discover_board(kernel_).cores;
  BoardFile board;
  EXPECT_EQ(core_order_of(cores, board, true), (Numbers{0, 1, 2, 3, 4, 5}));
  board.core_order = {0, 3, 4, 5, 9};
  board.cores_if_asked = {1, 2};
  EXPECT_EQ(core_order_of(cores, board, false), (Numbers{0, 3, 4, 5}));
  EXPECT_EQ(core_order_of(cores, board, true), (Numbers{0, 3, 4, 5, 1, 2}));
}

}  // namespace
}  // namespace flyball
