// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Writes a board's settings so that each of them comes back: at the end, on a signal, after a
/// crash or a SIGKILL, and after the next start where even that did not help.

#include "flyball/runtime/board/linux_system.h"
#include "flyball/runtime/result.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// What a file held before anybody of this program wrote to it.
struct KeptSetting {
  std::string path{};
  std::string content{};
};

struct KeeperOptions {
  /// Holds `board.lock` and `board.journal`. Its last part is made where it is missing.
  std::string run_folder{"/run/flyball"};
  /// Take the settings that a session left which ended without restoring them as the ones to
  /// restore in the end. A session that still runs is never adopted.
  bool adopt{};
};

/// The one process that may set this board. Before the first write to a file its content goes to a
/// journal; a second process restores all of it when this one has ended without doing so, whatever
/// ended it. Signals need no handler for that.
class SettingsKeeper {
 public:
  /// Locks the board and starts the process that restores. Open it before other threads start (see
  /// `Watchdog`). `system` outlives the keeper.
  /// @error `unavailable`: another process has the board, or an earlier one left settings
  ///        unrestored and `adopt` is false; `not_found`: there is no folder that this process may
  ///        use; `failed`: the process that restores cannot be started.
  static Result<std::unique_ptr<SettingsKeeper>> open(LinuxSystem& system,
                                                      const KeeperOptions& options);
  /// One that writes nothing, where nothing could be restored; `write` says `why`.
  static std::unique_ptr<SettingsKeeper> closed(LinuxSystem& system, Error why);
  SettingsKeeper(const SettingsKeeper&) = delete;
  SettingsKeeper& operator=(const SettingsKeeper&) = delete;
  ~SettingsKeeper();

  /// Keeps what a file holds, once. Whoever changes several files that depend on each other keeps
  /// all of them first: `scaling_setspeed` has another text under another governor. A file that is
  /// not written afterwards is not restored either: a limit of the clock that is read while the
  /// board is hot is lower than the one that was set, and must not stay so.
  /// @error As `LinuxSystem::read`; `invalid_input`: it is no file of a core.
  Status keep(const std::string& path);

  /// Keeps what the file holds where that has not been done, enters it in the journal and writes.
  /// @error Those of `LinuxSystem::write`; `failed`: the old content could not be kept, and then
  ///        nothing is written; that of `closed`.
  /// @cost  As `LinuxSystem::write`; the first time one read and one append to the journal more.
  Status write(const std::string& path, const std::string& text);

  /// Restores everything, last change first, and goes on after errors: files that refuse are tried
  /// again as long as others succeed, because the kernel wants some of them in an order. Then each
  /// is read back; a clock that reads lower than what the kernel has taken, because heat limits it,
  /// is restored. Afterwards nothing may be written.
  /// @return One error for each file that does not hold what it held; the journal then stays.
  std::vector<Error> restore();

  /// What is restored in the end, in the order of the first writes.
  [[nodiscard]] const std::vector<KeptSetting>& kept() const;
  /// Of the process that restores; 0: there is none.
  [[nodiscard]] pid_t watchdog() const;

 private:
  struct State;
  explicit SettingsKeeper(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Restores these settings; see `SettingsKeeper::restore`.
std::vector<Error> restore_settings(LinuxSystem& system, const std::vector<KeptSetting>& kept);

}  // namespace flyball
