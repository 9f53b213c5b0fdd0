// SPDX-License-Identifier: BSD-3-Clause
//
// Closed forms of who runs when on the modeled computer.

#include "computer_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(JobScheduling, a_job_alone_takes_its_time) {
  ComputerRig rig;
  const int a = rig.add({100.0});
  rig.start(1);
  rig.trigger(a, 7.0);
  rig.run();
  ASSERT_EQ(rig.records.size(), 1U);
  EXPECT_EQ(rig.of(a).released, at_ms(7.0));
  EXPECT_EQ(rig.of(a).started, at_ms(7.0));
  EXPECT_EQ(rig.of(a).ended, at_ms(107.0));
  EXPECT_EQ(rig.of(a).busy, at_ms(100.0).time_since_epoch());
  EXPECT_FALSE(rig.of(a).killed || rig.of(a).missed);
}

TEST(JobScheduling, equal_priorities_share_one_core_equally) {
  ComputerRig rig;
  const int a = rig.add({100.0});
  const int b = rig.add({30.0});
  rig.start(1);
  rig.trigger(a, 0.0);
  rig.trigger(b, 0.0);
  rig.run();
  // b has half a core until 60 ms; a then has 70 ms left alone
  EXPECT_NEAR(rig.end_ms(b), 60.0, end_tolerance_ms);
  EXPECT_NEAR(rig.end_ms(a), 130.0, end_tolerance_ms);
  EXPECT_NEAR(ms(rig.of(b).busy), 30.0, 1e-6);
}

TEST(JobScheduling, a_preempted_job_resumes_where_it_was) {
  ComputerRig rig;
  const int low = rig.add({100.0, 0});
  const int high = rig.add({40.0, 1});
  rig.start(1);
  rig.trigger(low, 0.0);
  rig.trigger(high, 30.0);
  rig.run();
  EXPECT_NEAR(rig.end_ms(high), 70.0, end_tolerance_ms);
  EXPECT_NEAR(rig.end_ms(low), 140.0, end_tolerance_ms);
  EXPECT_EQ(rig.of(low).started, at_ms(0.0));
  EXPECT_NEAR(ms(rig.of(low).busy), 100.0, 1e-6);
}

TEST(JobScheduling, a_less_urgent_job_does_not_compute_before_it_has_a_core) {
  ComputerRig rig;
  const int low = rig.add({10.0, 0});
  const int high = rig.add({40.0, 1});
  rig.start(1);
  rig.trigger(low, 0.0, 1);  // first in the queue, and yet not first to run
  rig.trigger(high, 0.0, 2);
  rig.run();
  EXPECT_EQ(rig.taken, (std::vector<int>{2, 1}));
  EXPECT_EQ(rig.of(low).started, at_ms(40.0));
  EXPECT_EQ(rig.of(low).released, at_ms(0.0));
}

TEST(JobScheduling, equally_urgent_jobs_compute_in_the_order_of_their_release) {
  ComputerRig rig;
  const int a = rig.add({10.0});
  const int b = rig.add({10.0});
  rig.start(2);
  rig.trigger(b, 0.0, 2);
  rig.trigger(a, 0.0, 1);
  rig.run();
  EXPECT_EQ(rig.taken, (std::vector<int>{2, 1}));
}

TEST(JobScheduling, three_equal_jobs_on_two_cores_get_two_thirds_each) {
  ComputerRig rig;
  std::vector<int> jobs{rig.add({60.0}), rig.add({60.0}), rig.add({60.0})};
  rig.start(2);
  for (const int job : jobs) {
    rig.trigger(job, 0.0);
  }
  rig.run();
  for (const int job : jobs) {
    EXPECT_NEAR(rig.end_ms(job), 90.0, end_tolerance_ms);
  }
  EXPECT_NEAR(rig.computer->busy_core_s(), 0.180, 1e-9);
}

