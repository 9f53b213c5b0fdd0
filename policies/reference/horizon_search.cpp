// SPDX-License-Identifier: BSD-3-Clause
#include "horizon_search.h"

#include "flyball/governors/speed_limit.h"
#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace flyball {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
// Of what is flown with the setting that is chosen; see ClockSearch.
constexpr double equal = 1e-3;
constexpr double rounding = 1e-9;

}  // namespace

HorizonSearch::HorizonSearch(const HorizonSettings& settings,
                             const ClockSearch& search,
                             std::vector<MapSetting> points)
    : settings_{settings},
      price_{search.settings()},
      points_{std::move(points)},
      top_clock_hz_{search.clocks_hz().back()},
      speeds_{static_cast<std::size_t>(settings.most_speed_m_s / settings.speed_step_m_s) + 1} {
  FLYBALL_ASSERT(!points_.empty(), "no settings to compare");
  finest_m_ = points_.front().resolution_m;
  double cells_m = finest_m_;
  for (const MapSetting& one : points_) {
    levels_ += one.resolution_m != cells_m ? 1 : 0;
    cells_m = one.resolution_m;
    level_of_.push_back(levels_);
  }
  ++levels_;
  rotor_w_.resize(2 * speeds_);
  edge_j_.resize(2 * speeds_);
  computer_w_.resize(points_.size());
  rest_j_.resize(levels_ * speeds_);
  here_j_.resize(levels_ * speeds_);
  estimates_.resize(points_.size());
}

double HorizonSearch::speed(std::size_t index) const {
  return static_cast<double>(index) * settings_.speed_step_m_s;
}

double HorizonSearch::bounded_response_s(double frame_s) const {
  return response_s(price_, settings_.bound_over_true * frame_s);
}

double HorizonSearch::path_over_line(double resolution_m, double shows_m) const {
  const double w_m = settings_.half_width_m;
  const double s_m = std::max(shows_m, 0.0);
  return 1.0 + (resolution_m + std::hypot(s_m, w_m) - s_m) / settings_.spacing_m;
}

bool HorizonSearch::is_allowed(std::size_t point, const Stretch& here) const {
  const MapSetting& one = points_[point];
  const PlaceLimits& limits = *here.limits;
  const bool is_soon = bounded_response_s(here.frame_s[point]) <= limits.most_response_s;
  return one.resolution_m <= std::max(limits.coarsest_m, finest_m_) + rounding && is_soon &&
         !(one.range_m < limits.least_range_m) &&
         (!limits.needs_top_clock || one.clock_hz == top_clock_hz_);
}

/// The last speed that eq. 2 and the mission allow. A crawl always is: somebody else stops.
std::size_t HorizonSearch::fastest(std::size_t point, const Stretch& here) const {
  const PlaceLimits& limits = *here.limits;
  const SpeedLimit limit{limits.around.deceleration_m_s2};
  const double distance_m = free_ahead_m(points_[point], limits.around.visibility_m);
  const double v_m_s =
      std::min(limit.speed_m_s(bounded_response_s(here.frame_s[point]), distance_m),
               limits.around.speed_limit_m_s);
  const auto index = static_cast<std::size_t>(v_m_s / settings_.speed_step_m_s + rounding);
  return std::clamp<std::size_t>(index, 1, speeds_ - 1);
}

void HorizonSearch::price_edges(std::size_t point, const Stretch& here, std::size_t most) {
  const double faster_m_s =
      std::sqrt(speed(most) * speed(most) + 2.0 * settings_.accelerates_m_s2 * here.length_m);
  const auto end = most + static_cast<std::size_t>(faster_m_s / settings_.speed_step_m_s) + 2;
  for (std::size_t speeds = 1; speeds < std::min(end, edge_j_.size()); ++speeds) {
    edge_j_[speeds] = edge_j(point, here, speeds);
  }
}

/// @param speeds  The sum of both ends' indices.
double HorizonSearch::edge_j(std::size_t point, const Stretch& here, std::size_t speeds) const {
  const PlaceLimits& limits = *here.limits;
  const MapSetting& one = points_[point];
  const double v_m_s = 0.5 * speed(speeds);
  const double shows_m = free_ahead_m(one, limits.around.visibility_m) -
                         v_m_s * bounded_response_s(here.frame_s[point]);
  const double ratio = path_over_line(one.resolution_m, shows_m);
  return here.length_m * ratio * (rotor_w_[speeds] + computer_w_[point]) / v_m_s;
}

/// The least over all speeds at the end of the stretch; `never` where none is within reach.
double HorizonSearch::onward_j(std::size_t point, const Stretch& here, std::size_t from) const {
  const double v2 = speed(from) * speed(from);
  const double most2 = v2 + 2.0 * settings_.accelerates_m_s2 * here.length_m;
  const double least2 = v2 - 2.0 * here.limits->around.deceleration_m_s2 * here.length_m;
  const double* rest_j = &rest_j_[level_of_[point] * speeds_];
  double least_j = never;
  for (std::size_t to = 0; to < speeds_ && speed(to) * speed(to) <= most2 + rounding; ++to) {
    const bool stands = from + to == 0;
    if (speed(to) * speed(to) >= least2 - rounding && !stands && rest_j[to] < never) {
      least_j = std::min(least_j, edge_j_[from + to] + rest_j[to]);
    }
  }
  return least_j;
}

