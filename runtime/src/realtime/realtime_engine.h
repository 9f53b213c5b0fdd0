// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The inside of the real-time executor. Jobs come and go in realtime_jobs.cpp; threads wait, work
/// and keep time in realtime_threads.cpp; what the owner's thread does is in realtime_executor.cpp.

#include "flyball/runtime/realtime/parking.h"
#include "flyball/runtime/realtime/priority_mutex.h"
#include "flyball/runtime/realtime/realtime_executor.h"

#include "message_exchange.h"
#include "node_job.h"
#include "realtime/cpu_meter.h"
#include "realtime/news.h"
#include <atomic>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

namespace flyball {

/// A time that never comes.
inline constexpr MissionTime never{longest_duration};

struct RealtimeNode {
  enum class State { idle, ready, running };
  RealtimeNode(const NodeSpec& spec, const std::shared_ptr<MessagePool>& pool) : job{spec, pool} {}

  State state{State::idle};
  NodeJob job;
  std::size_t lane{};
  MissionTime next_period{never};
  MissionTime deadline{never};    ///< Of the present job; never once it was told.
  MissionTime stuck_from{never};  ///< The same for a job that runs for too long.
};

/// The nodes of one priority, and their threads.
struct Lane {
  int priority{};
  int nodes{};
  std::vector<int> ready{};  ///< In the order of release.
  Parking parking{};
  std::atomic<int> wanted_wakes{};  ///< Raised under the engine's lock, acted on without it.
};

struct RealtimeEngine {
  using Clock = Parking::Clock;
  using Lock = std::unique_lock<PriorityMutex>;

  RealtimeEngine(const Graph& hosted,
                 const RealtimeSettings& chosen,
                 const OperatingPoint& first,
                 const std::shared_ptr<MessagePool>& pool);

  // Jobs; all of them with the lock held.
  void put(int topic, const Message& message, MissionTime now);
  void release(int node, MissionTime at);
  void begin(int node);
  /// Lets the lock go while the job's last actions run.
  void end(int node, Lock& lock);
  void forgo(int node);
  void release_owed(int node);
  void pass_deadline(int node);
  void tell_job(const JobRecord& record);
  void log(RunEvent::Kind kind,
           int index,
           const JobRecord& record,
           const Message& message = {}) const;
  void note_running(int change);
  void wake_timer_for(MissionTime at);

  // Threads.
  void start();
  void work(std::size_t lane);
  void run_body(int node, CpuMeter& meter);
  void keep_time();
  /// Does what is due; returns when the next thing is.
  MissionTime do_what_is_due();
  void begin_period(int node, MissionTime at);
  /// Lets the lock go and wakes the threads that have got something to do.
  void unlock_and_wake(Lock& lock);
  /// From which SCHED_FIFO priority on every thread gets its own; empty: ordinary scheduling.
  [[nodiscard]] std::optional<int> fifo_from();
  /// What the calling thread asks of the system; `level` counts from 0, the most urgent.
  void set_up(const std::string& name, std::size_t level);
  /// On the owner's thread, until the condition holds, which is asked with the lock held; false
  /// when it is `until` first.
  template <class Condition>
  bool wait_for(const Condition& condition, std::optional<Clock::time_point> until);
  /// Of a thread that ends; with the lock held.
  void leave(Lock& lock);
  [[nodiscard]] std::vector<int> active_cpus(int cores) const;
  void stop();
  void wait_for_jobs();
  void tell_jobs_that_run_on() const;

  // The operating point, for any thread.
  void set_point(const std::optional<OperatingPoint>& point);
  [[nodiscard]] OperatingPoint operating_point() const;
  [[nodiscard]] OperatingPoint grant(const OperatingPoint& point) const;
  [[nodiscard]] double cpu_s() const;
  void tell_news();

  [[nodiscard]] MissionTime now() const;
  [[nodiscard]] Clock::time_point host_time(MissionTime at) const;
  [[nodiscard]] const NodeSpec& spec(int node) const { return graph.nodes()[index(node)].spec; }
  [[nodiscard]] static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  const Graph& graph;
  const RealtimeSettings settings;
  std::vector<int> cpus;  ///< For jobs, in the order of use.

  mutable PriorityMutex mutex{};  ///< Of all that follows, down to `is_stopping`.
  MessageExchange exchange;
  std::deque<RealtimeNode> nodes{};
  std::deque<Lane> lanes{};  ///< Most urgent first.
  NewsList news{};
  std::vector<bool> is_listened;  ///< By topic.
  bool has_job_listener{};
  std::uint64_t dropped_periods{};
  int running{};
  MissionTime running_since{};
  Duration busy_for{};           ///< While at least one job ran.
  MissionTime timer_wakes_at{};  ///< What the timer's thread sleeps for.
  std::vector<pid_t> thread_ids{};
  std::vector<clockid_t> cpu_clocks{};
  std::vector<std::string> notes{};
  std::optional<int> fifo{};  ///< What `fifo_from` said.
  std::size_t threads_ready{};
  std::size_t threads_left{};  ///< Have ended, or are about to.
  bool is_stopping{};

  PriorityMutex setting_mutex{};  ///< Of `wanted`: one thread at a time asks the board.
  OperatingPoint wanted;
  mutable PriorityMutex point_mutex{};  ///< Of `granted`.
  const Hertz first_clock;
  OperatingPoint granted;

  Clock::time_point epoch{};
  std::atomic<bool> has_begun{};       ///< From then on `epoch` stands.
  std::atomic<bool> timer_is_early{};  ///< Something is due before the timer's thread wakes.
  std::atomic<bool> has_news{};
  std::atomic<std::int64_t> cpu_ns_of_ended{};  ///< Of threads that have ended.
  Parking timer{};
  Parking owner{};  ///< Sleeps in `serve_until`.

  // The owner's thread only. Deques: a listener may add another one while it runs.
  bool is_started{};
  bool is_stopped{};
  Duration longest_delay{};
  NewsList told{};
  bool is_telling{};
  std::vector<std::deque<std::function<void(const Message&)>>> listeners;
  std::deque<std::function<void(const JobRecord&)>> job_listeners{};
  std::deque<std::function<void(int, OnMiss)>> miss_listeners{};
  std::deque<std::function<void(int, Duration)>> stuck_listeners{};
  std::vector<std::thread> threads{};
};

}  // namespace flyball
