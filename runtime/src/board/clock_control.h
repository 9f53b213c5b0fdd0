// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Sets the clock of one cpufreq policy, in the order that the kernel takes.

#include "flyball/runtime/board/board_file.h"
#include "flyball/runtime/board/board_inventory.h"
#include "flyball/runtime/board/settings_keeper.h"

#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// Where there is the governor `userspace` it is chosen and `scaling_setspeed` written, with the
/// limits moved out of the way. Elsewhere (intel_pstate) both limits are moved to the clock.
class ClockControl {
 public:
  /// @param system  Outlives this, as does `keeper`.
  /// @param clocks  That may be set, ascending: `clocks_of`.
  ClockControl(LinuxSystem& system,
               SettingsKeeper& keeper,
               CpufreqPolicy policy,
               std::vector<Hertz> clocks);

  /// Sets the highest of its clocks that is not above `wanted`, or the lowest, and reads it back.
  /// @error Those of `SettingsKeeper::write`; `failed`: the files hold something else afterwards.
  Status set(Hertz wanted);
  [[nodiscard]] const std::vector<Hertz>& clocks() const { return clocks_; }
  /// Zero before the first `set`.
  [[nodiscard]] Hertz requested() const { return requested_; }
  /// What the driver says (`scaling_cur_freq`); empty: nothing, or all cores are off-line.
  [[nodiscard]] std::optional<Hertz> reported() const;
  /// Whether the last `set` came to its end, so that what it left can be compared.
  [[nodiscard]] bool is_set() const { return set_limits_.has_value(); }
  /// Whether the files still hold what `set` left there; false where it has not come to its end.
  /// True before the first `set`, and while all cores are off-line, when there is nothing to set.
  [[nodiscard]] bool is_as_set() const;
  [[nodiscard]] const CpufreqPolicy& policy() const { return policy_; }

 private:
  struct Limits {
    Hertz min{};
    Hertz max{};
    friend bool operator==(const Limits& a, const Limits& b) {
      return a.min == b.min && a.max == b.max;
    }
  };
  [[nodiscard]] std::string file(const char* name) const { return policy_.folder + "/" + name; }
  [[nodiscard]] std::optional<Limits> limits() const;
  [[nodiscard]] Limits limits_for(Hertz clock, const Limits& now) const;
  Status keep_files();
  Status take_governor();
  Status move_limits(Hertz clock);
  Status verify(Hertz clock);

  LinuxSystem& system_;
  SettingsKeeper& keeper_;
  CpufreqPolicy policy_;
  std::vector<Hertz> clocks_;
  bool is_by_hand_;  ///< By `scaling_setspeed`.
  bool is_kept_{};
  bool was_asked_{};
  Hertz requested_{};
  std::optional<Limits> set_limits_{};
};

/// The clocks that may be asked of a policy, ascending: those that its driver lists, or steps of
/// `board.clock_step`. Not above the limit that was found, which is the power mode's (nvpmodel),
/// and not below what the firmware keeps.
[[nodiscard]] std::vector<Hertz> clocks_of(const CpufreqPolicy& policy, const BoardFile& board);

/// Whether two clocks are different ones, and not one that was measured twice.
[[nodiscard]] bool differ(Hertz a, Hertz b);

/// A measured clock as the board's list has it; a clock that no entry is near stays.
[[nodiscard]] Hertz nearest_listed(Hertz clock, const std::vector<Hertz>& clocks);

/// Whether a clock that is measured on this core tells how fast these let cores run. It does not
/// where the core is none of theirs, and not where they have set different clocks, as they do when
/// some cores cannot run as fast as others. Without any of them it does.
[[nodiscard]] bool tells_set_clock(const std::vector<ClockControl>& controls, int cpu);

/// Gives the policy the limits from before an adopted session changed them.
void undo_adopted(CpufreqPolicy& policy, const std::vector<KeptSetting>& kept);

}  // namespace flyball
