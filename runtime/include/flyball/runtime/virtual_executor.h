// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A discrete-event model of the companion computer: `cores` servers at `frequency`.

#include "flyball/runtime/event_queue.h"
#include "flyball/runtime/executor.h"

#include <memory>

namespace flyball {

struct VirtualComputer;  // see runtime/src/virtual_computer.h

/// Preemptive-resume by priority; jobs of equal priority share the cores equally; a job uses at
/// most its node's `threads`. A job computes for real when it first gets a core, and ends when the
/// modeled time has passed: progress grows at S(share) / t(f), or share / t(f) below one core, so
/// that a change of clock or cores alters only that rate. A node runs one job at a time.
/// Cores that the platform says are taken are first those that the operating point leaves idle.
/// The same graph, platform and events give the same schedule on any host.
class VirtualExecutor final : public Executor {
 public:
  /// Graph, platform and queue outlive the executor.
  VirtualExecutor(const Graph& graph,
                  const Platform& platform,
                  EventQueue& queue,
                  OperatingPoint point);
  ~VirtualExecutor() override;
  VirtualExecutor(const VirtualExecutor&) = delete;
  VirtualExecutor& operator=(const VirtualExecutor&) = delete;

  void filter_messages(std::function<Message(int topic, const Message&)> filter) override;
  void on_job(std::function<void(const JobRecord&)> listener) override;
  void on_miss(std::function<void(int node, OnMiss)> listener) override;
  void set_operating_point(const OperatingPoint& point) override;
  [[nodiscard]] OperatingPoint operating_point() const override;
  /// There is an edge computer from now on. A job of a node that is placed there computes when it
  /// is released, with what it reads then. What it has read travels to the edge computer, unless it
  /// was sent before or made there; the job is served there as on board, and its outputs travel
  /// back. Meanwhile it takes nothing of the cores on board. The first job after its node's move
  /// also sends the newest messages that the node had published: the state of a mapper is its map.
  void connect_edge(const EdgeModel& edge);
  void place(int node, bool on_edge) override;
  [[nodiscard]] DeviceUse device_use() const override;
  /// Running jobs go on at new rates.
  void platform_changed() override;
  [[nodiscard]] double busy_core_s() const override;
  [[nodiscard]] double busiest_core_s() const override;
  [[nodiscard]] double busy_cores() const override;
  [[nodiscard]] std::uint64_t drops() const override;
  /// Jobs that have not ended by then never do.
  void stop() override;

 protected:
  void inject(int topic, Message message) override;
  void listen(int topic, std::function<void(const Message&)> listener) override;

 private:
  /// Owners: this, and for its duration an event that runs. Events that wait hold it weakly,
  /// because the queue outlives the executor.
  std::shared_ptr<VirtualComputer> computer_;
};

}  // namespace flyball
