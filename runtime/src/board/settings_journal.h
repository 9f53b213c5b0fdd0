// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The lock of a board and the journal of what its files held, in a folder that a restart of the
/// machine empties, as it does the settings.

#include "flyball/runtime/board/settings_keeper.h"

#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// Settings stand below this folder. Nothing else is ever restored: others than root may write the
/// journal, and root may be the one who restores.
inline constexpr const char* board_settings = "/sys/devices/system/cpu/";
[[nodiscard]] bool is_board_setting(const std::string& path);

/// Both files, open; the lock is this process's until it is released or all its copies are closed.
class SettingsJournal {
 public:
  /// @error `unavailable`: the folder or its files cannot be made, or another process has the lock.
  static Result<SettingsJournal> lock(const std::string& folder);
  SettingsJournal(SettingsJournal&& other) noexcept;
  SettingsJournal& operator=(SettingsJournal&&) = delete;
  SettingsJournal(const SettingsJournal&) = delete;
  SettingsJournal& operator=(const SettingsJournal&) = delete;
  /// Closes the files and leaves the lock to whoever holds a copy of them.
  ~SettingsJournal();

  /// What is written in it, also by the process that this one is a copy of. A record that was cut
  /// off at the end is left out, because its setting was not written yet, and so is what is no
  /// setting of a board.
  [[nodiscard]] std::vector<KeptSetting> read() const;
  /// @error `failed`: it could not be written.
  Status append(const KeptSetting& kept);
  void clear();
  /// For all copies.
  void unlock();

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::vector<int> descriptors() const { return {lock_, journal_}; }

 private:
  SettingsJournal(int lock, int journal, std::string path);

  int lock_;
  int journal_;
  std::string path_;  ///< Of the journal.
  bool is_broken_{};  ///< It ends with a part of a record that could not be taken back.
};

}  // namespace flyball
