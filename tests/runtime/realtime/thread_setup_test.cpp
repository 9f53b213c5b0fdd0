// SPDX-License-Identifier: BSD-3-Clause
#include "realtime/thread_setup.h"

#include "scratch_folder.h"
#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

void set_limits(const ScratchFolder& folder, const std::string& runtime_us) {
  (void)folder.file("sched_rt_runtime_us", runtime_us + "\n");
  (void)folder.file("sched_rt_period_us", "1000000\n");
}

TEST(RealTimeThrottle, says_how_long_a_core_stands_still_and_what_ends_it) {
  const ScratchFolder folder;
  set_limits(folder, "950000");
  EXPECT_EQ(real_time_throttle(folder.path()),
            "a core on which jobs with real-time priorities never rest stands still for 50 ms of "
            "every 1000 ms; sysctl kernel.sched_rt_runtime_us=-1 ends that");
}

TEST(RealTimeThrottle, says_nothing_where_the_kernel_withholds_nothing_or_has_no_such_limit) {
  const ScratchFolder folder;
  EXPECT_FALSE(real_time_throttle(folder.path()));
  set_limits(folder, "-1");
  EXPECT_FALSE(real_time_throttle(folder.path()));
  set_limits(folder, "1000000");
  EXPECT_FALSE(real_time_throttle(folder.path()));
}

}  // namespace
}  // namespace flyball
