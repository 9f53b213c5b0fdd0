// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A modeled computer whose jobs take as many milliseconds as a test says, at 1 GHz on one core.

#include "flyball/runtime/modeled/virtual_executor.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

inline MissionTime at_ms(double ms) {
  return MissionTime{Duration{static_cast<std::int64_t>(std::llround(ms * 1e6))}};
}
inline double ms(Duration d) {
  return static_cast<double>(d.count()) / 1e6;
}
inline double ms(MissionTime t) {
  return ms(t.time_since_epoch());
}

/// `serial`, `memory` (half of its time does not scale with the clock), `amdahl` (80 % parallel)
/// and `race` (all of what is shared).
inline PlatformModel rig_model(double switching_ms) {
  PlatformModel model;
  model.name = "rig";
  model.max_cores = 4;
  model.frequencies = {Hertz{0.5e9}, Hertz{1e9}, Hertz{2e9}};
  model.switching_time = at_ms(switching_ms).time_since_epoch();
  model.kernels["serial"] = {{{"ms", 1e-3}}, 1.0, 1.0, 0.0, 0.0};
  model.kernels["memory"] = {{{"ms", 1e-3}}, 1.0, 0.5, 0.5, 0.0};
  model.kernels["amdahl"] = {{{"ms", 1e-3}}, 1.0, 1.0, 0.0, 0.8};
  model.kernels["race"] = {{{"ms", 1e-3}}, 1.0, 1.0, 0.0, 1.0};
  return model;
}

struct RigJob {
  double time_ms{};
  int priority{};
  std::string cost{"serial"};
  int threads{1};
  double deadline_ms{};
  OnMiss on_miss{OnMiss::warn};
  std::size_t capacity{1};
  double stop_latency_ms{};
  std::optional<double> shared_ms{};  ///< Of `time_ms`, what several cores can share.
  int fewer_threads{};                ///< Of `threads`, that share it; 0: all.
};

/// Nodes that a message starts. Each publishes, as an output, how many jobs it has computed.
struct ComputerRig {
  explicit ComputerRig(double switching_ms = 0.0) : platform{rig_model(switching_ms)} {}

  /// Returns the node.
  int add(const RigJob& job) {
    const int node = static_cast<int>(graph.nodes().size());
    const std::string name = "job" + std::to_string(node);
    triggers.push_back(graph.topic<int>(name + ".in", job.capacity));
    outputs.push_back(graph.topic<int>(name + ".out"));
    NodeSpec spec;
    spec.name = name;
    spec.cost = job.cost;
    spec.trigger = OnMessage{triggers.back().index};
    spec.priority = job.priority;
    spec.threads = job.threads;
    spec.deadline = at_ms(job.deadline_ms).time_since_epoch();
    spec.on_miss = job.on_miss;
    spec.stop_latency = at_ms(job.stop_latency_ms).time_since_epoch();
    spec.writes = {outputs.back().index};
    graph.node(spec, [this, job, in = triggers.back(), out = outputs.back()](JobContext& context) {
      const auto message = context.take(in);
      taken.push_back(message ? *message : -1);
      context.publish(out, static_cast<int>(taken.size()));
      Work work;
      work.add("ms", job.time_ms - job.shared_ms.value_or(0.0));
      if (job.shared_ms) {
        work.add_shared("ms", *job.shared_ms);
      }
      if (job.fewer_threads > 0) {
        work.shared_among(job.fewer_threads);
      }
      return work;
    });
    return node;
  }

  void start(int cores, double ghz = 1.0) {
    computer = std::make_unique<VirtualExecutor>(graph, platform, queue,
                                                 OperatingPoint{cores, Hertz{ghz * 1e9}});
    computer->on_job([this](const JobRecord& record) { records.push_back(record); });
  }

  void trigger(int node, double when_ms, int value = 0) {
    queue.schedule(at_ms(when_ms), EventOrder::sensor, [this, node, value] {
      computer->publish(triggers[static_cast<std::size_t>(node)], value);
    });
  }
  void set_point(double when_ms, int cores, double ghz) {
    queue.schedule(at_ms(when_ms), EventOrder::governor, [this, cores, ghz] {
      computer->set_operating_point({cores, Hertz{ghz * 1e9}});
    });
  }
  /// To the last event: a rig without periods comes to rest.
  void run() {
    queue.run([] { return false; });
  }
  /// Of the first job of `node` that ended.
  [[nodiscard]] JobRecord of(int node) const {
    for (const JobRecord& record : records) {
      if (record.node == node) {
        return record;
      }
    }
    return {};
  }
  [[nodiscard]] double end_ms(int node) const { return ms(of(node).ended); }

  Graph graph{"rig"};
  ModeledPlatform platform;
  EventQueue queue;
  std::unique_ptr<VirtualExecutor> computer;
  std::vector<Topic<int>> triggers;
  std::vector<Topic<int>> outputs;
  std::vector<JobRecord> records;
  std::vector<int> taken;  ///< Values that the jobs read, in the order in which they computed.
};

/// Ends are rounded up to whole nanoseconds.
constexpr double end_tolerance_ms = 2e-6;

}  // namespace flyball
