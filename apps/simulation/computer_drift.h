// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The companion computer as it truly is in flight: the scenario's events, and its heat.

#include "flyball/runtime/modeled/drifting_platform.h"
#include "flyball/runtime/modeled/virtual_executor.h"
#include "flyball/runtime/thermal.h"

#include "simulation/closed_loop.h"
#include "simulation/mission_link.h"
#include <cstdint>
#include <optional>
#include <string>

namespace flyball {

/// Nothing on board is told of events: governors see the granted clock, latencies, the load, and
/// the temperature.
class ComputerDrift {
 public:
  /// All arguments outlive the drift; `executor` runs on `platform`.
  ComputerDrift(MissionLink& link,
                const Scenario& scenario,
                DriftingPlatform& platform,
                Executor& executor,
                EventQueue& queue,
                const ClosedLoop& loop);

  /// @param thermal  Of the platform's file; empty: it never gets too hot.
  void start(const std::optional<ThermalModel>& thermal);

  /// How often a trip took clocks away.
  [[nodiscard]] std::uint64_t throttle_events() const { return throttle_events_; }
  [[nodiscard]] std::optional<double> hottest_c() const;
  /// What a board's own sensor and its list of trips say; null for a computer that never gets too
  /// hot.
  [[nodiscard]] const ThermalState* heat() const { return heat_ ? &*heat_ : nullptr; }

 private:
  void schedule(const ComputerEvent& event);
  void change(const ComputerEvent& event, bool begins);
  void strain();
  void cool();
  void heat_step();
  void obey_trips();

  MissionLink& link_;
  const Scenario& scenario_;
  DriftingPlatform& platform_;
  Executor& executor_;
  EventQueue& queue_;
  const ClosedLoop& loop_;
  std::optional<ThermalModel> nominal_{};
  std::optional<ThermalState> heat_{};
  double last_energy_j_{};
  std::optional<Hertz> cap_{};
  std::uint64_t throttle_events_{};
  std::uint64_t steps_{};
};

}  // namespace flyball
