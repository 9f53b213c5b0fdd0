// SPDX-License-Identifier: BSD-3-Clause
// tested-in: tournament

#include "studies/tournament_figures.h"

#include <algorithm>
#include <iterator>
#include <map>

namespace flyball {
namespace {

using Flights = std::vector<const Summary*>;

/// The succeeded flights of a policy, in the order of their seeds.
Flights flights_of(const std::vector<Summary>& all, const std::string& policy) {
  Flights found;
  for (const Summary& flight : all) {
    if (flight.policy == policy && has_succeeded(flight)) {
      found.push_back(&flight);
    }
  }
  return found;
}

template <class Quantity>
std::optional<MedianInterval> median_over(const Flights& flights, Quantity quantity) {
  std::vector<double> values;
  values.reserve(flights.size());
  for (const Summary* flight : flights) {
    values.push_back(quantity(*flight));
  }
  return bootstrap_median(values);
}

std::optional<MedianInterval> over_bound(const Flights& flights, const KnownBounds& bounds) {
  std::vector<double> ratios;
  for (const Summary* flight : flights) {
    const auto least_j = bounds.find({flight->scenario, flight->seed});
    if (least_j != bounds.end() && least_j->second > 0.0) {
      ratios.push_back(flight->energy_total_j() / least_j->second);
    }
  }
  return bootstrap_median(ratios);
}

/// Empty where nothing is known of the computer's heat.
std::optional<std::uint64_t> throttle_events(const Flights& flights) {
  std::optional<std::uint64_t> count;
  for (const Summary* flight : flights) {
    if (flight->hottest_c) {
      count = count.value_or(0) + flight->throttle_events;
    }
  }
  return count;
}

}  // namespace

DecisionFigures decisions_of(const std::vector<Summary>& flights,
                             const std::string& policy,
                             const KnownBounds& bounds) {
  const Flights succeeded = flights_of(flights, policy);
  DecisionFigures figures;
  figures.policy = policy;
  Flights mapping;  // The others have no maps that could be late.
  std::copy_if(succeeded.begin(), succeeded.end(), std::back_inserter(mapping),
               [](const Summary* flight) { return flight->maps > 0; });
  figures.overrun_percent = median_over(mapping, [](const Summary& s) {
    return 100.0 * static_cast<double>(s.bound_overruns) / static_cast<double>(s.maps);
  });
  figures.budget_use = median_over(mapping, [](const Summary& s) { return s.budget_use_p50; });
  figures.decision_us =
      median_over(succeeded, [](const Summary& s) { return s.decision_host_us_p99; });
  figures.over_bound = over_bound(succeeded, bounds);
  figures.throttle_events = throttle_events(succeeded);
  return figures;
}

PairedDifference difference_of(const std::vector<Summary>& flights, const PolicyPair& pair) {
  std::map<std::uint64_t, const Summary*> others;
  for (const Summary* flight : flights_of(flights, pair.to)) {
    others[flight->seed] = flight;
  }
  PairedDifference difference;
  difference.policy = pair.policy;
  difference.to = pair.to;
  std::vector<double> time_s;
  std::vector<double> energy_j;
  std::vector<double> battery;
  std::vector<double> percent;
  std::vector<double> computer;
  for (const Summary* flight : flights_of(flights, pair.policy)) {
    const auto found = others.find(flight->seed);
    if (found == others.end()) {
      continue;
    }
    const Summary& other = *found->second;
    time_s.push_back(flight->mission_time_s - other.mission_time_s);
    energy_j.push_back(flight->energy_total_j() - other.energy_total_j());
    battery.push_back(flight->battery_used_percent() - other.battery_used_percent());
    percent.push_back(100.0 * energy_j.back() / other.energy_total_j());
    if (other.energy_computer_j > 0.0) {
      computer.push_back(100.0 * (flight->energy_computer_j / other.energy_computer_j - 1.0));
    }
    difference.wins += energy_j.back() < 0.0 ? 1 : 0;
  }
  difference.pairs = static_cast<int>(energy_j.size());
  difference.time_s = bootstrap_median(time_s);
  difference.energy_j = bootstrap_median(energy_j);
  difference.battery_percent = bootstrap_median(battery);
  difference.energy_percent = bootstrap_median(percent);
  difference.computer_percent = bootstrap_median(computer);
  return difference;
}

std::vector<BoundFigures> bound_figures(const std::vector<Summary>& flights,
                                        const std::string& policy) {
  std::map<double, BoundFigures> levels;
  for (const Summary& flight : flights) {
    for (const LevelBounds& level : flight.latency_bounds) {
      if (flight.policy != policy || level.issued == 0) {
        continue;
      }
      BoundFigures& figures = levels[level.resolution_m];
      const bool is_bounded = level.most_late && (figures.issued == 0 || figures.most_late);
      figures.most_late = is_bounded
                              ? std::optional{figures.most_late.value_or(0.0) + *level.most_late}
                              : std::nullopt;
      figures.policy = policy;
      figures.resolution_m = level.resolution_m;
      figures.issued += level.issued;
      figures.late += level.late;
    }
  }
  std::vector<BoundFigures> all;
  all.reserve(levels.size());
  for (const auto& [resolution_m, figures] : levels) {
    all.push_back(figures);
  }
  return all;
}

}  // namespace flyball
