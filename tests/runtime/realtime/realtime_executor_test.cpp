// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/realtime/realtime_executor.h"

#include "counting_new.h"
#include "realtime/thread_setup.h"
#include "realtime_rig.h"
#include <algorithm>
#include <array>

#include <gtest/gtest.h>
#include <sched.h>

namespace flyball {
namespace {

int cores_of_thread() {
  cpu_set_t cpus;
  CPU_ZERO(&cpus);
  sched_getaffinity(0, sizeof cpus, &cpus);
  return CPU_COUNT(&cpus);
}

int first_cpu() {
  cpu_set_t cpus;
  CPU_ZERO(&cpus);
  sched_getaffinity(0, sizeof cpus, &cpus);
  int cpu = 0;
  while (!CPU_ISSET(static_cast<std::size_t>(cpu), &cpus)) {
    ++cpu;
  }
  return cpu;
}

/// Some message is not of interest.
void nothing(JobContext& /*context*/) {}

TEST(RealtimeExecutor, runs_nothing_before_it_is_served) {
  RealtimeRig rig;
  std::atomic<int> jobs{};
  const auto in = rig.add("node", 0, [&](JobContext&) { ++jobs; });
  rig.start();
  rig.executor->publish(in, 1);
  EXPECT_EQ(rig.executor->now(), MissionTime{});
  std::this_thread::sleep_for(20ms);
  EXPECT_EQ(jobs, 0);
  EXPECT_TRUE(rig.serve([&] { return jobs == 1; }));
  EXPECT_GT(rig.executor->now(), MissionTime{});
}

TEST(RealtimeExecutor, computes_on_its_threads_and_tells_on_the_owners) {
  RealtimeRig rig;
  const auto out = rig.graph.topic<int>("out");
  NodeSpec spec;
  spec.writes = {out.index};
  std::thread::id computed_on;
  const auto in = rig.add(
      "node", 0,
      [&](JobContext& context) {
        computed_on = std::this_thread::get_id();
        context.publish(out, 7);
      },
      spec);
  rig.start();
  int heard = 0;
  std::thread::id heard_on;
  rig.executor->subscribe<int>(out, [&](const int& value) {
    heard = value;
    heard_on = std::this_thread::get_id();
  });
  rig.executor->publish(in, 1);
  ASSERT_TRUE(rig.serve([&] { return rig.records.size() == 1; }));
  EXPECT_EQ(heard, 7);
  EXPECT_EQ(heard_on, std::this_thread::get_id());
  EXPECT_NE(computed_on, heard_on);
  const JobRecord& record = rig.records.front();
  EXPECT_LE(record.released, record.started);
  EXPECT_LE(record.started, record.ended);
  EXPECT_GE(record.core, 0);
  EXPECT_DOUBLE_EQ(record.clock.value(), 1e9);
  EXPECT_EQ(record.reads, (std::vector<MessageVersion>{{in.index, 1}}));
}

TEST(RealtimeExecutor, drops_periods_that_begin_while_a_job_runs_and_keeps_the_phase) {
  RealtimeRig rig;
  std::atomic<int> jobs{};
  NodeSpec spec;
  spec.name = "periodic";
  spec.trigger = OnPeriod{5ms, 2ms};
  rig.graph.node(spec, [&](JobContext&) {
    if (++jobs == 3) {
      EXPECT_TRUE(comes_true([&] { return rig.executor->drops() >= 2; }));
    }
    return Work{};
  });
  rig.start();
  ASSERT_TRUE(rig.serve([&] { return rig.records.size() >= 8; }));
  const std::uint64_t drops = rig.executor->drops();
  EXPECT_GE(drops, 2U);
  std::uint64_t skipped = 0;
  MissionTime expected{2ms};
  for (const JobRecord& record : rig.records) {
    EXPECT_EQ((record.released - MissionTime{2ms}) % 5ms, Duration::zero());
    skipped += static_cast<std::uint64_t>((record.released - expected) / 5ms);
    expected = record.released + 5ms;
  }
  EXPECT_LE(skipped, drops);
  EXPECT_GE(skipped, 2U);
}

TEST(RealtimeExecutor, tells_of_a_missed_deadline_while_the_job_still_runs) {
  RealtimeRig rig;
  std::atomic<bool> is_told{};
  bool was_told_in_time{};
  NodeSpec spec;
  spec.deadline = 3ms;
  spec.on_miss = OnMiss::brake;
  const auto in = rig.add(
      "late", 0,
      [&](JobContext&) { was_told_in_time = comes_true([&] { return is_told.load(); }); }, spec);
  rig.start();
  int node_told = -1;
  OnMiss action{};
  rig.executor->on_miss([&](int node, OnMiss what) {
    node_told = node;
    action = what;
    is_told = true;
  });
  rig.executor->publish(in, 1);
  ASSERT_TRUE(rig.serve([&] { return !rig.records.empty(); }));
  EXPECT_TRUE(was_told_in_time);
  EXPECT_EQ(node_told, 0);
  EXPECT_EQ(action, OnMiss::brake);
  EXPECT_TRUE(rig.records.front().missed);
  EXPECT_FALSE(rig.records.front().killed);
}

TEST(RealtimeExecutor, a_job_that_is_told_to_stop_publishes_nothing) {
  RealtimeRig rig;
  const auto out = rig.graph.topic<int>("out");
  NodeSpec spec;
  spec.deadline = 100ms;
  spec.on_miss = OnMiss::skip;
  spec.writes = {out.index};
  int jobs = 0;
  bool has_ended{};
  const auto in = rig.add(
      "slow", 0,
      [&](JobContext& context) {
        context.publish(out, ++jobs);
        context.at_end([&](MissionTime) { has_ended = jobs == 1; });
        if (jobs == 1) {
          EXPECT_TRUE(comes_true([&] { return context.should_stop(); }));
        }
      },
      spec);
  rig.start();
  std::vector<int> heard;
  rig.executor->subscribe<int>(out, [&](const int& value) { heard.push_back(value); });
  rig.executor->publish(in, 1);
  ASSERT_TRUE(rig.serve([&] { return rig.records.size() == 1; }));
  rig.executor->publish(in, 2);
  ASSERT_TRUE(rig.serve([&] { return rig.records.size() == 2; }));
  EXPECT_TRUE(rig.records[0].killed);
  EXPECT_TRUE(rig.records[0].missed);
  EXPECT_FALSE(has_ended);
  EXPECT_EQ(heard, rig.records[1].killed ? std::vector<int>{} : std::vector<int>{2});
}

TEST(RealtimeExecutor, a_job_whose_deadline_passes_before_it_starts_never_does) {
  RealtimeRig rig;
  rig.settings.cpus = {first_cpu()};  // One thread for both nodes.
  std::atomic<bool> may_end{};
  const auto first =
      rig.add("first", 0, [&](JobContext&) { (void)comes_true([&] { return may_end.load(); }); });
  NodeSpec spec;
  spec.deadline = 3ms;
  spec.on_miss = OnMiss::skip;
  int jobs = 0;
  const auto second = rig.add(
      "second", 0, [&](JobContext&) { ++jobs; }, spec);
  rig.start();
  rig.executor->publish(first, 1);
  rig.executor->publish(second, 1);
  ASSERT_TRUE(rig.serve([&] { return !rig.of(1).empty(); }));
  may_end = true;
  ASSERT_TRUE(rig.serve([&] { return !rig.of(0).empty(); }));
  EXPECT_EQ(jobs, 0);
  const JobRecord killed = rig.of(1).front();
  EXPECT_TRUE(killed.killed);
  EXPECT_EQ(killed.started, killed.ended);
  EXPECT_EQ(killed.released + 3ms <= killed.ended, true);
}

TEST(RealtimeExecutor, an_urgent_job_need_not_wait_for_a_long_one_on_the_same_core) {
  RealtimeRig rig;
  rig.settings.cpus = {first_cpu()};
  std::atomic<bool> has_followed{};
  std::atomic<bool> plans{};
  bool saw_it{};
  const auto plan = rig.add("plan", 0, [&](JobContext&) {
    plans = true;
    saw_it = comes_true([&] { return has_followed.load(); });
  });
  const auto follow = rig.add("follow", 5, nothing);
  rig.start();
  rig.executor->publish(plan, 1);
  ASSERT_TRUE(rig.serve([&] { return plans.load(); }));
  rig.executor->publish(follow, 1);
  ASSERT_TRUE(rig.serve([&] {
    has_followed = !rig.records.empty();
    return rig.records.size() == 2;
  }));
  EXPECT_TRUE(saw_it);
  EXPECT_EQ(rig.records.front().node, 1);
}

TEST(RealtimeExecutor, a_thread_runs_the_successor_of_its_job_itself) {
  RealtimeRig rig;
  std::vector<std::thread::id> ran_on(3);
  std::vector<Topic<int>> in;
  for (std::size_t i = 0; i < 3; ++i) {
    NodeSpec spec;
    if (i > 0) {
      spec.writes = {in.back().index};
    }
    in.push_back(rig.add(
        "hop" + std::to_string(i), 0,
        [&, i](JobContext& context) {
          ran_on[i] = std::this_thread::get_id();
          if (i > 0) {
            context.publish(in[i - 1], 1);
          }
        },
        spec));
  }
  rig.start();
  rig.executor->publish(in[2], 1);
  ASSERT_TRUE(rig.serve([&] { return rig.records.size() == 3; }));
  EXPECT_EQ(ran_on[1], ran_on[2]);
  EXPECT_EQ(ran_on[0], ran_on[1]);
}

TEST(RealtimeExecutor, the_operating_point_binds_its_threads_to_so_many_cores) {
  RealtimeRig rig;
  std::atomic<int> cores{};
  const auto in = rig.add("node", 0, [&](JobContext&) { cores = cores_of_thread(); });
  const int all = cores_of_thread();
  rig.start(1);
  const auto ask = [&](std::size_t job) {
    rig.executor->publish(in, 1);
    ASSERT_TRUE(rig.serve([&] { return rig.records.size() == job; }));
  };
  ask(1);
  EXPECT_EQ(cores, 1);
  rig.executor->set_operating_point({all + 5, Hertz{2e9}});
  EXPECT_EQ(rig.executor->operating_point(), (OperatingPoint{all, Hertz{1e9}}));
  ask(2);
  EXPECT_EQ(cores, all);
  rig.executor->set_operating_point({1, Hertz{2e9}});
  ask(3);
  EXPECT_EQ(cores, 1);
}

TEST(RealtimeExecutor, the_board_says_which_clock_is_granted) {
  RealtimeRig rig;
  double most_hz = 2e9;
  rig.settings.grant = [&](const OperatingPoint& wanted) {
    return OperatingPoint{wanted.cores, Hertz{std::min(most_hz, wanted.frequency.value())}};
  };
  rig.add("node", 0, nothing);
  rig.start();
  rig.executor->set_operating_point({1, Hertz{1.5e9}});
  EXPECT_DOUBLE_EQ(rig.executor->operating_point().frequency.value(), 1.5e9);
  most_hz = 1.2e9;  // It throttles.
  rig.executor->platform_changed();
  EXPECT_DOUBLE_EQ(rig.executor->operating_point().frequency.value(), 1.2e9);
}

TEST(RealtimeExecutor, tells_once_of_a_job_that_does_not_end) {
  RealtimeRig rig;
  rig.settings.stuck_after = 3ms;
  std::vector<std::string> sentences;
  rig.settings.tell = [&](const std::string& sentence) { sentences.push_back(sentence); };
  std::atomic<int> told{};
  const auto in = rig.add("stuck", 0, [&](JobContext&) {
    EXPECT_TRUE(comes_true([&] { return told.load() == 1; }));
    std::this_thread::sleep_for(10ms);
  });
  rig.start();
  Duration running{};
  rig.executor->on_stuck([&](int node, Duration time) {
    EXPECT_EQ(node, 0);
    running = time;
    ++told;
  });
  rig.executor->publish(in, 1);
  ASSERT_TRUE(rig.serve([&] { return rig.records.size() == 1; }));
  EXPECT_EQ(told, 1);
  EXPECT_GE(running, 3ms);
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_EQ(sentences.front().rfind("the job of node stuck has run for ", 0), 0U);
}

TEST(RealtimeExecutor, says_what_the_system_did_not_permit) {
  RealtimeRig rig;
  rig.settings.fifo_priority = 10;
  std::vector<std::string> notes;
  rig.settings.tell = [&](const std::string& note) { notes.push_back(note); };
  int policy = -1;
  const auto in = rig.add("node", 0, [&](JobContext&) { policy = sched_getscheduler(0); });
  rig.start();
  rig.executor->publish(in, 1);
  ASSERT_TRUE(rig.serve([&] { return rig.records.size() == 1; }));
  if (const auto throttle = real_time_throttle()) {  // As this machine is set.
    ASSERT_FALSE(notes.empty());
    EXPECT_EQ(notes.front(), *throttle);
    notes.erase(notes.begin());
  }
  if (policy == SCHED_FIFO) {
    EXPECT_TRUE(notes.empty()) << notes.front();
  } else {
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes.front().find("CAP_SYS_NICE"), std::string::npos) << notes.front();
  }
}

TEST(RealtimeExecutor, says_which_core_does_not_exist) {
  RealtimeRig rig;
  rig.settings.cpus = {CPU_SETSIZE - 1};
  std::vector<std::string> notes;
  rig.settings.tell = [&](const std::string& note) { notes.push_back(note); };
  rig.add("node", 0, nothing);
  rig.start();
  rig.executor->serve_until(MissionTime{1ms});
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes.front().find("off-line"), std::string::npos);
}

