// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/realtime/replay_executor.h"

#include "flyball/runtime/random.h"

#include "realtime_rig.h"
#include <cstdlib>
#include <map>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Seeded runs per test: 20, or what FLYBALL_REPLAY_RUNS says.
int run_count() {
  const char* chosen = std::getenv("FLYBALL_REPLAY_RUNS");
  return chosen != nullptr ? std::max(1, std::atoi(chosen)) : 20;
}

std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
  return (a ^ (b + 0x9e3779b97f4a7c15U + (a << 6U) + (a >> 2U))) * 0xff51afd7ed558ccdU;
}

struct Letter {
  std::uint64_t value{};
};

/// Nodes that compute numbers from their messages, their past and their times, and publish some of
/// them. A seed says who reads whom, what starts a job, how urgent it is and how long it takes.
class RandomGraph {
 public:
  explicit RandomGraph(std::uint64_t seed) : random_{seed, "random graph"} {
    const int topics = 4 + below(5);
    for (int i = 0; i < topics; ++i) {
      topics_.push_back(
          graph_.topic<Letter>("topic" + std::to_string(i), below(2) == 0 ? 1U : 1U + below(6)));
    }
    const int nodes = 3 + below(6);
    pasts_.resize(static_cast<std::size_t>(nodes));
    for (int i = 0; i < nodes; ++i) {
      add_node(i);
    }
  }

  [[nodiscard]] const Graph& graph() const { return graph_; }
  [[nodiscard]] const std::vector<Topic<Letter>>& topics() const { return topics_; }

 private:
  [[nodiscard]] int below(int count) {
    return static_cast<int>(random_.next() % static_cast<std::uint64_t>(count));
  }
  [[nodiscard]] Topic<Letter> some_topic() {
    return topics_[static_cast<std::size_t>(below(static_cast<int>(topics_.size())))];
  }

  void add_node(int number) {
    NodeSpec spec;
    spec.name = "node" + std::to_string(number);
    spec.priority = below(3);
    // The first topic is for what comes from outside: at most every node on it starts at once.
    const Topic<Letter> trigger = below(3) == 0 ? topics_.front() : some_topic();
    if (below(3) == 0) {
      spec.trigger = OnPeriod{std::chrono::microseconds{500 + below(3000)},
                              std::chrono::microseconds{below(1000)}};
    } else {
      spec.trigger = OnMessage{trigger.index};
    }
    for (int i = 0; i < 2; ++i) {
      spec.reads.push_back(some_topic().index);
    }
    spec.writes.push_back(
        topics_[1 + static_cast<std::size_t>(below(static_cast<int>(topics_.size()) - 1))].index);
    if (below(3) == 0) {
      spec.deadline = std::chrono::microseconds{100 + below(900)};
      spec.on_miss = below(2) == 0 ? OnMiss::skip : OnMiss::warn;
    }
    graph_.node(spec, [this, spec, number, most_us = 20 + below(400)](JobContext& context) {
      return compute(context, spec, pasts_[static_cast<std::size_t>(number)], most_us);
    });
  }

  static Work compute(JobContext& context, const NodeSpec& spec, std::uint64_t& past, int most_us) {
    std::uint64_t sum =
        mixed(past, static_cast<std::uint64_t>((context.now() - context.released()).count()));
    for (const int topic : spec.reads) {
      const auto letter = context.latest(Topic<Letter>{topic});
      sum = mixed(sum, letter ? letter->value : 1);
    }
    if (const auto* trigger = std::get_if<OnMessage>(&spec.trigger); trigger && sum % 4 != 0) {
      const auto letter = context.take(Topic<Letter>{trigger->topic});
      sum = mixed(sum, letter ? letter->value : 2);
    }
    const auto steps = static_cast<int>(sum % static_cast<std::uint64_t>(most_us)) / 20;
    for (int step = 0; step < steps && !context.should_stop(); ++step) {
      sum = mixed(sum, static_cast<std::uint64_t>(step));
      std::this_thread::sleep_for(20us);
    }
    past = sum;
    if (sum % 3 != 0) {
      context.publish(Topic<Letter>{spec.writes.front()}, Letter{sum});
      context.at_end([&past](MissionTime end) {
        past = mixed(past, static_cast<std::uint64_t>(end.time_since_epoch().count()));
      });
    }
    Work work;
    work.add("steps", static_cast<double>(sum % 1000));
    return work;
  }

  RandomStream random_;
  Graph graph_{"random"};
  std::vector<Topic<Letter>> topics_{};
  std::vector<std::uint64_t> pasts_{};  ///< What a node remembers of its own jobs.
};

/// All that was published on each topic, and all jobs.
struct Heard {
  void listen_to(Executor& executor, const RandomGraph& graph) {
    for (const Topic<Letter> topic : graph.topics()) {
      executor.subscribe<Letter>(topic, [this, topic](const Letter& letter) {
        values[topic.index].push_back(letter.value);
      });
    }
    executor.on_job([this](const JobRecord& record) { jobs.push_back(record); });
  }
  std::map<int, std::vector<std::uint64_t>> values{};
  std::vector<JobRecord> jobs{};
};