TEST(JobScheduling, a_threaded_job_and_another_never_use_a_core_twice) {
  ComputerRig rig;
  const int wide = rig.add({100.0, 0, "amdahl", 4});
  const int narrow = rig.add({30.0, 0});
  rig.start(4);
  rig.trigger(wide, 0.0);
  rig.trigger(narrow, 0.0);
  double both = 0.0;
  rig.queue.schedule(at_ms(1.0), EventOrder::observer, [&] { both = rig.computer->busy_cores(); });
  rig.run();
  // narrow takes one core, wide three: S(3) = 1 / (.2 + .8 / 3); then four: S(4) = 1 / (.2 + .8 /
  // 4)
  const double s3 = 1.0 / (0.2 + 0.8 / 3.0);
  const double s4 = 1.0 / (0.2 + 0.8 / 4.0);
  EXPECT_NEAR(both, 4.0, 1e-12);
  EXPECT_NEAR(rig.end_ms(narrow), 30.0, end_tolerance_ms);
  EXPECT_NEAR(rig.end_ms(wide), 30.0 + (100.0 - 30.0 * s3) / s4, end_tolerance_ms);
}

TEST(JobScheduling, the_busiest_core_works_whenever_anything_runs) {
  ComputerRig rig;
  const int a = rig.add({60.0});
  const int b = rig.add({20.0});
  rig.start(2);
  rig.trigger(a, 0.0);
  rig.trigger(b, 10.0);
  rig.trigger(b, 100.0);
  double half_way_s = 0.0;
  rig.queue.schedule(at_ms(30.0), EventOrder::observer,
                     [&] { half_way_s = rig.computer->busiest_core_s(); });
  rig.run();
  EXPECT_NEAR(half_way_s, 0.030, 1e-9);
  EXPECT_NEAR(rig.computer->busiest_core_s(), 0.080, 1e-9);
  EXPECT_NEAR(rig.computer->busy_core_s(), 0.100, 1e-9);
}

TEST(JobScheduling, threads_of_a_serial_kernel_leave_the_other_cores_free) {
  ComputerRig rig;
  const int serial = rig.add({50.0, 1, "serial", 4});
  const int other = rig.add({50.0, 0});
  rig.start(2);
  rig.trigger(serial, 0.0);
  rig.trigger(other, 0.0);
  rig.run();
  EXPECT_NEAR(rig.end_ms(serial), 50.0, end_tolerance_ms);
  EXPECT_NEAR(rig.end_ms(other), 50.0, end_tolerance_ms);
  EXPECT_NEAR(rig.computer->busy_core_s(), 0.1, 1e-9);
}

/// Searches that race: 20 ms alone, then four times 40 ms side by side.
RigJob race(int priority = 0) {
  RigJob job{180.0, priority, "race", 4};
  job.shared_ms = 160.0;
  return job;
}

TEST(JobScheduling, a_race_takes_the_time_of_one_search_where_each_has_a_core) {
  for (const int cores : {1, 2, 4}) {
    ComputerRig rig;
    const int job = rig.add(race());
    rig.start(cores);
    rig.trigger(job, 0.0);
    rig.run();
    EXPECT_NEAR(rig.end_ms(job), 20.0 + 160.0 / cores, end_tolerance_ms) << cores;
    EXPECT_EQ(rig.of(job).work.count("ms"), 180.0);
  }
}

TEST(JobScheduling, a_job_that_fewer_threads_shared_leaves_the_other_cores_free) {
  ComputerRig rig;
  RigJob by_two = race(1);
  by_two.fewer_threads = 2;
  const int job = rig.add(by_two);
  const int other = rig.add(race(0));
  rig.start(4);
  rig.trigger(job, 0.0);
  rig.trigger(other, 0.0);
  rig.run();
  EXPECT_NEAR(rig.end_ms(job), 20.0 + 160.0 / 2.0, end_tolerance_ms);
  // On two cores, and on all four as soon as the first job is over.
  const double on_two = 1.0 / (1.0 / 9.0 + 8.0 / 9.0 / 2.0);
  const double on_four = 1.0 / (1.0 / 9.0 + 8.0 / 9.0 / 4.0);
  EXPECT_NEAR(rig.end_ms(other), 100.0 + (180.0 - 100.0 * on_two) / on_four, end_tolerance_ms);
}

