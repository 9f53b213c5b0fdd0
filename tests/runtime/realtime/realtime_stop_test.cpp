// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/realtime/realtime_executor.h"

#include "realtime_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(RealtimeStop, waits_for_jobs_that_run_and_tells_them) {
  RealtimeRig rig;
  std::atomic<bool> runs{};
  bool was_told{};
  const auto in = rig.add("long", 0, [&](JobContext& context) {
    runs = true;
    was_told = comes_true([&] { return context.should_stop(); });
  });
  rig.start();
  rig.executor->publish(in, 1);
  ASSERT_TRUE(rig.serve([&] { return runs.load(); }));
  rig.executor->publish(in, 2);
  rig.executor->stop();
  EXPECT_TRUE(was_told);
  rig.executor->serve_until(rig.executor->now() + 10s);  // Returns at once.
  ASSERT_EQ(rig.records.size(), 1U) << "the second one never began";
  EXPECT_TRUE(rig.records.front().killed);
  EXPECT_GE(rig.executor->busy_core_s(), 0.0);
}

TEST(RealtimeStop, a_job_that_runs_on_is_told_of_once_and_waited_for) {
  RealtimeRig rig;
  std::vector<std::string> told;
  std::atomic<bool> runs{};
  std::atomic<bool> may_end{};
  bool has_ended{};
  bool is_stopping{};  // Before, what the system does not permit may be told.
  rig.settings.tell_at_stop_after = 1ms;
  rig.settings.tell = [&](const std::string& sentence) {
    if (is_stopping) {
      told.push_back(sentence);
      may_end = true;
    }
  };
  const auto in = rig.add("stubborn", 0, [&](JobContext&) {
    runs = true;
    has_ended = comes_true([&] { return may_end.load(); });
  });
  rig.start();
  rig.executor->publish(in, 1);
  ASSERT_TRUE(rig.serve([&] { return runs.load(); }));
  is_stopping = true;
  rig.executor->stop();
  EXPECT_TRUE(has_ended);
  EXPECT_EQ(told,
            (std::vector<std::string>{"told to stop, jobs of these nodes still run: stubborn; "
                                      "the program ends when they return, or by SIGKILL"}));
}

TEST(RealtimeStop, what_waits_at_the_stop_is_read_by_a_last_job_if_asked_for) {
  RealtimeRig rig;
  std::vector<int> read;
  const auto in = rig.graph.topic<int>("in", 8);
  NodeSpec spec;
  spec.name = "record";
  spec.trigger = OnMessage{in.index};
  rig.graph.node(spec, [&](JobContext& job) {
    while (const auto value = job.take(in)) {
      read.push_back(*value);
    }
    return Work{};
  });
  rig.start();
  rig.executor->stop();
  rig.executor->publish(in, 1);
  rig.executor->publish(in, 2);
  EXPECT_TRUE(read.empty());
  rig.executor->run_last(0);
  EXPECT_EQ(read, (std::vector<int>{1, 2}));
  rig.executor->run_last(0);  // Nothing waits any more.
  EXPECT_EQ(read.size(), 2U);
}

}  // namespace
}  // namespace flyball
