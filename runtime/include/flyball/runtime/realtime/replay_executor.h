// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Runs a graph again as it ran in real time.

#include "flyball/runtime/executor.h"
#include "flyball/runtime/realtime/run_log.h"
#include "flyball/runtime/result.h"

#include <memory>

namespace flyball {

struct ReplayState;  // see runtime/src/replay_executor.cpp

/// One thread, and the mission time of the log: the same jobs in the same order, each with the
/// messages of the same versions, at the same times on the same clock. Where the nodes compute the
/// same from the same messages, their publications are the same to the bit. What was published from
/// outside comes from the log, and what the caller publishes is a broken precondition.
class ReplayExecutor final : public Executor {
 public:
  /// Graph and log outlive the executor. The graph is a new one, made as the recorded one was.
  ReplayExecutor(const Graph& graph, const RunLog& log);
  ~ReplayExecutor() override;
  ReplayExecutor(const ReplayExecutor&) = delete;
  ReplayExecutor& operator=(const ReplayExecutor&) = delete;

  /// Runs the whole log, once.
  /// @error `failed`: the first job that did not read the versions that the log says, or stopped
  ///        asking at another place; `invalid_input`: the log is of another graph.
  Status run();

  void on_job(std::function<void(const JobRecord&)> listener) override;
  void on_miss(std::function<void(int node, OnMiss)> listener) override;
  /// The log says what was granted.
  void set_operating_point(const OperatingPoint& /*point*/) override {}
  /// One core, at the clock of the last job that began.
  [[nodiscard]] OperatingPoint operating_point() const override;
  void platform_changed() override {}
  /// Loads are those of the jobs that have ended.
  [[nodiscard]] double busy_core_s() const override;
  [[nodiscard]] double busiest_core_s() const override { return busy_core_s(); }
  [[nodiscard]] double busy_cores() const override { return 0.0; }
  [[nodiscard]] std::uint64_t drops() const override;
  void stop() override {}

 protected:
  void inject(int topic, Message message) override;
  void listen(int topic, std::function<void(const Message&)> listener) override;

 private:
  std::unique_ptr<ReplayState> state_;
};

}  // namespace flyball