TEST(JobScheduling, a_race_goes_on_with_the_cores_that_others_leave_idle) {
  ComputerRig rig;
  const int other = rig.add({50.0, 1});
  const int job = rig.add(race());
  rig.start(2);
  rig.trigger(other, 0.0);
  rig.trigger(job, 0.0);
  rig.run();
  // Alone on one core for 50 ms of 180; then twice as fast as Amdahl lets 1/9 of it be serial.
  const double s2 = 1.0 / (1.0 / 9.0 + 8.0 / 9.0 / 2.0);
  EXPECT_NEAR(rig.end_ms(other), 50.0, end_tolerance_ms);
  EXPECT_NEAR(rig.end_ms(job), 50.0 + 130.0 / s2, end_tolerance_ms);
}

TEST(JobScheduling, a_race_takes_no_core_from_a_less_urgent_job) {
  ComputerRig rig;
  const int job = rig.add(race(1));
  const int other = rig.add({50.0, 0});
  rig.start(2);
  rig.trigger(job, 0.0);
  rig.trigger(other, 10.0);
  rig.run();
  EXPECT_EQ(rig.of(other).started, at_ms(10.0));
  EXPECT_NEAR(rig.end_ms(other), 60.0, end_tolerance_ms);
}

TEST(JobScheduling, a_job_of_several_threads_that_shares_nothing_leaves_the_other_cores_free) {
  ComputerRig rig;
  RigJob straight{50.0, 1, "race", 4};
  straight.shared_ms = 0.0;
  const int job = rig.add(straight);
  const int other = rig.add({50.0, 0});
  rig.start(2);
  rig.trigger(job, 0.0);
  rig.trigger(other, 0.0);
  rig.run();
  EXPECT_NEAR(rig.end_ms(job), 50.0, end_tolerance_ms);
  EXPECT_EQ(rig.of(other).started, at_ms(0.0));
  EXPECT_NEAR(rig.end_ms(other), 50.0, end_tolerance_ms);
  EXPECT_NEAR(rig.computer->busy_core_s(), 0.1, 1e-9);
}

TEST(JobScheduling, a_faster_clock_half_way_speeds_up_the_rest) {
  ComputerRig rig;
  const int a = rig.add({100.0});
  const int b = rig.add({100.0, 0, "memory"});
  rig.start(2);
  rig.trigger(a, 0.0);
  rig.trigger(b, 0.0);
  rig.set_point(50.0, 2, 2.0);
  rig.run();
  EXPECT_NEAR(rig.end_ms(a), 75.0, end_tolerance_ms);
  EXPECT_NEAR(rig.end_ms(b), 50.0 + 50.0 * 0.75, end_tolerance_ms);  // .5 / 2 + .5
}

TEST(JobScheduling, cores_taken_away_half_way_are_shared) {
  ComputerRig rig;
  const int a = rig.add({100.0});
  const int b = rig.add({100.0});
  rig.start(2);
  rig.trigger(a, 0.0);
  rig.trigger(b, 0.0);
  rig.set_point(40.0, 1, 1.0);
  rig.run();
  EXPECT_NEAR(rig.end_ms(a), 160.0, end_tolerance_ms);
  EXPECT_NEAR(rig.end_ms(b), 160.0, end_tolerance_ms);
  EXPECT_NEAR(rig.computer->busy_core_s(), 0.2, 1e-9);
}

