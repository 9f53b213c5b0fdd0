// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Runs a graph: on a modeled computer in mission time, or on threads in real time.

#include "flyball/runtime/edge.h"
#include "flyball/runtime/graph.h"
#include "flyball/runtime/platform.h"

#include <functional>
#include <memory>
#include <vector>

namespace flyball {

/// A message by its place in its topic's history: the first one has version 1, and 0 stands for
/// none.
struct MessageVersion {
  int topic{};
  std::uint64_t version{};
  friend bool operator==(const MessageVersion& a, const MessageVersion& b) {
    return a.topic == b.topic && a.version == b.version;
  }
  friend bool operator!=(const MessageVersion& a, const MessageVersion& b) { return !(a == b); }
};

/// One job from release to end.
struct JobRecord {
  int node{};
  MissionTime released{};
  MissionTime started{};  ///< The same as `ended` when it was killed before it got a core.
  MissionTime ended{};
  Duration busy{};  ///< Core time that it got on board: none on a GPU or an edge computer.
  Work work{};
  bool killed{};  ///< By `OnMiss::skip`.
  bool missed{};  ///< Its deadline.
  /// Host time of the computation, never part of the trace hash: CPU time of its threads on
  /// a modeled computer, and as time passes in real time.
  double host_s{};
  int core{-1};   ///< On which it began; -1: not known, as on a modeled computer.
  Hertz clock{};  ///< That was granted when it began.
  std::vector<MessageVersion> reads{};  ///< In the order in which the body asked.
  /// How often it asked whether to stop before it was told so; all its questions if it never was.
  std::uint64_t questions_before_stop{};
};

/// Its owner's thread constructs it, subscribes and publishes from outside. Listeners are called on
/// that thread, even where jobs run on others. A node runs one job at a time, and its next job sees
/// all that the last one wrote. A job may set and ask for the operating point and ask for loads and
/// drops; all else is for the owner's thread.
class Executor {
 public:
  /// @param pool  Where what is published takes its memory; null: the heap.
  explicit Executor(std::shared_ptr<MessagePool> pool = nullptr) : pool_{std::move(pool)} {}
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  virtual ~Executor() = default;

  /// Publishes from outside the graph (a sensor, the mission) at the present time.
  template <class T>
  void publish(Topic<T> topic, T value) {
    inject(topic.index, make_message(pool_, std::move(value)));
  }
  /// Calls `listener` when a message appears on the topic (the flight controller, a recorder).
  template <class T>
  void subscribe(Topic<T> topic, std::function<void(const T&)> listener) {
    listen(topic.index, [listener = std::move(listener)](const Message& message) {
      listener(*static_cast<const T*>(message.get()));
    });
  }
  /// Calls `filter` with each message before it appears on its topic, and puts its answer there
  /// instead; null: the message is lost. For simulated faults, so that only a modeled computer does
  /// it.
  // NOLINTNEXTLINE(performance-unnecessary-value-param): who does it keeps the function.
  virtual void filter_messages(std::function<Message(int topic, const Message&)> /*filter*/) {}
  virtual void on_job(std::function<void(const JobRecord&)> listener) = 0;
  /// A job passed its deadline, told at that moment, once. Under `skip` it is killed next.
  virtual void on_miss(std::function<void(int node, OnMiss)> listener) = 0;

  /// Running jobs keep their progress and go on at the new rate after the platform's switching
  /// time.
  virtual void set_operating_point(const OperatingPoint& point) = 0;
  /// What is granted, which may be less than was set.
  [[nodiscard]] virtual OperatingPoint operating_point() const = 0;
  /// Jobs of `node` run on the edge computer from the next one on, or on board again. Without an
  /// edge computer all stay on board.
  virtual void place(int /*node*/, bool /*on_edge*/) {}
  /// Of devices beside the cores, as far as they are modeled.
  [[nodiscard]] virtual DeviceUse device_use() const { return {}; }
  /// What the platform grants, or what work costs on it, is different from now on.
  virtual void platform_changed() = 0;
  /// Core-seconds of work done since the start.
  [[nodiscard]] virtual double busy_core_s() const = 0;
  /// The same of the core that worked most. Without a map of jobs to cores, the first core is one
  /// that works whenever anything runs.
  [[nodiscard]] virtual double busiest_core_s() const = 0;
  /// Cores in use right now.
  [[nodiscard]] virtual double busy_cores() const = 0;
  /// Dropped since the start: messages from full queues, triggers of a latest-value topic that were
  /// overtaken before a job read them, and periods that began while their node was busy.
  [[nodiscard]] virtual std::uint64_t drops() const = 0;
  /// The owner's thread calls it before it does what is due at `at`. In real time it returns then,
  /// having told the listeners meanwhile what has happened; on modeled time, at once.
  virtual void serve_until(MissionTime /*at*/) {}
  /// How much later than asked `serve_until` returned at most: by so much the owner's thread was
  /// behind the clock. Zero on modeled time.
  [[nodiscard]] virtual Duration longest_delay() const { return Duration::zero(); }
  /// No job starts from now on; one that runs is waited for. Afterwards the caller may look at what
  /// the nodes own.
  virtual void stop() = 0;
  /// After `stop`: one more job of this node, on the caller's thread, if messages wait that it has
  /// not read, so that a record has its last rows. Its publications are lost. On modeled time
  /// nothing waits then.
  virtual void run_last(int /*node*/) {}

 protected:
  virtual void inject(int topic, Message message) = 0;
  virtual void listen(int topic, std::function<void(const Message&)> listener) = 0;

 private:
  std::shared_ptr<MessagePool> pool_;  ///< Owners: see `PoolAllocator`.
};

}  // namespace flyball
