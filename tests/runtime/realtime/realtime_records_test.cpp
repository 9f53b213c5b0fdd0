// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/realtime/cpu_time.h"

#include "realtime_rig.h"
#include <array>

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

namespace flyball {
namespace {

TEST(RealtimeRecords, counts_what_other_threads_did_for_a_job_as_the_jobs_own) {
  RealtimeRig rig;
  const Topic<int> in = rig.add("helped", 1, [first = true](JobContext&) mutable {
    add_helpers_time(first ? 100s : 0s);
    first = false;
  });
  rig.start();
  for (std::size_t jobs = 1; jobs <= 2; ++jobs) {
    rig.executor->publish(in, 1);
    ASSERT_TRUE(rig.serve([&] { return rig.records.size() == jobs; }));
  }
  EXPECT_GE(rig.records[0].busy, 100s);
  EXPECT_LT(rig.records[1].busy, 100s);
}

TEST(RealtimeRecords, counts_each_job_that_ends_behind_its_deadline_as_missed) {
  RealtimeRig rig;
  NodeSpec spec;
  spec.deadline = 300us;
  spec.on_miss = OnMiss::brake;
  std::size_t told = 0;
  const auto in = rig.add(
      "close", 0,
      [&](JobContext&) {
        // Ends so near to the deadline that the clock's thread is often late.
        const auto end = std::chrono::steady_clock::now() + 290us;
        while (std::chrono::steady_clock::now() < end) {
        }
      },
      spec);
  rig.start();
  rig.executor->on_miss([&](int, OnMiss) { ++told; });
  for (std::size_t jobs = 1; jobs <= 200; ++jobs) {
    rig.executor->publish(in, 1);
    ASSERT_TRUE(rig.serve([&] { return rig.records.size() == jobs; }));
  }
  rig.executor->stop();
  std::size_t missed = 0;
  for (const JobRecord& record : rig.records) {
    missed += record.missed ? 1 : 0;
    EXPECT_EQ(record.missed, record.ended - record.released > spec.deadline);
  }
  EXPECT_EQ(told, missed);
}

TEST(RealtimeRecords, tells_at_its_stop_what_ended_before) {
  RealtimeRig rig;
  std::atomic<int> ended{};
  const auto in = rig.add(
      "last", 0, [&](JobContext& context) { context.at_end([&](MissionTime) { ++ended; }); });
  rig.start();
  rig.executor->serve_until(MissionTime{1ms});
  rig.executor->publish(in, 1);
  ASSERT_TRUE(comes_true([&] { return ended == 1; }));
  rig.executor->stop();
  EXPECT_EQ(rig.records.size(), 1U);
}

int own_priority() {
  int policy{};
  sched_param granted{};
  pthread_getschedparam(pthread_self(), &policy, &granted);
  return policy == SCHED_FIFO ? granted.sched_priority : 0;
}

TEST(RealtimeRecords, gives_no_thread_a_lower_priority_than_a_less_urgent_one) {
  RealtimeRig rig;
  rig.settings.fifo_priority = 97;  // With three lanes and the clock it would end at 100.
  std::array<int, 3> granted{};
  std::vector<Topic<int>> in;
  for (std::size_t i = 0; i < granted.size(); ++i) {
    in.push_back(rig.add("node" + std::to_string(i), static_cast<int>(i),
                         [&, i](JobContext&) { granted[i] = own_priority(); }));
  }
  rig.start();
  for (const Topic<int>& topic : in) {
    rig.executor->publish(topic, 1);
  }
  ASSERT_TRUE(rig.serve([&] { return rig.records.size() == granted.size(); }));
  if (granted[0] > 0) {
    EXPECT_EQ(granted[1], granted[0] + 1);
    EXPECT_EQ(granted[2], granted[0] + 2);
    EXPECT_LE(granted[2], 98);
  } else {
    EXPECT_EQ(granted, (std::array<int, 3>{}));
  }
}

}  // namespace
}  // namespace flyball