TEST(JobScheduling, jobs_stand_still_while_the_clock_switches) {
  ComputerRig rig{3.0};
  const int a = rig.add({100.0});
  const int b = rig.add({10.0});
  rig.start(1);
  rig.trigger(a, 0.0);
  rig.set_point(50.0, 1, 2.0);
  rig.trigger(b, 51.0);  // released in the gap: it computes behind it
  rig.run();
  EXPECT_EQ(rig.of(b).started, at_ms(53.0));
  EXPECT_NEAR(rig.end_ms(b), 63.0, end_tolerance_ms);  // 5 ms at half a core
  EXPECT_NEAR(rig.end_ms(a), 83.0, end_tolerance_ms);  // 25 ms, 5 ms of which shared
  EXPECT_NEAR(rig.computer->busy_core_s(), 0.080, 1e-9);
}

TEST(JobScheduling, a_change_of_cores_alone_costs_no_switching_time) {
  ComputerRig rig{3.0};
  const int a = rig.add({100.0});
  rig.start(1);
  rig.trigger(a, 0.0);
  rig.set_point(50.0, 4, 1.0);
  rig.run();
  EXPECT_EQ(rig.of(a).ended, at_ms(100.0));
}

TEST(JobScheduling, many_interruptions_do_not_let_a_job_end_early) {
  ComputerRig rig;
  const int low = rig.add({1000.0, 0});
  const int high = rig.add({0.01 / 3.0, 1});
  rig.start(1);
  rig.trigger(low, 0.0);
  for (int i = 0; i < 9000; ++i) {
    rig.trigger(high, 0.1 * i + 0.05);
  }
  rig.run();
  double interrupted_ms = 0.0;
  for (const JobRecord& record : rig.records) {
    interrupted_ms += record.node == high ? ms(record.ended - record.started) : 0.0;
  }
  EXPECT_EQ(rig.records.size(), 9001U);
  EXPECT_NEAR(rig.end_ms(low), 1000.0 + interrupted_ms, end_tolerance_ms);
}

TEST(JobScheduling, busy_core_time_integrates_what_was_granted) {
  ComputerRig rig;
  const int a = rig.add({100.0});
  const int b = rig.add({60.0});
  rig.start(2);
  rig.trigger(a, 0.0);
  rig.trigger(b, 20.0);
  std::vector<double> busy_s;
  std::vector<double> busy_cores;
  for (const double when : {10.0, 50.0, 90.0, 200.0}) {
    rig.queue.schedule(at_ms(when), EventOrder::observer, [&] {
      busy_s.push_back(rig.computer->busy_core_s());
      busy_cores.push_back(rig.computer->busy_cores());
    });
  }
  rig.run();
  EXPECT_EQ(busy_cores, (std::vector<double>{1.0, 2.0, 1.0, 0.0}));
  const std::vector<double> expected{0.010, 0.080, 0.150, 0.160};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(busy_s[i], expected[i], 1e-9);
  }
}

TEST(JobScheduling, the_same_graph_and_events_give_the_same_records) {
  const auto fly = [] {
    ComputerRig rig{0.3};
    for (int i = 0; i < 6; ++i) {
      rig.add({7.3 + 3.1 * i, i % 3, i % 2 == 0 ? "amdahl" : "memory", 1 + i % 3, 40.0,
               i == 4 ? OnMiss::skip : OnMiss::warn, 1 + static_cast<std::size_t>(i % 2)});
    }
    rig.start(2);
    for (int k = 0; k < 200; ++k) {
      rig.trigger(k % 6, 4.7 * k, k);
    }
    rig.set_point(300.0, 3, 2.0);
    rig.set_point(600.0, 1, 0.5);
    rig.run();
    std::vector<std::int64_t> trace;
    for (const JobRecord& record : rig.records) {
      trace.insert(trace.end(), {record.node, record.released.time_since_epoch().count(),
                                 record.started.time_since_epoch().count(),
                                 record.ended.time_since_epoch().count(), record.busy.count(),
                                 record.killed, record.missed});
    }
    trace.push_back(static_cast<std::int64_t>(rig.computer->drops()));
    return trace;
  };
  const auto first = fly();
  EXPECT_GT(first.size(), 7U * 100U);
  EXPECT_EQ(first, fly());
}

}  // namespace
}  // namespace flyball
