// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The inside of the virtual executor. Messages and jobs come and go in virtual_executor.cpp; how
/// jobs share the cores is in job_scheduling.cpp.

#include "flyball/runtime/modeled/virtual_executor.h"

#include "edge_computer.h"
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
  bool is_offloaded{};  ///< From its next job on.
  NodeJob context;      ///< Of the job that computes, for a moment of mission time.
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
  void serve(ComputePlace place, double cores);
  void serve_gpu();
  /// How many of so many cores each of these nodes gets.
  [[nodiscard]] std::vector<double> shares_of(const std::vector<int>& urgent, double cores) const;
  /// Starts those that get a core for the first time; false: none of them was new.
  bool compute_new(const std::vector<int>& urgent, const std::vector<double>& shares);
  void compute(int node);
  /// @param slowdown  By others that use the memory, at least 1.
  void apply_share(int node, double share, double slowdown = 1.0);
  /// The job of `node`, which has been computed, waits for other servers than its node's kernel.
  [[nodiscard]] bool has_moved(int node);
  void schedule_end(int node);
  void advance();
  void set_operating_point(const OperatingPoint& wanted);
  void change_platform();
  void apply(const OperatingPoint& granted);
  void rescale_running_jobs();
  [[nodiscard]] double free_cores() const;
  /// Where the job of `node` runs.
  [[nodiscard]] const Platform& platform_of(int node) const;
  [[nodiscard]] Hertz clock_of(ComputePlace place) const;
  /// The kernel whose price list counts for a node's work.
  [[nodiscard]] const std::string& price_list(int node, const Work& work) const;
  [[nodiscard]] Duration time_on_one_core(int node, const Work& work) const;
  [[nodiscard]] double useful_cores(int node) const;
  /// How many times faster than on one core the node's job is on `cores`.
  [[nodiscard]] double speed_on(int node, double cores) const;
  /// Those whose jobs wait for these servers, or have them.
  [[nodiscard]] std::vector<int> nodes_by_urgency(ComputePlace place) const;
  [[nodiscard]] double busy_cores() const;
  [[nodiscard]] bool is_gpu_busy() const;

  // The edge computer: offloading.cpp.
  void place(int node, bool on_edge);
  [[nodiscard]] ComputePlace place_of(int node) const;
  /// Computes the offloaded jobs that have not begun, and sends what they have read.
  void send_inputs();
  void send_inputs(int node);
  /// The job of `node` has been computed on the edge computer, and its outputs go to the vehicle.
  void send_outputs(int node);
  /// Puts the job of `node` into transit, and calls `then` when it has arrived.
  void travel(int node, MissionTime arrival, void (VirtualComputer::*then)(int node));
  void arrive(int node);
  [[nodiscard]] double input_bytes(int node);

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
  std::optional<EdgeComputer> edge{};
  /// Of each topic. Deques: a listener may add another one while it runs.
  std::vector<std::deque<std::function<void(const Message&)>>> listeners;
  std::function<Message(int topic, const Message&)> filter{};  ///< Empty: all messages pass.
  std::deque<std::function<void(const JobRecord&)>> job_listeners;
  std::deque<std::function<void(int, OnMiss)>> miss_listeners;
  std::uint64_t jobs_released{};
  std::uint64_t dropped_periods{};
  double busy_core_s{};
  double busiest_core_s{};
  double busy_gpu_s{};
  MissionTime advanced_to{};
  MissionTime stalled_until{};
  bool is_dispatch_pending{};
  bool is_stopped{};
};

}  // namespace flyball
