// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The computer that the program runs on, as a governor in flight meets it: a board and an executor
/// put together.

#include "flyball/runtime/board/linux_board.h"
#include "flyball/runtime/executor.h"
#include "flyball/runtime/node_meter.h"

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace flyball {

/// Clocks, watts and heat come from the board, cores, loads, drops and misses from the executor,
/// rotors and battery from whoever talks with the vehicle. Any thread may use it: the board is a
/// thing for one thread, and a lock makes this one that thread.
///
///     auto board = LinuxBoard::open(*system, options);  // Restores the settings when it goes.
///     RealtimeBoard computer{**board};
///     RealtimeSettings settings;
///     settings.cpus = (*board)->active_cpus();  // In the order of the board's file.
///     settings.grant = [&](const OperatingPoint& wanted) { return computer.grant(wanted); };
///     RealtimeExecutor executor{graph, start, settings};
///     computer.connect(executor);
///     // then every tenth of a second or so: computer.refresh(executor.now().time_since_epoch());
class RealtimeBoard final : public Board {
 public:
  /// The board outlives this one.
  explicit RealtimeBoard(LinuxBoard& board) : board_{board} {}

  /// Sets the board's clock, and says what it granted: for `RealtimeSettings::grant`.
  [[nodiscard]] OperatingPoint grant(const OperatingPoint& wanted);
  /// Where loads come from and requests go; the executor outlives this one. Before, nothing is
  /// asked of the board.
  void connect(Executor& executor);
  /// What the vehicle's autopilot reports.
  void set_vehicle(Watts rotor_power, double battery_percent);
  /// Reads all meters, and tells the executor when another clock is granted than before. Some of
  /// them take milliseconds: not for a thread that has something urgent to do.
  /// @param now  Of any clock that only rises.
  void refresh(Duration now);
  /// What the board has not done as it was asked, or says beside, since the last call.
  [[nodiscard]] std::vector<std::string> take_notes();

  /// What the board's own meters said last: clock, watts and heat. Asks neither board nor executor.
  [[nodiscard]] BoardReading meters() const;
  [[nodiscard]] BoardReading read() const override;
  [[nodiscard]] NodeUse use_of(int node) const override { return nodes_.of(node); }
  void request(const OperatingPoint& point) override;

 private:
  LinuxBoard& board_;
  std::atomic<Executor*> executor_{};
  std::atomic<std::uint64_t> deadline_misses_{};
  NodeMeter nodes_{};
  std::mutex board_mutex_{};  ///< Of `board_` and the next two.
  OperatingPoint requested_{0, {}};
  std::size_t told_{};          ///< So many of the board's notes have been taken.
  mutable std::mutex mutex_{};  ///< Of what follows; never held while the board is asked.
  BoardReading last_{};         ///< Of the board.
  Watts rotor_power_{};
  double battery_percent_{};
};

}  // namespace flyball