RunLog record_run(std::uint64_t seed, Heard& heard) {
  RunLog log;
  const RandomGraph random{seed};
  RealtimeSettings settings;
  settings.log = &log;
  RealtimeExecutor executor{random.graph(), {1 + static_cast<int>(seed % 2), Hertz{1e9}}, settings};
  heard.listen_to(executor, random);
  RandomStream outside{seed, "outside"};
  while (executor.now() < MissionTime{30ms}) {
    executor.publish(random.topics().front(), Letter{outside.next()});
    executor.serve_until(executor.now() + std::chrono::microseconds{outside.next() % 2000});
  }
  executor.stop();
  return log;
}

void expect_same_jobs(const std::vector<JobRecord>& recorded, const std::vector<JobRecord>& again) {
  ASSERT_LE(recorded.size(), again.size());  // The last ones were not told before the stop.
  for (std::size_t i = 0; i < recorded.size(); ++i) {
    const JobRecord& a = recorded[i];
    const JobRecord& b = again[i];
    ASSERT_EQ(a.node, b.node) << "job " << i;
    EXPECT_EQ(a.released, b.released);
    EXPECT_EQ(a.started, b.started);
    EXPECT_EQ(a.ended, b.ended);
    EXPECT_EQ(a.killed, b.killed);
    EXPECT_EQ(a.missed, b.missed);
    EXPECT_EQ(a.reads, b.reads);
    EXPECT_EQ(a.core, b.core);
    EXPECT_EQ(a.clock.value(), b.clock.value());
    if (a.started != a.ended) {
      EXPECT_EQ(a.work.count("steps"), b.work.count("steps"));
    }
  }
}

TEST(ReplayExecutor, gives_the_same_jobs_versions_and_outputs_to_the_bit) {
  std::size_t jobs = 0;
  std::size_t killed = 0;
  for (int run = 0; run < run_count() && !testing::Test::HasFailure(); ++run) {
    const auto seed = static_cast<std::uint64_t>(run + 1);
    Heard recorded;
    const RunLog log = record_run(seed, recorded);
    const RandomGraph again{seed};
    ReplayExecutor replay{again.graph(), log};
    Heard heard;
    heard.listen_to(replay, again);
    const Status same = replay.run();
    ASSERT_TRUE(same) << "seed " << seed << ": " << same.error().message;
    expect_same_jobs(recorded.jobs, heard.jobs);
    for (auto& [topic, values] : recorded.values) {
      ASSERT_GE(heard.values[topic].size(), values.size()) << "seed " << seed;
      heard.values[topic].resize(values.size());
      EXPECT_EQ(heard.values[topic], values) << "seed " << seed << ", topic " << topic;
    }
    jobs += recorded.jobs.size();
    for (const JobRecord& job : recorded.jobs) {
      killed += job.killed ? 1 : 0;
    }
  }
  std::printf("%d runs, %zu jobs, %zu of them killed\n", run_count(), jobs, killed);
  EXPECT_GT(jobs, 100U);
}

/// Two nodes, the second of which counts its jobs outside the messages.
struct Cheater {
  explicit Cheater(int& shared) {
    in = graph.topic<int>("in", 4);
    other = graph.topic<int>("other");
    NodeSpec spec;
    spec.name = "cheater";
    spec.trigger = OnMessage{in.index};
    spec.reads = {other.index};
    graph.node(spec, [this, &shared](JobContext& context) {
      if (++shared % 2 == 0) {
        (void)context.latest(other);
      }
      return Work{};
    });
  }
  Graph graph{"cheat"};
  Topic<int> in{};
  Topic<int> other{};
};

TEST(ReplayExecutor, says_which_job_used_something_beside_its_messages) {
  int shared = 0;
  RunLog log;
  Cheater recorded{shared};
  RealtimeSettings settings;
  settings.log = &log;
  RealtimeExecutor executor{recorded.graph, {1, Hertz{1e9}}, settings};
  std::size_t jobs = 0;
  executor.on_job([&](const JobRecord&) { ++jobs; });
  executor.publish(recorded.in, 1);
  EXPECT_TRUE(comes_true([&] {
    executor.serve_until(executor.now() + 1ms);
    return jobs == 1;
  }));
  executor.stop();
  const Cheater again{shared};
  const Status same = ReplayExecutor{again.graph, log}.run();
  ASSERT_FALSE(same);
  EXPECT_NE(same.error().message.find("cheater"), std::string::npos) << same.error().message;
  EXPECT_NE(same.error().message.find("read other messages"), std::string::npos);
}

TEST(ReplayExecutor, refuses_the_log_of_another_graph) {
  RunLog log;
  RunEvent event;
  event.kind = RunEvent::Kind::start;
  event.index = 3;
  log.events.push_back(event);
  const Graph empty{"empty"};
  const Status same = ReplayExecutor{empty, log}.run();
  ASSERT_FALSE(same);
  EXPECT_EQ(same.error().code, ErrorCode::invalid_input);
}

}  // namespace
}  // namespace flyball