/// Nothing is left to fly, at any speed that a setting allows there.
void HorizonSearch::end_at(const Stretch& last) {
  std::fill(rest_j_.begin(), rest_j_.end(), never);
  for (std::size_t point = 0; point < points_.size(); ++point) {
    if (is_allowed(point, last)) {
      double* rest = &rest_j(level_of_[point], 0);
      std::fill(rest, rest + fastest(point, last) + 1, 0.0);
    }
  }
}

void HorizonSearch::switch_where_it_pays() {
  for (std::size_t v = 0; v < speeds_; ++v) {
    double least_j = never;
    for (std::size_t level = 0; level < levels_; ++level) {
      least_j = std::min(least_j, rest_j(level, v));
    }
    for (std::size_t level = 0; level < levels_; ++level) {
      rest_j(level, v) =
          std::min(rest_j(level, v), least_j + settings_.switching_s * rotor_w_.front());
    }
  }
}

void HorizonSearch::note_computer(const ClockSearch& search, const Stretch& here) {
  for (std::size_t point = 0; point < points_.size(); ++point) {
    computer_w_[point] = search.computer_power(points_[point], here.frame_s[point]).value();
  }
}

void HorizonSearch::go_back_over(const ClockSearch& search, const Stretch& here) {
  note_computer(search, here);
  switch_where_it_pays();
  std::fill(here_j_.begin(), here_j_.end(), never);
  for (std::size_t point = 0; point < points_.size(); ++point) {
    if (!is_allowed(point, here)) {
      continue;
    }
    const std::size_t most = fastest(point, here);
    price_edges(point, here, most);
    double* here_j = &here_j_[level_of_[point] * speeds_];
    for (std::size_t v = 0; v <= most; ++v) {
      here_j[v] = std::min(here_j[v], onward_j(point, here, v));
    }
  }
  rest_j_.swap(here_j_);
}

/// From the speed that there is, or the next lower one from which it can go on: a vehicle that is
/// too fast for a setting brakes.
void HorizonSearch::weigh_first(const ClockSearch& search, const Stretch& here, double speed_m_s) {
  note_computer(search, here);
  switch_where_it_pays();
  const auto now = static_cast<std::size_t>(
      std::clamp(speed_m_s / settings_.speed_step_m_s + 0.5, 0.0, static_cast<double>(speeds_)));
  for (std::size_t point = 0; point < points_.size(); ++point) {
    EnergyEstimate& estimate = estimates_[point];
    estimate = {};
    estimate.setting = points_[point];
    estimate.joules_per_m = never;
    if (!is_allowed(point, here)) {
      continue;
    }
    const std::size_t most = fastest(point, here);
    price_edges(point, here, most);
    estimate.response_s = bounded_response_s(here.frame_s[point]);
    estimate.speed_m_s = std::min(speed(most), here.limits->around.speed_limit_m_s);
    for (std::size_t v = std::min(now, most) + 1; v-- > 0 && !(estimate.joules_per_m < never);) {
      estimate.joules_per_m = onward_j(point, here, v);
    }
    const bool switches = points_[point].resolution_m != search.in_force().resolution_m;
    estimate.joules_per_m += switches ? settings_.switching_s * rotor_w_.front() : 0.0;
  }
}

std::optional<EnergyEstimate> HorizonSearch::best(double within) const {
  double least_j = never;
  for (const EnergyEstimate& one : estimates_) {
    least_j = std::min(least_j, one.joules_per_m);
  }
  std::optional<EnergyEstimate> soonest;
  for (const EnergyEstimate& one : estimates_) {
    const bool is_equal = one.joules_per_m < never && one.joules_per_m <= (1.0 + within) * least_j;
    if (is_equal && (!soonest || one.response_s < soonest->response_s)) {
      soonest = one;
    }
  }
  return soonest;
}

std::optional<EnergyEstimate> HorizonSearch::choose(const ClockSearch& search,
                                                    const Foresight& truth,
                                                    const std::vector<PlaceLimits>& limits,
                                                    double speed_m_s) {
  const std::size_t places = truth.places.size();
  FLYBALL_ASSERT(
      places >= 2 && limits.size() >= places && truth.frame_s.size() == places * points_.size(),
      "%zu places, %zu limits, %zu durations of %zu settings", places, limits.size(),
      truth.frame_s.size(), points_.size());
  for (std::size_t i = 0; i < rotor_w_.size(); ++i) {
    rotor_w_[i] = search.rotor_power(0.5 * speed(i)).value();
  }
  const auto stretch = [&](std::size_t place) {
    const double next_m = truth.places[std::min(place + 1, places - 1)].ahead_m;
    return Stretch{next_m - truth.places[place].ahead_m, &limits[place],
                   &truth.frame_s[place * points_.size()]};
  };
  end_at(stretch(places - 1));
  for (std::size_t place = places - 1; place-- > 1;) {
    go_back_over(search, stretch(place));
  }
  const Stretch first = stretch(0);
  weigh_first(search, first, speed_m_s);
  const double all_m = truth.places.back().ahead_m - truth.places.front().ahead_m;
  for (EnergyEstimate& one : estimates_) {
    one.joules_per_m /= all_m;
  }
  return best(equal * first.length_m / all_m);
}

}  // namespace flyball
