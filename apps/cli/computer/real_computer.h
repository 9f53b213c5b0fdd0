// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What runs a mission's nodes: a modeled computer, or the one that the command runs on.

#include "flyball/runtime/board/board_file.h"
#include "flyball/runtime/board/linux_board.h"
#include "flyball/runtime/board/linux_system.h"
#include "flyball/runtime/realtime/realtime_board.h"
#include "flyball/runtime/result.h"
#include "flyball/simulation/mission.h"

#include <memory>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): not ours
class App;
}  // namespace CLI

namespace flyball {

struct ExecutorOptions {
  std::string executor{"virtual"};
  int fifo_priority{};  ///< 0: ordinary scheduling.
  bool sets_clocks{};
};

/// Adds `--executor`, `--fifo` and `--set-clocks`.
void add_executor(CLI::App& command, ExecutorOptions& options);

/// The shipped file of this name, or, without a name, the one that names this model. A PC that no
/// file names is `generic_x86`, and any other computer is described by an empty file.
/// @error `not_found`: no shipped file has this name; those of `load_board_file`.
[[nodiscard]] Result<BoardFile> choose_board(const std::string& name, const std::string& model);

/// The cores of the board's file, in its order, as far as the process may use them; all that it may
/// use where the file names none.
[[nodiscard]] std::vector<int> cores_for_jobs(const BoardFile& board);

/// This computer, if the options ask for it. Its settings are restored when it goes.
class RealComputer {
 public:
  /// Before other threads start. For a modeled computer it does nothing.
  /// @error `invalid_input`: an option that a modeled computer has no use for; those of
  ///        `LinuxBoard::open`.
  /// @param expected  What the policy is told of the computer: says on standard error where this
  ///                  one has other clocks, and estimates the power where it has no meter.
  static Result<std::unique_ptr<RealComputer>> open(const ExecutorOptions& options,
                                                    const PlatformModel& expected);

  /// Makes the mission fly on it; outlives the flight.
  void equip(MissionHooks& hooks);
  /// Tells on standard error what was not as it was asked, and what could not be restored.
  void close();

 private:
  explicit RealComputer(ExecutorOptions options) : options_{std::move(options)} {}
  Status open_board(const PlatformModel& expected);
  void tell_notes();

  ExecutorOptions options_;
  BoardFile file_{};
  std::unique_ptr<LinuxSystem> system_{};
  std::unique_ptr<LinuxBoard> board_{};
  std::unique_ptr<RealtimeBoard> shared_board_{};  ///< Null: its clock is left alone.
};

}  // namespace flyball