TEST(RealtimeExecutor, a_hop_allocates_nothing_once_the_graph_is_warm) {
  RealtimeRig rig;
  rig.settings.cpus = {first_cpu()};  // One thread, whose allocations are counted.
  constexpr int warm = 100;
  constexpr int most = 2000;
  std::size_t when_warm{};
  std::size_t at_end{};
  const auto ping = rig.graph.topic<std::array<double, 40>>("ping", 2);
  const auto pong = rig.graph.topic<std::array<double, 40>>("pong");
  NodeSpec spec;
  spec.name = "ping";
  spec.trigger = OnMessage{ping.index};
  spec.writes = {pong.index};
  spec.deadline = 1s;
  std::atomic<int> hops{};
  rig.graph.node(spec, [&](JobContext& context) {
    const auto message = context.take(ping);
    ++hops;
    when_warm = hops == warm ? allocation_count() : when_warm;
    at_end = allocation_count();
    context.publish(pong, *message);
    return Work{};
  });
  spec.name = "pong";
  spec.trigger = OnMessage{pong.index};
  spec.writes = {ping.index};
  rig.graph.node(spec, [&](JobContext& context) {
    if (hops < most) {
      context.publish(ping, *context.latest(pong));
    }
    return Work{};
  });
  rig.executor =
      std::make_unique<RealtimeExecutor>(rig.graph, OperatingPoint{1, Hertz{1e9}}, rig.settings);
  rig.executor->publish(ping, {});
  ASSERT_TRUE(rig.serve([&] { return hops == most; }));
  rig.executor->stop();
  EXPECT_GT(when_warm, 0U);
  EXPECT_EQ(at_end, when_warm);
}

}  // namespace
}  // namespace flyball
