// SPDX-License-Identifier: BSD-3-Clause
// tested-in: mission_energy
#include "limited_search.h"

#include "flyball/governors/required_knobs.h"
#include "flyball/governors/required_power.h"

#include <algorithm>
#include <utility>

namespace flyball {
namespace {

// Chosen. In RoboRun's congestion it is 20 m, in a forest less. With 20 m a spark takes 1.02 of the
// energy in delivery_forest (n 120), and elsewhere the same.
constexpr double between_obstacles_m = 10.0;

}  // namespace

Result<LimitedSearch> LimitedSearch::make(const std::string& owner,
                                          const Parameters& given,
                                          const KnobSettings& knobs,
                                          const BoardModel& board,
                                          Result<EnergySearchSettings> settings) {
  if (const Status status =
          require_knobs(owner, knobs, {"map.resolution_m", "map.range_m", "cpu.frequency_hz"});
      !status) {
    return status.error();
  }
  const auto power = required_power(owner, board);
  if (!power) {
    return power.error();
  }
  auto limits = MissionLimits::make(owner, given, knobs, board.vehicle);
  if (!limits) {
    return limits.error();
  }
  if (!settings) {
    return settings.error();
  }
  settings->reaction_s = to_seconds(board.vehicle.reaction_time);
  settings->spacing_m = std::max(settings->spacing_m, between_obstacles_m);
  const auto levels =
      limits->levels(given.number("fine_latency_s"), given.number("coarse_latency_s"));
  auto search = EnergySearch::make(*settings, levels, limits->ranges_m(), knobs, *power);
  if (!search) {
    return Error{ErrorCode::invalid_input, owner + ": " + search.error().message};
  }
  return LimitedSearch{std::move(*limits), std::move(*search)};
}

}  // namespace flyball
