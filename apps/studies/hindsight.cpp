// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/hindsight.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flyball {
namespace {

constexpr double rounding = 1e-9;  // Relative: values come from lists and from products.

bool is_same(double a, double b) {
  return std::abs(a - b) <= rounding * std::max(std::abs(a), std::abs(b));
}

bool has_flown(const std::vector<Candidate>& flown, const Candidate& setting) {
  return std::any_of(flown.begin(), flown.end(), [&](const Candidate& other) {
    return !other.flights.empty() && other.parameters == setting.parameters;
  });
}

/// The neighbour along one axis.
std::optional<Candidate> beside(const GridAxis& axis, const Candidate& setting, bool upwards) {
  const auto value = axis.next(setting.parameters.at(axis.parameter), upwards);
  if (!value) {
    return std::nullopt;
  }
  Candidate other{setting.parameters, {}};
  other.parameters[axis.parameter] = *value;
  return other;
}

}  // namespace

std::optional<double> GridAxis::next(double value, bool upwards) const {
  // A list of legal values goes on where that of the grid ends.
  std::vector<double> known = values;
  known.insert(known.end(), knob.legal.begin(), knob.legal.end());
  std::optional<double> nearest;
  for (const double other : known) {
    const bool is_beyond = !is_same(other, value) && (upwards ? other > value : other < value);
    if (is_beyond && (!nearest || (upwards ? other < *nearest : other > *nearest))) {
      nearest = other;
    }
  }
  if (nearest || !knob.legal.empty()) {
    return nearest;
  }
  const double wish = std::clamp(upwards ? value * step : value / step, knob.min, knob.max);
  return is_same(wish, value) ? std::nullopt : std::optional{wish};
}

Result<std::vector<GridAxis>> hindsight_grid(const KnobSettings& knobs) {
  // Chosen: cells from those that pass a door of .82 m to RoboRun's 1.2 m; ranges from MAVBench's
  // 7 m to the longest that the knob has; budgets around those that scenarios have.
  std::vector<GridAxis> grid{
      {"resolution_m", {}, {0.15, 0.3, 0.6, 1.2}},
      {"range_m", {}, {7.0, 10.0, 15.0, 25.0}, 1.4},
      {"planner_budget", {}, {1000.0, 4000.0}, 4.0},
  };
  const std::vector<std::string> names{"map.resolution_m", "map.range_m", "planner.budget"};
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const KnobSpec* knob = knobs.spec(names[i]);
    if (knob == nullptr) {
      return Error{ErrorCode::not_found, "there is no knob \"" + names[i] +
                                             "\" whose best setting could be found; leave out "
                                             "--hindsight"};
    }
    std::vector<double> legal;
    for (const double value : grid[i].values) {
      const double near = knob->nearest(value);
      if (legal.empty() || !is_same(legal.back(), near)) {
        legal.push_back(near);
      }
    }
    grid[i].knob = *knob;
    grid[i].values = std::move(legal);
  }
  return grid;
}

std::vector<Candidate> settings_of(const std::vector<GridAxis>& grid) {
  std::vector<TriedParameter> tried;
  tried.reserve(grid.size());
  for (const GridAxis& axis : grid) {
    tried.push_back({axis.parameter, axis.values});
  }
  return combinations(tried);
}

std::vector<Candidate> neighbours_of(const std::vector<GridAxis>& grid, const Candidate& setting) {
  std::vector<Candidate> all;
  for (const GridAxis& axis : grid) {
    for (const bool upwards : {false, true}) {
      if (auto other = beside(axis, setting, upwards)) {
        all.push_back(std::move(*other));
      }
    }
  }
  return all;
}

bool is_better_in_hindsight(const Candidate& a, const Candidate& b) {
  const int more = a.failures() - b.failures();
  return more != 0 ? more < 0 : a.median_energy_j() < b.median_energy_j();
}

bool has_lost(const Candidate& flown, const Candidate& best) {
  constexpr double clearly = 1.1;  // Chosen: pairs of near settings differ by 3 to 9 %.
  if (flown.failures() > best.failures()) {
    return true;
  }
  std::size_t dearer = 0;
  for (std::size_t i = 0; i < std::min(flown.flights.size(), best.flights.size()); ++i) {
    const bool both = has_succeeded(flown.flights[i]) && has_succeeded(best.flights[i]);
    dearer += both && flown.flights[i].energy_total_j() > clearly * best.flights[i].energy_total_j()
                  ? 1
                  : 0;
  }
  return dearer >= 2 && dearer == flown.flights.size();
}

std::string Hindsight::text() const {
  std::string text = setting + ", the best of " + std::to_string(tried) + " settings, " +
                     std::to_string(on_grid) + " of them on the grid";
  for (const std::string& border : borders) {
    text += "; " + border;
  }
  return text;
}

Hindsight told_in_hindsight(const std::vector<GridAxis>& grid,
                            const Candidate& best,
                            const std::vector<Candidate>& flown) {
  Hindsight told;
  told.setting = parameters_text(best);
  told.tried = static_cast<std::size_t>(std::count_if(
      flown.begin(), flown.end(), [](const Candidate& one) { return !one.flights.empty(); }));
  told.on_grid = settings_of(grid).size();
  for (const GridAxis& axis : grid) {
    for (const bool upwards : {false, true}) {
      const std::string end = upwards ? "highest" : "lowest";
      const auto other = beside(axis, best, upwards);
      if (!other) {
        told.borders.push_back(axis.parameter + " is the " + end + " that " + axis.knob.name +
                               " has");
      } else if (!has_flown(flown, *other)) {
        told.borders.push_back(axis.parameter + " is the " + end + " that was flown");
      }
    }
  }
  return told;
}

}  // namespace flyball
