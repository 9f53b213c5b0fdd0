// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A real companion computer under Linux, as the governor meets it: sets clocks and cores, reads
/// what was granted, watts and heat, and leaves the board as it found it.

#include "flyball/runtime/board.h"
#include "flyball/runtime/board/board_file.h"
#include "flyball/runtime/board/board_inventory.h"
#include "flyball/runtime/board/settings_keeper.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

struct LinuxBoardOptions {
  BoardFile file{};
  KeeperOptions keeper{};
  bool use_cores_if_asked{};  ///< TX2: the Denver cores too.
  bool unplug_cores{};        ///< Switch idle cores off, where the board's file allows it.
  /// Estimates the power where the board has no meter for it; empty: then it is 0 W.
  std::optional<PowerCost> power_prior{};
  /// The clock of the calling thread's core; empty result: nothing new. Default: a `ClockMeter`,
  /// which counts the threads that are started after `open`.
  std::function<std::optional<Hertz>()> measure_clock{};
};

/// Three answers to how fast the cores run.
struct ClockReport {
  Hertz requested{};                ///< 0: none was set.
  std::optional<Hertz> reported{};  ///< By the driver, which may repeat what was requested.
  /// The last one that could be measured since `requested`, on a core whose clock is set.
  std::optional<Hertz> measured{};
};

/// Not for a real-time thread: all functions but the const ones allocate and make system calls.
/// One thread calls it, the governor's. Open it before other threads start (see `SettingsKeeper`).
class LinuxBoard final : public Board {
 public:
  /// Writes nothing to the board yet. Without a clock that may be set it opens too, and says so in
  /// `notes`; so it does without a folder that may be used for the journal, because a clock that
  /// nothing could restore is not set. `system` outlives the board.
  /// @error Those of `SettingsKeeper::open` except `not_found`; `unavailable`: somebody has locked
  ///        the clocks (both limits are equal) and `keeper.adopt` is false.
  static Result<std::unique_ptr<LinuxBoard>> open(LinuxSystem& system,
                                                  const LinuxBoardOptions& options);
  ~LinuxBoard() override;

  /// Cores, clocks and switching time as found, power as the prior has it.
  [[nodiscard]] BoardModel model() const;

  /// What `refresh` saw last; no system call. `granted` has the measured clock where the reported
  /// one is more than 5 % off it. Work, drops, misses, rotors and battery are the executor's and
  /// the vehicle's to say: they are 0 here, but `busy_core_s`, which is the process's CPU time.
  [[nodiscard]] BoardReading read() const override;
  /// Sets cores and clock, in the order cores on, clocks, threads, cores off. What fails is a note,
  /// and the next reading has what was granted.
  /// @cost  About 10 system calls for each policy: 100 us; a core that is switched: tens of ms.
  void request(const OperatingPoint& point) override;
  /// Reads all meters; sets the clock again where somebody else has changed it.
  /// @param now   Of any clock that only rises.
  /// @cost  About 20 system calls; an INA3221 answers within milliseconds; see also `ClockMeter`.
  void refresh(Duration now);

  [[nodiscard]] ClockReport clock() const;
  /// For people: which meter `computer_power` comes from.
  [[nodiscard]] const std::string& power_source() const;
  /// Cores that jobs may use now, in their order.
  [[nodiscard]] const std::vector<int>& active_cpus() const;
  /// Binds a thread (0: the calling one) to the active cores, now and at every change.
  /// @error Those of `LinuxSystem::set_affinity`.
  Status attach(pid_t thread);
  /// One sentence for each thing that is not as it was asked or said, each once.
  [[nodiscard]] const std::vector<std::string>& notes() const;

  /// Restores everything; the destructor does it too, but cannot say what failed.
  std::vector<Error> close();

 private:
  struct State;
  explicit LinuxBoard(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace flyball
