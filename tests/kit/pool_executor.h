// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Runs a graph's jobs on threads in arbitrary order: for tests that nodes share nothing but
/// messages.

#include "flyball/runtime/event_queue.h"
#include "flyball/runtime/executor.h"

#include <memory>
#include <set>
#include <string>
#include <utility>

namespace flyball::kit {

struct PoolSettings {
  int threads{4};
  std::uint64_t seed{1};  ///< Of the order in which ready jobs are taken.
  /// The queue waits this often for the jobs that are due, so that the simulator does not run away
  /// from them.
  Duration slice{std::chrono::milliseconds{20}};
  /// A job may go on while so many slices more pass; how many is drawn for each job. A job with a
  /// deadline keeps it.
  int most_slices_more{4};
  /// Where `stop` says which pairs of nodes have run jobs at the same time, the names of each pair
  /// in order; null: nowhere. Outlives the executor.
  std::set<std::pair<std::string, std::string>>* overlaps{};
};

/// The thread that steps the queue publishes from outside, fires the periods and calls the
/// listeners; what jobs have published reaches listeners at the end of the slice. Jobs compute on
/// the pool's threads meanwhile. Each sees its messages as they were when it began, and takes the
/// pool's lock only before and after its body, so that a thread sanitizer finds no order between
/// two jobs that overlap. The order of jobs is not repeatable. Work costs nothing: no job is late,
/// and the meters of load stand still.
class PoolExecutor final : public Executor {
 public:
  /// Graph, platform and queue outlive the executor.
  PoolExecutor(const Graph& graph,
               const Platform& platform,
               EventQueue& queue,
               const OperatingPoint& point,
               const PoolSettings& settings = {});
  ~PoolExecutor() override;
  PoolExecutor(const PoolExecutor&) = delete;
  PoolExecutor& operator=(const PoolExecutor&) = delete;

  /// Waits until no job runs or is owed, and tells the listeners all that was published.
  void settle();

  void on_job(std::function<void(const JobRecord&)> listener) override;
  /// Never called.
  void on_miss(std::function<void(int node, OnMiss)> listener) override;
  /// Granted at the end of the slice.
  void set_operating_point(const OperatingPoint& point) override;
  [[nodiscard]] OperatingPoint operating_point() const override;
  void platform_changed() override;
  [[nodiscard]] double busy_core_s() const override { return 0.0; }
  [[nodiscard]] double busiest_core_s() const override { return 0.0; }
  [[nodiscard]] double busy_cores() const override { return 0.0; }
  [[nodiscard]] std::uint64_t drops() const override;
  void stop() override;

 protected:
  void inject(int topic, Message message) override;
  void listen(int topic, std::function<void(const Message&)> listener) override;

 private:
  struct Pool;
  /// Owners: this, and for its duration an event that runs; the queue outlives the executor.
  std::shared_ptr<Pool> pool_;
};

}  // namespace flyball::kit
