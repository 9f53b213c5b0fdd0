// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The inside of the virtual executor. Messages and jobs come and go in virtual_executor.cpp; how
/// jobs share the cores is in job_scheduling.cpp.

#include "flyball/runtime/virtual_executor.h"

#include "job.h"
#include "message_exchange.h"
#include "node_job.h"
#include <deque>
#include <optional>
#include <vector>

namespace flyball {

struct NodeState {
  explicit NodeState(const NodeSpec& spec) : context{spec, nullptr} {}

  std::optional<Job> job{};
  NodeJob context;  ///< Of the job that computes, for a moment of mission time.
};

struct VirtualComputer : std::enable_shared_from_this<VirtualComputer> {
  VirtualComputer(const Graph& hosted,
                  const Platform& model,
                  EventQueue& events,
                  OperatingPoint first);
  void start();

  // Messages and jobs.
  void publish(int topic, const Message& message);
  void trigger_periodically(int node);
  void release(int node, MissionTime at);
  void release_next(int node);
  void pass_deadline(int node, std::uint64_t job);
  void end_job(int node);
  void kill_job(int node);
  /// Tells the job of `node` to stop: it works on for its node's stop latency, for nothing.
  void tell_to_stop(int node);
  Job take_job(int node);
  void tell(const JobRecord& record);

  // Scheduling.
  void request_dispatch();
  void dispatch();
  /// Starts those that get a core for the first time; false: none of them was new.
  bool compute_new(const std::vector<int>& urgent, const std::vector<double>& shares);
  void compute(int node);
  void apply_share(int node, double share);
  void schedule_end(int node);
  void advance();
  void set_operating_point(const OperatingPoint& wanted);
  void change_platform();
  void apply(const OperatingPoint& granted);
  void rescale_running_jobs();
  [[nodiscard]] double free_cores() const;
  /// The kernel whose price list counts for a node's work.
  [[nodiscard]] const std::string& price_list(int node, const Work& work) const;
  [[nodiscard]] Duration time_on_one_core(int node, const Work& work) const;
  [[nodiscard]] double useful_cores(int node) const;
  /// How many times faster than on one core the node's job is on `cores`.
  [[nodiscard]] double speed_on(int node, double cores) const;
  [[nodiscard]] std::vector<int> nodes_by_urgency() const;
  [[nodiscard]] std::vector<double> shares_of(const std::vector<int>& urgent) const;
  [[nodiscard]] double busy_cores() const;

  /// Schedules `action` for as long as this executor lives: the queue outlives it.
  void at(MissionTime time, EventOrder order, std::function<void(VirtualComputer&)> action);
  [[nodiscard]] const NodeSpec& spec(int node) const { return graph.nodes()[index(node)].spec; }
  [[nodiscard]] static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  const Graph& graph;
  const Platform& platform;
  EventQueue& queue;
  OperatingPoint requested;
  OperatingPoint point;  ///< Granted.
  double taken_cores;    ///< Busy with somebody else's work.
  MessageExchange exchange;
  std::deque<NodeState> nodes{};
  /// Of each topic. Deques: a listener may add another one while it runs.
  std::vector<std::deque<std::function<void(const Message&)>>> listeners;
  std::deque<std::function<void(const JobRecord&)>> job_listeners;
  std::deque<std::function<void(int, OnMiss)>> miss_listeners;
  std::uint64_t jobs_released{};
  std::uint64_t dropped_periods{};
  double busy_core_s{};
  double busiest_core_s{};
  MissionTime advanced_to{};
  MissionTime stalled_until{};
  bool is_dispatch_pending{};
  bool is_stopped{};
};

}  // namespace flyball
