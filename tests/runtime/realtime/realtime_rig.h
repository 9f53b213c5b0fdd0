// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Graphs for the real-time executor. Tests with it say what happens in which order, and never how
/// long it takes: bodies wait for what the test is about, and give up after ten seconds.

#include "flyball/runtime/realtime/realtime_executor.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace flyball {

using namespace std::chrono_literals;

/// Whether the condition came true in time.
inline bool comes_true(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + 10s;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) {
      return false;
    }
    std::this_thread::sleep_for(100us);
  }
  return true;
}

struct RealtimeRig {
  /// A node that a message on the returned topic starts.
  Topic<int> add(const std::string& name,
                 int priority,
                 std::function<void(JobContext&)> body,
                 const NodeSpec& other = {}) {
    const Topic<int> in = graph.topic<int>(name + ".in", 8);
    NodeSpec spec = other;
    spec.name = name;
    spec.priority = priority;
    spec.trigger = OnMessage{in.index};
    graph.node(spec, [in, body = std::move(body)](JobContext& context) {
      (void)context.take(in);
      body(context);
      return Work{};
    });
    return in;
  }

  void start(int cores = 1) {
    executor =
        std::make_unique<RealtimeExecutor>(graph, OperatingPoint{cores, Hertz{1e9}}, settings);
    executor->on_job([this](const JobRecord& record) { records.push_back(record); });
  }
  /// Serves until the condition is true; false after ten seconds.
  bool serve(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + 10s;
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) {
        return false;
      }
      executor->serve_until(executor->now() + 1ms);
    }
    return true;
  }
  [[nodiscard]] std::vector<JobRecord> of(int node) const {
    std::vector<JobRecord> own;
    for (const JobRecord& record : records) {
      if (record.node == node) {
        own.push_back(record);
      }
    }
    return own;
  }

  Graph graph{"rig"};
  RealtimeSettings settings{};
  std::vector<JobRecord> records{};
  std::unique_ptr<RealtimeExecutor> executor{};
};

}  // namespace flyball
