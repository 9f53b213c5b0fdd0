// SPDX-License-Identifier: BSD-3-Clause
#include "board/clock_control.h"

#include "board/sysfs_text.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace flyball {
namespace {

constexpr double clock_tolerance = 0.05;  // Between two clocks of a TX2 are 7 % and more.

}  // namespace

ClockControl::ClockControl(LinuxSystem& system,
                           SettingsKeeper& keeper,
                           CpufreqPolicy policy,
                           std::vector<Hertz> clocks)
    : system_{system},
      keeper_{keeper},
      policy_{std::move(policy)},
      clocks_{std::move(clocks)},
      is_by_hand_{policy_.has_set_speed()} {}

Status ClockControl::set(Hertz wanted) {
  was_asked_ = true;
  set_limits_.reset();
  Hertz clock = clocks_.empty() ? wanted : clocks_.front();
  for (const Hertz step : clocks_) {
    clock = wanted < step ? clock : step;
  }
  if (Status kept = keep_files(); !kept) {
    return kept;
  }
  if (Status taken = take_governor(); !taken) {
    return taken;
  }
  Status moved = move_limits(clock);
  if (!moved && moved.error().code == ErrorCode::invalid_input) {
    moved = move_limits(clock);  // Somebody else has moved a limit meanwhile: look again.
  }
  if (!moved) {
    return moved;
  }
  if (is_by_hand_) {
    if (Status set = keeper_.write(file("scaling_setspeed"), khz_of(clock)); !set) {
      return set;
    }
  }
  requested_ = clock;
  return verify(clock);
}

/// All of them before the first one is written, because they depend on each other.
Status ClockControl::keep_files() {
  for (const char* name :
       {"scaling_governor", "scaling_min_freq", "scaling_max_freq", "scaling_setspeed"}) {
    const bool is_needed = is_by_hand_ || std::string{name} != "scaling_setspeed";
    if (is_kept_ || !is_needed) {
      continue;
    }
    if (Status kept = keeper_.keep(file(name)); !kept) {
      return kept;
    }
  }
  is_kept_ = true;
  return Done{};
}

/// Each time: the kernel and others may have put another one in its place.
Status ClockControl::take_governor() {
  if (!is_by_hand_ || text_in(system_, file("scaling_governor")) == "userspace") {
    return Done{};
  }
  Status taken = keeper_.write(file("scaling_governor"), "userspace");
  if (!taken && taken.error().code == ErrorCode::invalid_input) {
    is_by_hand_ = false;  // Listed, but not to be had: the limits do it too.
    return Done{};
  }
  return taken;
}

std::optional<ClockControl::Limits> ClockControl::limits() const {
  const auto min = clock_in(system_, file("scaling_min_freq"));
  const auto max = clock_in(system_, file("scaling_max_freq"));
  return min && max ? std::optional{Limits{*min, *max}} : std::nullopt;
}

ClockControl::Limits ClockControl::limits_for(Hertz clock, const Limits& now) const {
  if (!is_by_hand_) {
    return {clock, clock};
  }
  return {std::min(now.min, clock), std::max(now.max, clock)};
}

Status ClockControl::move_limits(Hertz clock) {
  const auto now = limits();
  if (!now) {
    return Error{ErrorCode::not_found, policy_.folder +
                                           " has no limits of its clock; are all its "
                                           "cores off-line?"};
  }
  const Limits wanted = limits_for(clock, *now);
  // The kernel refuses a lower limit above the upper one with EINVAL, also for a moment.
  const bool is_raised = now->max < wanted.max;
  for (const bool is_upper : {is_raised, !is_raised}) {
    const Hertz from = is_upper ? now->max : now->min;
    const Hertz to = is_upper ? wanted.max : wanted.min;
    if (from == to) {
      continue;
    }
    const char* name = is_upper ? "scaling_max_freq" : "scaling_min_freq";
    if (Status written = keeper_.write(file(name), khz_of(to)); !written) {
      return written;
    }
  }
  return Done{};
}

Status ClockControl::verify(Hertz clock) {
  set_limits_ = limits();
  if (is_by_hand_) {
    const auto set = clock_in(system_, file("scaling_setspeed"));
    if (set && *set == clock) {
      return Done{};
    }
    return Error{ErrorCode::failed, file("scaling_setspeed") + " was given " + mhz_of(clock) +
                                        " and holds " + (set ? mhz_of(*set) : "no clock")};
  }
  if (set_limits_ && *set_limits_ == Limits{clock, clock}) {
    return Done{};
  }
  return Error{ErrorCode::failed,
               policy_.folder + " was limited to " + mhz_of(clock) + " and allows " +
                   (set_limits_ ? mhz_of(set_limits_->min) + " to " + mhz_of(set_limits_->max)
                                : "no clock")};
}

std::optional<Hertz> ClockControl::reported() const {
  return clock_in(system_, file("scaling_cur_freq"));
}

bool ClockControl::is_as_set() const {
  const auto now = limits();
  if (!was_asked_ || !now) {
    return true;
  }
  const bool is_governed =
      !is_by_hand_ || text_in(system_, file("scaling_governor")) == "userspace";
  return is_governed && now == set_limits_;
}

std::vector<Hertz> clocks_of(const CpufreqPolicy& policy, const BoardFile& board) {
  const Hertz lowest = std::max(policy.lowest, board.lowest_kept_clock);
  std::vector<Hertz> all = policy.frequencies;
  if (all.empty()) {
    const double step_hz = board.clock_step.value();
    const auto first = static_cast<int>(std::ceil(lowest.value() / step_hz));
    const auto last = static_cast<int>(std::floor(policy.max.value() / step_hz));
    for (int i = first; i <= last; ++i) {
      all.emplace_back(step_hz * i);
    }
    if (all.empty() || all.back() < policy.max) {
      all.push_back(policy.max);
    }
  }
  std::vector<Hertz> clocks;
  for (const Hertz clock : all) {
    if (!(clock < lowest) && !(policy.max < clock)) {
      clocks.push_back(clock);
    }
  }
  return clocks.empty() ? std::vector{policy.max} : clocks;
}

bool differ(Hertz a, Hertz b) {
  return std::abs(a.value() - b.value()) > clock_tolerance * b.value();
}

Hertz nearest_listed(Hertz clock, const std::vector<Hertz>& clocks) {
  for (const Hertz step : clocks) {
    if (std::abs(clock.value() - step.value()) < 0.5 * clock_tolerance * step.value()) {
      return step;
    }
  }
  return clock;
}

bool tells_set_clock(const std::vector<ClockControl>& controls, int cpu) {
  const ClockControl* first = nullptr;
  bool is_theirs = controls.empty();
  bool is_one_clock = true;
  for (const ClockControl& control : controls) {
    const std::vector<int>& cpus = control.policy().cpus;
    is_theirs = is_theirs || cpus.empty() || std::find(cpus.begin(), cpus.end(), cpu) != cpus.end();
    if (control.is_set()) {
      first = first == nullptr ? &control : first;
      is_one_clock = is_one_clock && !differ(control.requested(), first->requested());
    }
  }
  return is_theirs && is_one_clock;
}

void undo_adopted(CpufreqPolicy& policy, const std::vector<KeptSetting>& kept) {
  for (const KeptSetting& setting : kept) {
    const auto clock = clock_of(trimmed(setting.content));
    if (clock && setting.path == policy.folder + "/scaling_min_freq") {
      policy.min = *clock;
    } else if (clock && setting.path == policy.folder + "/scaling_max_freq") {
      policy.max = *clock;
    }
  }
}

}  // namespace flyball
