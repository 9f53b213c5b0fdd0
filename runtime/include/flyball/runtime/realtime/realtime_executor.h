// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Runs a graph on threads in real time, on the machine that it runs on.

#include "flyball/runtime/executor.h"
#include "flyball/runtime/realtime/run_log.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

struct RealtimeEngine;  // see runtime/src/realtime/realtime_engine.h

struct RealtimeSettings {
  /// Cores for jobs, in the order in which the operating point takes them; empty: all that the
  /// process may use.
  std::vector<int> cpus{};
  /// SCHED_FIFO from this priority on (1 to 99), one more for each higher priority of the graph's
  /// nodes, and one more for the clock; from a lower one on where the system does not grant the
  /// highest of them. Empty, or where it grants none: ordinary scheduling, with nice values that
  /// rise as priorities fall.
  std::optional<int> fifo_priority{};
  /// A thread without a job looks for one so long before it sleeps. It costs power: zero on a
  /// battery.
  Duration spin{};
  /// Keeps all that the process touches in memory.
  bool lock_memory{};
  /// A job that has run for so long is told of by `tell` and `on_stuck`, once. Chosen: ten times
  /// the longest planning budget of the shipped workloads.
  Duration stuck_after{std::chrono::seconds{10}};
  /// Jobs that still run so long after `stop` are told of by `tell`, once; `stop` waits on. Chosen.
  Duration tell_at_stop_after{std::chrono::seconds{5}};
  /// Asks the board for a clock, and says what it granted. Empty: the clock is what it was at the
  /// start, whatever is asked. Called by whoever sets the operating point.
  std::function<OperatingPoint(const OperatingPoint& wanted)> grant{};
  /// Called on the owner's thread with one sentence for each thing that a person should know: what
  /// the system did not permit, and what would help; which job does not end.
  std::function<void(const std::string& sentence)> tell{};
  /// Where each step is written; null: nowhere. Outlives the executor.
  RunLog* log{};
};

/// Nodes of one priority share threads, at most one for each core; a thread that ends a job runs
/// the next one of its priority itself. All threads may use the operating point's cores, and the
/// operating system lets higher priorities interrupt lower ones. Mission time is the monotonic
/// clock, from the first call of `serve_until` on; nothing runs before. Deadlines are told when
/// they pass. A period that begins while its node is busy is dropped, and the next one keeps the
/// phase. No hop allocates once the graph has warmed up, but for what the nodes' bodies allocate.
///
/// The owner's thread calls `serve_until`, which calls the listeners; `stop` before it destroys
/// what the nodes use.
class RealtimeExecutor final : public Executor {
 public:
  /// The graph outlives the executor.
  /// @pre `point` has at least one core.
  RealtimeExecutor(const Graph& graph,
                   const OperatingPoint& point,
                   const RealtimeSettings& settings = {});
  ~RealtimeExecutor() override;
  RealtimeExecutor(const RealtimeExecutor&) = delete;
  RealtimeExecutor& operator=(const RealtimeExecutor&) = delete;

  /// Now; zero before the first `serve_until`.
  [[nodiscard]] MissionTime now() const;
  void serve_until(MissionTime at) override;
  [[nodiscard]] Duration longest_delay() const override;
  void on_job(std::function<void(const JobRecord&)> listener) override;
  void on_miss(std::function<void(int node, OnMiss)> listener) override;
  /// Told once for each job that has run for `stuck_after`, with how long it has.
  void on_stuck(std::function<void(int node, Duration)> listener);
  /// Binds the jobs' threads to so many cores at once; the clock is up to `grant`.
  void set_operating_point(const OperatingPoint& point) override;
  [[nodiscard]] OperatingPoint operating_point() const override;
  /// Asks `grant` again.
  void platform_changed() override;
  /// CPU time of the jobs' threads.
  [[nodiscard]] double busy_core_s() const override;
  [[nodiscard]] double busiest_core_s() const override;
  [[nodiscard]] double busy_cores() const override;
  [[nodiscard]] std::uint64_t drops() const override;
  /// Jobs that run are told to stop. Listeners hear of what ended until then, but not from the
  /// destructor.
  void stop() override;
  void run_last(int node) override;

 protected:
  void inject(int topic, Message message) override;
  void listen(int topic, std::function<void(const Message&)> listener) override;

 private:
  RealtimeExecutor(const std::shared_ptr<MessagePool>& pool,
                   const Graph& graph,
                   const OperatingPoint& point,
                   const RealtimeSettings& settings);
  std::unique_ptr<RealtimeEngine> engine_;
};

}  // namespace flyball
