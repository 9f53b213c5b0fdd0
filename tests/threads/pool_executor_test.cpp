// SPDX-License-Identifier: BSD-3-Clause
#include "pool_executor.h"

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace flyball::kit {
namespace {

using namespace std::chrono_literals;

PlatformModel idle_model() {
  PlatformModel model;
  model.name = "idle";
  model.frequencies = {Hertz{1e9}, Hertz{2e9}};
  return model;
}

/// Steps the queue to a time; whoever waits longer than that finds nothing on it.
void run_to(EventQueue& queue, Duration end) {
  while (queue.next() && *queue.next() <= MissionTime{end}) {
    (void)queue.step();
  }
}

struct PoolRig {
  PoolExecutor& start() {
    settings.overlaps = &overlaps;
    executor = std::make_unique<PoolExecutor>(graph, platform, queue, OperatingPoint{1, Hertz{1e9}},
                                              settings);
    return *executor;
  }

  NodeSpec on(int topic, const std::string& name) const {
    NodeSpec spec;
    spec.name = name;
    spec.trigger = OnMessage{topic};
    return spec;
  }

  Graph graph{"pool"};
  ModeledPlatform platform{idle_model()};
  EventQueue queue;
  PoolSettings settings{};
  std::set<std::pair<std::string, std::string>> overlaps{};
  std::unique_ptr<PoolExecutor> executor;
};

TEST(PoolExecutor, every_message_arrives_once_and_in_order_at_nodes_and_listeners) {
  PoolRig rig;
  const Topic<int> numbers = rig.graph.topic<int>("numbers", 1000);
  const Topic<int> doubled = rig.graph.topic<int>("doubled", 1000);
  NodeSpec spec = rig.on(numbers.index, "double");
  spec.writes = {doubled.index};
  rig.graph.node(spec, [=](JobContext& job) {
    job.publish(doubled, 2 * *job.take(numbers));
    return Work{};
  });
  std::vector<int> at_node;
  rig.graph.node(rig.on(doubled.index, "keep"), [&at_node, doubled](JobContext& job) {
    at_node.push_back(*job.take(doubled));
    return Work{};
  });
  PoolExecutor& executor = rig.start();
  std::vector<int> heard;
  int jobs = 0;
  executor.subscribe<int>(doubled, [&](const int& number) { heard.push_back(number); });
  executor.on_job([&](const JobRecord& /*job*/) { ++jobs; });
  std::vector<int> expected;
  for (int i = 0; i < 500; ++i) {
    executor.publish(numbers, i);
    expected.push_back(2 * i);
  }
  executor.settle();
  executor.stop();
  EXPECT_EQ(at_node, expected);
  EXPECT_EQ(heard, expected);
  EXPECT_EQ(jobs, 1000);
  EXPECT_EQ(executor.drops(), 0U);
}

TEST(PoolExecutor, a_node_runs_one_job_at_a_time) {
  PoolRig rig;
  const Topic<int> numbers = rig.graph.topic<int>("numbers", 1000);
  std::atomic<int> inside{0};
  std::atomic<int> most{0};
  int unguarded = 0;  // The thread sanitizer reports it if two jobs are not in order.
  rig.graph.node(rig.on(numbers.index, "count"), [&](JobContext& /*job*/) {
    most = std::max(most.load(), ++inside);
    ++unguarded;
    std::this_thread::yield();
    --inside;
    return Work{};
  });
  PoolExecutor& executor = rig.start();
  for (int i = 0; i < 300; ++i) {
    executor.publish(numbers, i);
  }
  executor.settle();
  EXPECT_EQ(most, 1);
  EXPECT_EQ(unguarded, 300);
}

/// Waits for the others, which come only if their jobs run at the same time.
class Meeting {
 public:
  explicit Meeting(int expected) : missing_{expected} {}
  bool meet() {
    std::unique_lock lock{mutex_};
    --missing_;
    all_here_.notify_all();
    return all_here_.wait_for(lock, 60s, [this] { return missing_ <= 0; });
  }

 private:
  std::mutex mutex_{};
  std::condition_variable all_here_{};
  int missing_;
};

TEST(PoolExecutor, jobs_of_as_many_nodes_as_there_are_threads_overlap) {
  PoolRig rig;
  const Topic<int> start = rig.graph.topic<int>("start");
  Meeting meeting{4};
  std::atomic<int> met{0};
  for (const char* name : {"a", "b", "c", "d"}) {
    rig.graph.node(rig.on(start.index, name), [&](JobContext& /*job*/) {
      met += meeting.meet() ? 1 : 0;
      return Work{};
    });
  }
  PoolExecutor& executor = rig.start();
  executor.publish(start, 1);
  executor.settle();
  executor.stop();
  EXPECT_EQ(met, 4);
  EXPECT_EQ(rig.overlaps.size(), 6U);
  EXPECT_EQ(rig.overlaps.count({"a", "d"}), 1U);
}

TEST(PoolExecutor, a_job_sees_its_messages_as_they_were_when_it_began) {
  PoolRig rig;
  const Topic<int> start = rig.graph.topic<int>("start");
  const Topic<int> value = rig.graph.topic<int>("value");
  Meeting begun{2};
  Meeting published{2};
  std::array<int, 2> seen{};
  NodeSpec spec = rig.on(start.index, "look");
  spec.reads = {value.index};
  rig.graph.node(spec, [&](JobContext& job) {
    EXPECT_TRUE(begun.meet() && published.meet());
    seen = {*job.latest(value), *job.take(value)};
    return Work{};
  });
  PoolExecutor& executor = rig.start();
  executor.publish(value, 1);
  executor.publish(start, 1);
  ASSERT_TRUE(begun.meet());
  executor.publish(value, 2);
  EXPECT_TRUE(published.meet());
  executor.settle();
  EXPECT_EQ(seen, (std::array<int, 2>{1, 1}));
}

TEST(PoolExecutor, periods_go_with_the_queue_and_the_queue_waits_for_jobs_with_a_deadline) {
  PoolRig rig;
  std::vector<MissionTime> ticks;
  NodeSpec spec;
  spec.name = "tick";
  spec.trigger = OnPeriod{20ms, 10ms};
  spec.deadline = 20ms;
  rig.graph.node(spec, [&](JobContext& job) {
    ticks.push_back(job.released());
    return Work{};
  });
  PoolExecutor& executor = rig.start();
  run_to(rig.queue, 1s);
  executor.settle();
  ASSERT_EQ(ticks.size(), 50U);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    EXPECT_EQ(ticks[i], MissionTime{10ms + static_cast<int>(i) * 20ms});
  }
}

TEST(PoolExecutor, grants_an_operating_point_at_the_end_of_the_slice) {
  PoolRig rig;
  PoolExecutor& executor = rig.start();
  executor.set_operating_point({1, Hertz{2e9}});
  EXPECT_EQ(executor.operating_point().frequency.value(), 1e9);
  run_to(rig.queue, 20ms);
  EXPECT_EQ(executor.operating_point().frequency.value(), 2e9);
}

TEST(PoolExecutor, starts_no_job_once_it_has_stopped) {
  PoolRig rig;
  const Topic<int> start = rig.graph.topic<int>("start");
  int jobs = 0;
  rig.graph.node(rig.on(start.index, "count"), [&](JobContext& /*job*/) {
    ++jobs;
    return Work{};
  });
  PoolExecutor& executor = rig.start();
  executor.publish(start, 1);
  executor.settle();
  executor.stop();
  executor.publish(start, 2);
  run_to(rig.queue, 1s);
  EXPECT_EQ(jobs, 1);
}

#ifdef __SANITIZE_THREAD__
/// Ends the program.
void run_two_nodes_that_share_a_number() {
  PoolRig rig;
  const Topic<int> start = rig.graph.topic<int>("start", 1000);
  int shared = 0;
  for (const char* name : {"a", "b"}) {
    rig.graph.node(rig.on(start.index, name), [&](JobContext& /*job*/) {
      ++shared;
      return Work{};
    });
  }
  PoolExecutor& executor = rig.start();
  for (int i = 0; i < 500; ++i) {
    executor.publish(start, i);
  }
  executor.settle();
  executor.stop();
  std::exit(0);
}

TEST(PoolExecutorDeathTest, nodes_that_share_state_beside_topics_are_reported) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  constexpr int reported = 66;  // The sanitizer's usual exit code.
  EXPECT_EXIT(run_two_nodes_that_share_a_number(), testing::ExitedWithCode(reported), "data race");
}
#endif

}  // namespace
}  // namespace flyball::kit
