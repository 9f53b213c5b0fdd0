// SPDX-License-Identifier: BSD-3-Clause
// tested-in: mission_energy
#include "map_and_clock.h"

#include "flyball/governors/required_knobs.h"
#include "flyball/governors/required_power.h"

#include <utility>

namespace flyball {
namespace {

// Chosen. A vehicle of 350 W saves at most 1 % in the open. Among obstacles it loses more than
// that, because later maps show the way later: into a building with depth noise, the top clock
// takes .94 [.88, .99] of the energy (n 12).
constexpr double least_saving = 0.02;

}  // namespace

std::vector<ParameterSpec> MapAndClock::parameters() {
  auto all = MapRule::parameters();
  all.push_back(
      {"fine_latency_s", 0.5, 0.001, 60.0, "Sensor to map, 7 m, top clock; learned later."});
  all.push_back({"coarse_latency_s", 0.12, 0.001, 60.0, "The same of the coarse map."});
  all.push_back({"rest_s", 1.0, 0.01, 3600.0,
                 "While the vehicle waits, a map may take so long, unless the mission says."});
  return all;
}

Result<MapAndClock> MapAndClock::make(const std::string& owner,
                                      const Parameters& given,
                                      const KnobSettings& knobs,
                                      const BoardModel& board,
                                      const Result<LearnedLatencySettings>& latency) {
  if (const Status status =
          require_knobs(owner, knobs, {"map.resolution_m", "map.range_m", "cpu.frequency_hz"});
      !status) {
    return status.error();
  }
  const auto power = required_power(owner, board);
  if (!power) {
    return power.error();
  }
  auto map = MapRule::make(owner, given, knobs, board.vehicle);
  if (!map) {
    return map.error();
  }
  if (!latency) {
    return latency.error();
  }
  ClockSearchSettings settings;
  settings.reaction_s = to_seconds(board.vehicle.reaction_time);
  settings.rest_s = given.number("rest_s");
  settings.least_saving = least_saving;
  settings.latency = *latency;
  const auto levels = map->levels(given.number("fine_latency_s"), given.number("coarse_latency_s"));
  auto clock = ClockSearch::make(settings, levels, knobs, *power);
  if (!clock) {
    return Error{ErrorCode::invalid_input, owner + ": " + clock.error().message};
  }
  return MapAndClock{std::move(*map), std::move(*clock)};
}

}  // namespace flyball
