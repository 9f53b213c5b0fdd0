// SPDX-License-Identifier: BSD-3-Clause

#include "experiments/framework/evidence.h"

#include "flyball/runtime/assert.h"
#include "flyball/studies/hindsight.h"

#include "studies/sweep/flight_figures.h"
#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

Measured measured_of(const std::vector<double>& values) {
  return {bootstrap_median(values), static_cast<int>(values.size())};
}

/// The point's numbers by seed.
std::map<std::uint64_t, double> by_seed(const Point& point, const FlightFigure& of) {
  std::map<std::uint64_t, double> values;
  for (const Summary* flight : point.flights) {
    const bool counts = point.counts_failed || has_succeeded(*flight);
    if (const auto value = counts ? of(*flight) : std::nullopt) {
      values[flight->seed] = *value;
    }
  }
  return values;
}

constexpr double normal_95 = 1.959964;  // 95 % of the normal distribution are between both ends.

struct Lives {
  double time_s{};
  double losses{};
};

Lives lives_of(const Point& point,
               const FlightFigure& time_s,
               const std::function<bool(const Summary&)>& ends_in_loss) {
  Lives lives;
  for (const Summary* flight : point.flights) {
    if (const auto seen_s = time_s(*flight)) {
      lives.time_s += *seen_s;
      lives.losses += ends_in_loss(*flight) ? 1.0 : 0.0;
    }
  }
  return lives;
}

}  // namespace

FlightFigure flight_figure(const std::string& figure) {
  return [figure](const Summary& flight) -> std::optional<double> {
    for (const auto& [name, value] : figures_of(flight)) {
      if (name == figure) {
        return value;
      }
    }
    return std::nullopt;
  };
}

const Sweep& Evidence::sweep(const std::string& name) const {
  const auto found = sweeps_.find(name);
  FLYBALL_ASSERT(found != sweeps_.end(), "no sweep \"%s\"", name.c_str());
  return found->second;
}

Point Evidence::at(const std::string& name,
                   const std::vector<std::string>& values,
                   const std::string& policy) const {
  const Sweep& flown = sweep(name);
  const auto& cells = flown.cells;
  const auto cell = std::find_if(cells.begin(), cells.end(), [&](const SweepCell& each) {
    return each.point.values == values && (policy.empty() || each.point.policy == policy);
  });
  FLYBALL_ASSERT(cell != cells.end(), "sweep \"%s\" has no such point", name.c_str());
  Point point;
  for (const SweepFlight& flight : flown.flights) {
    if (flight.point == static_cast<std::size_t>(cell - cells.begin())) {
      point.flights.push_back(&flight.summary);
    }
  }
  return point;
}

std::string best_in_hindsight(const Evidence& evidence,
                              const std::string& sweep,
                              const std::vector<std::string>& values,
                              const std::string& policy) {
  FLYBALL_ASSERT(!values.empty(), "no values of %s", sweep.c_str());
  const auto flown = [&](const std::string& value) {
    Candidate candidate;
    for (const Summary* flight : evidence.at(sweep, {value}, policy).flights) {
      candidate.flights.push_back(*flight);
    }
    return candidate;
  };
  return *std::min_element(values.begin(), values.end(), [&](const auto& a, const auto& b) {
    return is_better_in_hindsight(flown(a), flown(b));
  });
}

Measured median(const Point& point, const FlightFigure& of) {
  std::vector<double> values;
  for (const auto& [seed, value] : by_seed(point, of)) {
    values.push_back(value);
  }
  return measured_of(values);
}

Measured ratio(const Point& over, const Point& under, const FlightFigure& of) {
  const auto below = by_seed(under, of);
  std::vector<double> ratios;
  for (const auto& [seed, value] : by_seed(over, of)) {
    if (const auto found = below.find(seed); found != below.end() && found->second > 0.0) {
      ratios.push_back(value / found->second);
    }
  }
  return measured_of(ratios);
}

Measured mean_life_ratio(const Point& over,
                         const Point& under,
                         const FlightFigure& time_s,
                         const std::function<bool(const Summary&)>& ends_in_loss) {
  const Lives above = lives_of(over, time_s, ends_in_loss);
  const Lives below = lives_of(under, time_s, ends_in_loss);
  if (above.losses == 0.0 || below.losses == 0.0 || below.time_s <= 0.0) {
    return {};
  }
  const double mean = above.time_s / above.losses * below.losses / below.time_s;
  const double factor = std::exp(normal_95 * std::sqrt(1.0 / above.losses + 1.0 / below.losses));
  return {MedianInterval{mean, mean / factor, mean * factor},
          static_cast<int>(std::min(over.flights.size(), under.flights.size()))};
}

Measured share_percent(const Point& point, const std::function<bool(const Summary&)>& is_so) {
  constexpr double z = normal_95;
  if (point.flights.empty()) {
    return {};
  }
  const auto so = std::count_if(point.flights.begin(), point.flights.end(),
                                [&is_so](const Summary* flight) { return is_so(*flight); });
  const auto n = static_cast<double>(point.flights.size());
  const double share = static_cast<double>(so) / n;
  const double below = 1.0 + z * z / n;
  const double middle = (share + z * z / (2.0 * n)) / below;
  const double reach = z * std::sqrt(share * (1.0 - share) / n + z * z / (4.0 * n * n)) / below;
  return {MedianInterval{100.0 * share, 100.0 * std::max(0.0, middle - reach),
                         100.0 * std::min(1.0, middle + reach)},
          static_cast<int>(point.flights.size())};
}

Measured success_percent(const Point& point) {
  return share_percent(point, has_succeeded);
}

Claim success_claim(const std::string& whose, const Point& point) {
  Claim claim{whose + ": flights that succeed", "%"};
  claim.ours = success_percent(point);
  return claim;
}

}  // namespace flyball
