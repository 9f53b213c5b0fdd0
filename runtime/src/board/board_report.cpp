// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board/board_report.h"

#include "flyball/runtime/board/clock_meter.h"
#include "flyball/runtime/text/listed.h"
#include "flyball/runtime/text/number_text.h"

#include "board/board_meters.h"
#include "board/clock_control.h"
#include "board/core_control.h"
#include "board/sysfs_text.h"
#include <algorithm>
#include <cstdio>

namespace flyball {
namespace {

constexpr const char* way_out = "run as root, or see: flyball board setup --print";

std::string line(const std::string& name, const std::string& text) {
  std::string padded = name;
  padded.resize(std::max<std::size_t>(name.size() + 1, 13), ' ');
  return padded + text + "\n";
}

constexpr int meter_digits = 4;

/// "may be set", or which file stands in the way.
std::string permission(const LinuxSystem& system, const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    if (const Status may = system.may_write(file); !may) {
      return "may not be set: " + may.error().message + "; " + way_out;
    }
  }
  return "may be set";
}

std::string clock_line(const LinuxSystem& system,
                       const CpufreqPolicy& policy,
                       const BoardFile& board) {
  const std::vector<Hertz> clocks = clocks_of(policy, board);
  std::string text = "cores " + listed(policy.cpus) + ": " + std::to_string(clocks.size()) +
                     " from " + mhz_of(clocks.front()) + " to " + mhz_of(clocks.back()) + " (" +
                     policy.driver + ", " + policy.governor + "), ";
  std::vector<std::string> files{policy.folder + "/scaling_min_freq",
                                 policy.folder + "/scaling_max_freq"};
  if (policy.has_set_speed()) {
    files.push_back(policy.folder + "/scaling_governor");
    files.push_back(policy.folder + "/scaling_setspeed");
  }
  text += permission(system, files);
  if (policy.has_set_speed()) {
    return text;
  }
  return text + "; by both limits, because there is no governor \"userspace\"";
}

std::string core_line(const BoardInventory& found, const BoardFile& board) {
  std::vector<int> on;
  std::vector<int> off;
  for (const BoardCore& core : found.cores) {
    (core.is_online ? on : off).push_back(core.id);
  }
  std::string text = listed(on) + " on-line";
  text += off.empty() ? "" : "; " + listed(off) + " off-line";
  text += "; taken in the order " + listed(core_order_of(found.cores, board, false));
  // No command of this program asks for either (`LinuxBoardOptions`).
  text += board.cores_if_asked.empty()
              ? ""
              : "; a program of your own may ask for " + listed(board.cores_if_asked) + " too";
  return text + (board.may_unplug_cores ? "; a program of your own may have idle ones switched off"
                                        : "; are never switched off on this board");
}

std::string heat_line(const LinuxSystem& system,
                      const BoardInventory& found,
                      const BoardFile& board) {
  const auto heat = closest_heat(system, found.zones, board);
  if (!heat) {
    return "no thermal zone can be read";
  }
  return heat->zone + " " + short_number_text(heat->temperature_c, meter_digits) + " C" +
         (heat->trip_c ? ", takes clocks away from " +
                             short_number_text(*heat->trip_c, meter_digits) + " C on"
                       : ", without a trip that takes clocks away");
}

std::string power_line(const LinuxSystem& system,
                       const BoardInventory& found,
                       const BoardFile& board) {
  const PowerMeter meter{system, found, board};
  if (meter.source().empty()) {
    const bool has_hidden = !found.counters.empty();
    return has_hidden
               ? "not measured: " + found.counters.front().file + " may not be read; " + way_out
               : "not measured: there is no input rail (VDD_IN, VIN) and no RAPL";
  }
  return "by " + meter.source();
}

std::string rails_line(const LinuxSystem& system, const BoardInventory& found) {
  return listed(found.rails, [&system](const PowerRail& rail) {
    const auto power = rail_power(system, rail);
    return rail.label + " " +
           (power ? short_number_text(power->value(), meter_digits) + " W" : "cannot be read");
  });
}

}  // namespace

std::string board_report(const LinuxSystem& system,
                         const BoardInventory& found,
                         const BoardFile& board) {
  std::string text;
  text += line("board", board.name + (found.model.empty() ? "" : " (" + found.model + ")") +
                            (found.kernel.empty() ? "" : ", Linux " + found.kernel));
  for (const CpufreqPolicy& policy : found.policies) {
    text += line("clock", clock_line(system, policy, board));
  }
  if (found.policies.empty()) {
    text += line("clock",
                 "may not be set: no cpufreq folder below /sys/devices/system/cpu (a virtual "
                 "machine, or no driver for this processor)");
  }
  text += line("cores", core_line(found, board));
  text += line("clock meter", ClockMeter{board.cycles_per_addition}.source());
  text += line("power", power_line(system, found, board));
  if (!found.rails.empty()) {
    text += line("rails", rails_line(system, found));
  }
  text += line("heat", heat_line(system, found, board));
  for (const Rival& rival : found.rivals) {
    text += line("rival", rival.name + " (process " + std::to_string(rival.pid) +
                              ") sets clocks too; " + rival.advice);
  }
  return text;
}

std::string board_setup_script() {
  return R"(#!/bin/sh
# Run as root: lets members of the group "flyball" set clocks and cores, read energy counters, lock
# memory and use real-time priorities. Log in anew afterwards.
set -eu
groupadd --system --force flyball
usermod --append --groups flyball "${SUDO_USER:-$(id -un)}"

# The kernel makes these files anew when a core comes on-line, so that a rule of udev is needed. It comes
# after 80-drivers.rules, which loads drivers that are modules; others come with a device of their own.
cat > /etc/udev/rules.d/99-flyball.rules <<'END'
ACTION=="add|online|change", SUBSYSTEM=="cpu", ENV{.FLYBALL_CLOCKS}="1"
ACTION=="bind", SUBSYSTEM=="platform", DRIVER=="*cpufreq*", ENV{.FLYBALL_CLOCKS}="1"
ENV{.FLYBALL_CLOCKS}=="1", RUN+="/bin/sh -c 'cd /sys/devices/system/cpu; chgrp -f flyball cpu*/online cpu*/cpufreq/scaling_governor cpu*/cpufreq/scaling_min_freq cpu*/cpufreq/scaling_max_freq cpu*/cpufreq/scaling_setspeed; chmod -f g+w cpu*/online cpu*/cpufreq/scaling_governor cpu*/cpufreq/scaling_min_freq cpu*/cpufreq/scaling_max_freq cpu*/cpufreq/scaling_setspeed'"
ACTION=="add|change", SUBSYSTEM=="powercap", RUN+="/bin/sh -c 'cd /sys/class/powercap; chgrp -f flyball */energy_uj; chmod -f g+r */energy_uj'"
END
udevadm control --reload
udevadm trigger --action=change --subsystem-match=cpu --subsystem-match=powercap

# Lock and journal of the board's settings, also those that root has made before.
printf 'd /run/flyball 2775 root flyball -\nz /run/flyball/board.* 0660 - flyball -\n' > /etc/tmpfiles.d/flyball.conf
systemd-tmpfiles --create /etc/tmpfiles.d/flyball.conf

# Real-time priorities and locked memory for the group; for everybody, cycles of their own programs.
printf '@flyball - rtprio 80\n@flyball - memlock unlimited\n' > /etc/security/limits.d/70-flyball.conf
echo 'kernel.perf_event_paranoid = 1' > /etc/sysctl.d/70-flyball.conf
sysctl --load=/etc/sysctl.d/70-flyball.conf
)";
}

}  // namespace flyball
