// SPDX-License-Identifier: BSD-3-Clause
//
// What happens to a job that is late on the modeled computer.

#include "computer_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Deadline, a_late_job_is_told_of_once_at_its_deadline_and_still_ends) {
  for (const OnMiss on_miss : {OnMiss::warn, OnMiss::brake}) {
    ComputerRig rig;
    const int a = rig.add({100.0, 0, "serial", 1, 30.0, on_miss});
    rig.start(1);
    std::vector<double> missed_ms;
    rig.computer->on_miss([&](int node, OnMiss what) {
      EXPECT_EQ(node, a);
      EXPECT_EQ(what, on_miss);
      missed_ms.push_back(ms(rig.queue.now()));
    });
    rig.trigger(a, 10.0);
    rig.run();
    EXPECT_EQ(missed_ms, (std::vector<double>{40.0}));
    EXPECT_TRUE(rig.of(a).missed);
    EXPECT_FALSE(rig.of(a).killed);
    EXPECT_EQ(rig.of(a).ended, at_ms(110.0));
  }
}

TEST(Deadline, a_job_that_ends_exactly_at_its_deadline_is_in_time) {
  ComputerRig rig;
  const int a = rig.add({30.0, 0, "serial", 1, 30.0, OnMiss::skip});
  rig.start(1);
  rig.trigger(a, 10.0);
  rig.run();
  EXPECT_FALSE(rig.of(a).missed || rig.of(a).killed);
}

TEST(Deadline, a_skipped_job_leaves_nothing_and_frees_its_core) {
  ComputerRig rig;
  const int late = rig.add({100.0, 1, "serial", 1, 30.0, OnMiss::skip});
  const int other = rig.add({20.0, 0});
  rig.start(1);
  int heard = 0;
  rig.computer->subscribe<int>(rig.outputs[0], [&](const int&) { ++heard; });
  rig.trigger(late, 0.0);
  rig.trigger(other, 0.0);
  rig.run();
  EXPECT_EQ(heard, 0);
  EXPECT_TRUE(rig.of(late).killed && rig.of(late).missed);
  EXPECT_EQ(rig.of(late).ended, at_ms(30.0));
  EXPECT_EQ(rig.of(late).busy, at_ms(30.0).time_since_epoch());
  EXPECT_EQ(rig.end_ms(other), 50.0);
}

TEST(Deadline, a_job_that_is_told_to_stop_works_on_until_its_body_would_ask) {
  ComputerRig rig;
  RigJob slow{100.0, 1, "serial", 1, 30.0, OnMiss::skip};
  slow.stop_latency_ms = 5.0;
  const int late = rig.add(slow);
  slow.time_ms = 33.0;  // Told to stop at 30, it ends by itself before it asks.
  slow.priority = 0;
  const int nearly = rig.add(slow);
  const int other = rig.add({20.0, -1});
  rig.start(1);
  int heard = 0;
  rig.computer->subscribe<int>(rig.outputs[0], [&](const int&) { ++heard; });
  rig.computer->subscribe<int>(rig.outputs[1], [&](const int&) { ++heard; });
  rig.trigger(late, 0.0);
  rig.trigger(nearly, 100.0);
  rig.trigger(other, 0.0);
  rig.run();
  EXPECT_EQ(heard, 0);
  EXPECT_TRUE(rig.of(late).killed && rig.of(late).missed);
  EXPECT_EQ(rig.of(late).ended, at_ms(35.0));
  EXPECT_EQ(rig.end_ms(other), 55.0);
  EXPECT_TRUE(rig.of(nearly).killed);
  EXPECT_EQ(rig.of(nearly).ended, at_ms(133.0));
}

TEST(Deadline, a_job_skipped_before_it_got_a_core_never_computes) {
  ComputerRig rig;
  const int low = rig.add({10.0, 0, "serial", 1, 30.0, OnMiss::skip});
  const int high = rig.add({100.0, 1});
  rig.start(1);
  rig.trigger(high, 0.0, 1);
  rig.trigger(low, 0.0, 2);
  rig.trigger(low, 90.0, 3);
  rig.run();
  EXPECT_EQ(rig.taken, (std::vector<int>{1, 3}));
  EXPECT_TRUE(rig.of(low).killed);
  EXPECT_EQ(rig.of(low).started, rig.of(low).ended);
  EXPECT_EQ(rig.records.back().released, at_ms(90.0));
  EXPECT_FALSE(rig.records.back().killed);
}

TEST(Deadline, counts_from_the_message_that_had_to_wait_for_its_node) {
  ComputerRig rig;
  const int a = rig.add({100.0, 0, "serial", 1, 150.0});
  rig.start(1);
  std::vector<double> missed_ms;
  rig.computer->on_miss([&](int, OnMiss) { missed_ms.push_back(ms(rig.queue.now())); });
  rig.trigger(a, 0.0);
  rig.trigger(a, 20.0);  // released then, started at 100 ms, ended at 200 ms
  rig.run();
  EXPECT_EQ(missed_ms, (std::vector<double>{170.0}));
  EXPECT_FALSE(rig.records[0].missed);
  EXPECT_TRUE(rig.records[1].missed);
}

TEST(Deadline, that_passed_while_the_node_was_busy_is_told_when_the_job_is_released) {
  ComputerRig rig;
  const int a = rig.add({100.0, 0, "serial", 1, 60.0});
  rig.start(1);
  std::vector<double> missed_ms;
  rig.computer->on_miss([&](int, OnMiss) { missed_ms.push_back(ms(rig.queue.now())); });
  rig.trigger(a, 0.0);
  rig.trigger(a, 10.0);  // due at 70 ms, but its job is not there before 100 ms
  rig.run();
  EXPECT_EQ(missed_ms, (std::vector<double>{60.0, 100.0}));
  EXPECT_EQ(rig.records[1].ended, at_ms(200.0));
}

}  // namespace
}  // namespace flyball
