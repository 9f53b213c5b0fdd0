// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The one ordered queue that physics, sensors, jobs and the governor share.

#include "flyball/runtime/time.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace flyball {

/// At equal times: physics first, then sensors, then jobs that end, then what starts.
enum class EventOrder : std::uint8_t { physics, sensor, job, trigger, governor, observer };

class EventQueue {
 public:
  using Action = std::function<void()>;

  [[nodiscard]] MissionTime now() const { return now_; }
  /// @pre `at` is not before `now()`.
  void schedule(MissionTime at, EventOrder order, Action action);
  /// When the next event is due; empty when there is none.
  [[nodiscard]] std::optional<MissionTime> next() const {
    return events_.empty() ? std::nullopt : std::optional{events_.front().at};
  }
  /// Runs the next event; false when there is none.
  bool step();
  /// Runs events until `done()` or none is left. `done` is asked after each event.
  void run(const std::function<bool()>& done);
  /// Runs `action` every `period`, first at `first`, for as long as the queue runs.
  /// @pre `period > 0`; `first` is not before `now()`.
  void every(MissionTime first, Duration period, EventOrder order, Action action);

 private:
  struct Event {
    MissionTime at;
    EventOrder order;
    std::uint64_t sequence;
    Action action;
  };
  struct Later {
    bool operator()(const Event& a, const Event& b) const;
  };
  std::vector<Event> events_;  ///< A heap: std::priority_queue cannot move its top out.
  MissionTime now_{};
  std::uint64_t sequence_{};
};

}  // namespace flyball
