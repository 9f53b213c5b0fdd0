// SPDX-License-Identifier: BSD-3-Clause
#include "bench/delivery_soak.h"

#include "flyball/runtime/realtime/realtime_executor.h"

#include "bench/hop_times.h"
#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>

#include <unistd.h>

namespace flyball::bench {
namespace {

using namespace std::chrono_literals;

using Cloud = std::array<float, 960>;

void work_for(std::chrono::nanoseconds time) {
  const std::int64_t end = now_ns() + time.count();
  while (now_ns() < end) {
  }
}

double resident_mb() {
  std::ifstream statm{"/proc/self/statm"};
  double pages{};
  double resident{};
  statm >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

/// Depth images at 10 Hz become points and a map; the map is checked and followed at 50 Hz, planned
/// over once a second, and governed four times. The times of the jobs are of a quick computer.
class DeliveryShape {
 public:
  DeliveryShape() {
    const auto depth = graph.topic<Cloud>("depth");
    const auto points = graph.topic<Cloud>("points");
    const auto map = graph.topic<Cloud>("map");
    const auto path = graph.topic<Cloud>("path");
    const auto setpoint = graph.topic<Cloud>("setpoint");
    const auto knobs = graph.topic<int>("knobs");
    every("camera", 5, 100ms, {}, depth, 500us);
    on("points", 3, depth, {}, points, 1ms);
    on("map", 2, points, {knobs.index}, map, 4ms);
    every("plan", 0, 1s, {map.index}, path, 60ms);
    follow = every("follow", 4, 20ms, {path.index, map.index}, setpoint, 200us);
    every("govern", 1, 250ms, {map.index}, std::nullopt, 300us);
  }

  Graph graph{"delivery"};
  int follow{};

 private:
  int add(NodeSpec spec, std::optional<Topic<Cloud>> out, Duration time) {
    if (out) {
      spec.writes = {out->index};
    }
    const std::vector<int> reads = spec.reads;
    graph.node(spec, [out, reads, time](JobContext& context) {
      for (const int topic : reads) {
        (void)context.latest(Topic<Cloud>{topic});
      }
      work_for(time);
      if (out) {
        context.publish(*out, Cloud{});
      }
      return Work{};
    });
    return static_cast<int>(graph.nodes().size()) - 1;
  }
  int every(const std::string& name,
            int priority,
            Duration period,
            std::vector<int> reads,
            std::optional<Topic<Cloud>> out,
            Duration time) {
    NodeSpec spec;
    spec.name = name;
    spec.priority = priority;
    spec.trigger = OnPeriod{period, period};
    spec.deadline = period;
    spec.reads = std::move(reads);
    return add(std::move(spec), out, time);
  }
  void on(const std::string& name,
          int priority,
          Topic<Cloud> in,
          std::vector<int> reads,
          Topic<Cloud> out,
          Duration time) {
    NodeSpec spec;
    spec.name = name;
    spec.priority = priority;
    spec.trigger = OnMessage{in.index};
    spec.deadline = 100ms;
    spec.reads = std::move(reads);
    add(std::move(spec), out, time);
  }
};

}  // namespace

void soak(double seconds, std::optional<int> fifo_priority) {
  const DeliveryShape shape;
  RealtimeSettings settings;
  settings.lock_memory = true;
  settings.fifo_priority = fifo_priority;
  settings.tell = [](const std::string& sentence) { std::printf("%s\n", sentence.c_str()); };
  RealtimeExecutor executor{shape.graph, {64, Hertz{1e9}}, settings};
  std::uint64_t jobs = 0;
  std::uint64_t misses = 0;
  std::vector<double> jitter_us;
  executor.on_job([&](const JobRecord& record) {
    ++jobs;
    misses += record.missed ? 1 : 0;
    if (record.node == shape.follow) {
      jitter_us.push_back(to_seconds(record.started - record.released) * 1e6);
    }
  });
  // Touched before memory is looked at, so that the growth that is found is not its own.
  jitter_us.assign(static_cast<std::size_t>(seconds * 51.0) + 100, 0.0);
  jitter_us.clear();
  executor.serve_until(MissionTime{from_seconds(0.1 * seconds)});
  const double early_mb = resident_mb();
  executor.serve_until(MissionTime{from_seconds(seconds)});
  const double late_mb = resident_mb();
  const double busy_s = executor.busy_core_s();
  executor.stop();
  std::printf(
      "%.0f s: %llu jobs, %llu deadlines missed, %llu dropped; path follower's release jitter "
      "%.1f us median, %.1f us 99 %%, %.1f us at most; resident memory %.1f MB, later %.1f MB; "
      "%.1f %% of one core\n",
      seconds, static_cast<unsigned long long>(jobs), static_cast<unsigned long long>(misses),
      static_cast<unsigned long long>(executor.drops()), quantile(jitter_us, 0.5),
      quantile(jitter_us, 0.99), quantile(jitter_us, 1.0), early_mb, late_mb,
      100.0 * busy_s / seconds);
}

}  // namespace flyball::bench
