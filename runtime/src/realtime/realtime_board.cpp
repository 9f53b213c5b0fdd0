// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/realtime/realtime_board.h"

namespace flyball {

OperatingPoint RealtimeBoard::grant(const OperatingPoint& wanted) {
  const std::lock_guard board{board_mutex_};
  // The platform asks again when the board has changed by itself: that is no request of ours.
  if (wanted != requested_) {
    requested_ = wanted;
    board_.request(wanted);  // It has read the clock and the cores again, but not the meters.
  }
  const std::lock_guard lock{mutex_};
  last_ = board_.read();
  return last_.granted;
}

void RealtimeBoard::connect(Executor& executor) {
  executor.on_miss([this](int, OnMiss) { ++deadline_misses_; });
  nodes_.connect(executor);
  executor_ = &executor;
}

void RealtimeBoard::set_vehicle(Watts rotor_power, double battery_percent) {
  const std::lock_guard lock{mutex_};
  rotor_power_ = rotor_power;
  battery_percent_ = battery_percent;
}

void RealtimeBoard::refresh(Duration now) {
  bool has_changed{};
  {
    const std::lock_guard board{board_mutex_};
    board_.refresh(now);
    const BoardReading seen = board_.read();
    const std::lock_guard lock{mutex_};
    has_changed = seen.granted != last_.granted;
    last_ = seen;
  }
  if (Executor* executor = executor_; has_changed && executor != nullptr) {
    executor->platform_changed();
  }
}

std::vector<std::string> RealtimeBoard::take_notes() {
  const std::lock_guard board{board_mutex_};
  const std::vector<std::string>& all = board_.notes();
  std::vector<std::string> fresh{all.begin() + static_cast<std::ptrdiff_t>(told_), all.end()};
  told_ = all.size();
  return fresh;
}

BoardReading RealtimeBoard::meters() const {
  const std::lock_guard lock{mutex_};
  return last_;
}

BoardReading RealtimeBoard::read() const {
  BoardReading reading;
  {
    const std::lock_guard lock{mutex_};
    reading = last_;
    reading.rotor_power = rotor_power_;
    reading.battery_percent = battery_percent_;
  }
  if (const Executor* executor = executor_) {
    reading.granted = executor->operating_point();
    reading.busy_core_s = executor->busy_core_s();
    reading.busiest_core_s = executor->busiest_core_s();
    reading.drops = executor->drops();
    reading.deadline_misses = deadline_misses_;
  }
  return reading;
}

void RealtimeBoard::request(const OperatingPoint& point) {
  if (Executor* executor = executor_) {
    executor->set_operating_point(point);
  }
}

}  // namespace flyball
