// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How many cores the program's threads may use. The knob is their affinity; switching cores off is
/// only for boards whose file allows it, and when asked.

#include "flyball/runtime/board/board_file.h"
#include "flyball/runtime/board/board_inventory.h"
#include "flyball/runtime/board/settings_keeper.h"
#include "flyball/runtime/time.h"

#include <optional>
#include <string>
#include <vector>

namespace flyball {

class CoreControl {
 public:
  /// @param order  In which cores are taken. Those that are off-line are left out, unless
  /// `unplugs`.
  CoreControl(LinuxSystem& system,
              SettingsKeeper& keeper,
              const std::vector<BoardCore>& cores,
              const std::vector<int>& order,
              bool unplugs);

  [[nodiscard]] int max_cores() const { return static_cast<int>(order_.size()); }
  [[nodiscard]] const std::vector<int>& active() const { return active_; }
  /// The thread gets the affinity of every later change too.
  Status attach(pid_t thread);

  /// Makes the first `count` cores that can be had the active ones, and, where it may, switches on
  /// what that needs; before the clocks are set.
  std::vector<Error> plug_in(int count);
  /// Whether somebody else has switched a core off or on since the last look at it.
  [[nodiscard]] bool has_changed();
  /// Binds all attached threads to the active cores; those that have ended are forgotten.
  std::vector<Error> bind();
  /// Switches off the rest, at most once a second: it takes tens of milliseconds.
  std::vector<Error> unplug_rest(Duration now);

 private:
  struct Core {
    int id{};
    bool is_online{};
    bool has_switch{};
    bool stays{};  ///< It was switched off and is still there.
  };
  Status write_switch(Core& core, bool on);
  [[nodiscard]] bool is_active(int id) const;

  LinuxSystem& system_;
  SettingsKeeper& keeper_;
  std::vector<Core> order_{};
  std::vector<int> active_{};
  std::vector<pid_t> threads_{};
  bool unplugs_;
  std::optional<Duration> unplugged_{};  ///< When, last.
};

/// `cores_in_order` of all that are present, on-line or not.
[[nodiscard]] std::vector<int> core_order_of(const std::vector<BoardCore>& cores,
                                             const BoardFile& board,
                                             bool with_cores_if_asked);

}  // namespace flyball
