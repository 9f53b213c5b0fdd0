// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/energy_search.h"

#include "flyball/governors/search_space.h"
#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace flyball {
namespace {

constexpr double least_speed_m_s = 0.05;  // Chosen: near zero, energy per metre means nothing.
constexpr double smoothing = 0.1;  // Chosen: the load beside the map is a mean over some seconds.
constexpr double too_slow = 1e3;   // A factor on the price of settings that respond too late: any
                                   // other is cheaper, but one of them is better than none.
constexpr double open_over_room = 10.0;  // Chosen: so much longer a map may take, at most, where no
                                         // walls end its rays.

// At the mission's own speed limit many settings differ by milliwatts only. Among them the search
// takes the one with the shortest response. Each is compared with the best of all, because small
// losses would add up from pair to pair.
constexpr double equal = 1e-3;

bool is_positive(double x) {
  return std::isfinite(x) && x > 0.0;
}

/// Of whatever sensor; anything else is a fault of the observation.
bool is_a_range(double x_m) {
  return x_m > 0.01 && x_m < 1e4;
}

}  // namespace

Result<EnergySearch> EnergySearch::make(const EnergySearchSettings& settings,
                                        const std::vector<SearchLevel>& levels,
                                        const std::vector<double>& ranges_m,
                                        const KnobSettings& knobs,
                                        const PowerCost& computer) {
  std::vector<double> resolutions_m;
  resolutions_m.reserve(levels.size());
  for (const SearchLevel& level : levels) {
    resolutions_m.push_back(level.resolution_m);
  }
  const KnobSpec* clock = knobs.spec("cpu.frequency_hz");
  auto points = OperatingPoints::lattice(
      {{"map.resolution_m", resolutions_m},
       {"map.range_m", ranges_m},
       {"cpu.frequency_hz", clock != nullptr ? clock->legal : std::vector<double>{}}},
      knobs);
  if (!points) {
    return points.error();
  }
  EnergySearch search{settings, levels, std::move(*points), computer};
  search.in_force_ = {knobs.value("map.resolution_m"), knobs.value("map.range_m"),
                      knobs.value("cpu.frequency_hz")};
  search.estimates_.resize(search.points_.size());
  for (std::size_t point = 0; point < search.points_.size(); ++point) {
    search.expected_s_.push_back(search.response_s(search.predicted_s(search.setting(point))));
  }
  return search;
}

EnergySearch::EnergySearch(const EnergySearchSettings& settings,
                           const std::vector<SearchLevel>& levels,
                           OperatingPoints points,
                           const PowerCost& computer)
    : settings_{settings},
      points_{std::move(points)},
      bound_{levels.size(), 1, settings.bound},
      computer_{computer},
      thermal_{computer},
      most_clock_hz_{clocks_hz().back()} {
  for (const SearchLevel& level : levels) {
    LatencyPrior prior;
    prior.clock = settings.clock;
    prior.slope_resolution = 0.0;
    prior.slope_points = level.range_slope;  // "points" are metres of range here
    prior.seconds =
        level.latency_s / std::pow(level.range_m, level.range_slope) /
        settings.clock.factor(level.clock_hz > 0.0 ? Hertz{level.clock_hz} : Hertz{most_clock_hz_});
    prior.sigma = 0.5;  // Chosen: the given latency may be wrong by a factor of 1.6.
    models_.add(prior);
    most_range_m_.push_back(level.most_range_m);
  }
}

MapSetting EnergySearch::setting(std::size_t point) const {
  const double* values = points_.values(point);
  return {values[cell_axis], values[range_axis], values[clock_axis]};
}

// The nearest level, because somebody else may have set the cells of the map.
std::size_t EnergySearch::level(double resolution_m) const {
  const auto& levels = cells_m();
  std::size_t best = 0;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    if (std::abs(levels[i] - resolution_m) < std::abs(levels[best] - resolution_m)) {
      best = i;
    }
  }
  return best;
}

double EnergySearch::predicted_s(const MapSetting& setting) const {
  return models_.predict_s(level(setting.resolution_m),
                           {1.0, setting.range_m, Hertz{setting.clock_hz}});
}

double EnergySearch::busy_cores(const MapSetting& setting, double latency_s) const {
  const double map_cores = std::min(1.0, latency_s / std::max(latency_s, settings_.frame_s));
  return map_cores + other_core_ghz_ / (setting.clock_hz * 1e-9);
}

Watts EnergySearch::computer_power(const MapSetting& setting, double map_s) const {
  return computer_.power(Hertz{setting.clock_hz}, busy_cores(setting, map_s));
}

void EnergySearch::learn(const Observation& seen) {
  learn_latency(seen);
  thermal_.learn(seen);
  most_clock_hz_ = thermal_.most_clock_hz(clocks_hz());
  if (seen.phase == MissionPhase::cruise) {
    rotors_.learn(seen.speed_m_s, seen.rotor_power);
  }
  const double ghz = seen.frequency.value() * 1e-9;
  if (is_positive(ghz) && std::isfinite(seen.busy_cores)) {
    const double others = std::clamp(seen.busy_cores - 1.0, 0.0, 64.0) * std::min(ghz, 10.0);
    other_core_ghz_ += smoothing * (others - other_core_ghz_);
  }
}

/// A board that is too hot grants a lower clock than was asked for, and a governor may change it
/// later. So a map counts with the clocks that were observed, not with the one that was asked for.
void EnergySearch::note_clock(const Observation& seen) {
  const double hz = seen.frequency.value();
  const bool is_told = hz > 1e6 && hz < 1e12;  // Anything else is a fault of the observation.
  clock_factors_ += settings_.clock.factor(is_told ? seen.frequency : Hertz{in_force_.clock_hz});
  ++looks_;
}

/// The clock at which a map would take as long as at the observed ones together.
Hertz EnergySearch::mean_clock() const {
  return Hertz{1e9 * settings_.clock.a / (clock_factors_ / looks_ - settings_.clock.b)};
}

void EnergySearch::learn_latency(const Observation& seen) {
  const double measured_s = to_seconds(seen.latency);
  constexpr double absurd_s = 100.0;
  const bool is_new = seen.map_revision != revision_ && measured_s > 0.0 && measured_s < absurd_s;
  revision_ = seen.map_revision;
  note_clock(seen);
  const Hertz clock = mean_clock();
  bound_.regrant(ticket_, settings_.clock.factor(clock) / settings_.clock.factor(issued_at_));
  if (!is_new) {
    // The next map begins with the next frame, so nothing is late before that.
    bound_.expire(seen.now - from_seconds(settings_.frame_s));
    return;
  }
  bound_.settle(ticket_, issued_ + seen.latency);
  clock_factors_ = 0.0;
  looks_ = 0;
  const MissionTime captured = seen.now - seen.latency;
  // The first map of other cells tells little: its frame has waited for one of the cells before, or
  // its level has to be made.
  const bool is_of_these_cells =
      captured >= cells_since_ && std::abs(seen.map_resolution_m - in_force_.resolution_m) < 1e-9;
  const bool is_of_this_setting = is_of_these_cells && captured >= in_force_since_;
  const bool tells_range = is_of_these_cells && is_a_range(seen.map_range_m);
  const bool learns =
      settings_.learn_s == 0.0 || to_seconds(seen.now.time_since_epoch()) < settings_.learn_s;
  if (learns && (tells_range || is_of_this_setting)) {
    const double range_m = tells_range ? seen.map_range_m : in_force_.range_m;
    models_.learn(level(in_force_.resolution_m), {1.0, range_m, clock}, seen.latency);
  }
  if (is_of_this_setting) {
    issued_ = seen.now;
    issued_at_ = Hertz{in_force_.clock_hz};
    ticket_ =
        bound_.issue(level(in_force_.resolution_m), issued_, from_seconds(predicted_s(in_force_)));
  }
}

BoundCount EnergySearch::bounds() const {
  BoundCount count;
  for (std::size_t i = 0; i < bound_.levels(); ++i) {
    count.issued += bound_.tracker(i).decisions();
    count.late += bound_.tracker(i).misses();
  }
  count.factor = bound_.tracker(level(in_force_.resolution_m)).factor();
  return count;
}

std::vector<LevelBounds> EnergySearch::bound_levels() const {
  constexpr double worst = 4.0;  // Above the factor of 3 that `flyball drift` tries.
  std::vector<LevelBounds> levels;
  for (std::size_t i = 0; i < bound_.levels(); ++i) {
    const QuantileTracker& one = bound_.tracker(i);
    levels.push_back({cells_m()[i], one.decisions(), one.misses(), one.most_misses(worst, 1)});
  }
  return levels;
}

// The next map takes about as long as this one did, and begins with the next frame at the earliest.
double EnergySearch::response_s(double latency_s) const {
  return latency_s + std::max(latency_s, settings_.frame_s) + settings_.reaction_s;
}

EnergyEstimate EnergySearch::estimate(const MapSetting& setting, const Surroundings& around) const {
  const SpeedLimit limit{around.deceleration_m_s2 > 0.0 ? around.deceleration_m_s2
                                                        : settings_.deceleration_m_s2};
  const double latency_s = predicted_s(setting);
  EnergyEstimate best;
  best.setting = setting;
  best.response_s = response_s(latency_s);
  const double distance_m = free_ahead_m(settings_, setting, around.visibility_m);
  const double safe_m_s = limit.speed_m_s(best.response_s, distance_m);
  best.speed_m_s = std::max(least_speed_m_s, std::min(safe_m_s, around.speed_limit_m_s));
  const Watts rotor_w = rotors_.power(best.speed_m_s);
  const Watts computer_w = computer_power(setting, latency_s);
  const double shows_m = distance_m - best.speed_m_s * best.response_s;
  best.joules_per_m = path_over_line(settings_, setting.resolution_m, shows_m) *
                      joules_per_metre(rotor_w, computer_w, best.speed_m_s);
  if (safe_m_s < around.speed_limit_m_s) {
    best.watts_per_second = limit.watts_per_second((rotor_w + computer_w).value(), best.response_s,
                                                   distance_m, rotors_.slope_w_s_m(best.speed_m_s));
  }
  return best;
}

bool EnergySearch::is_allowed(const MapSetting& candidate,
                              const Surroundings& around,
                              double least_range_m) const {
  // If no level is fine enough, the finest one is allowed.
  const double coarsest_m = std::max(around.coarsest_m, cells_m().front());
  const double most_range_m = std::max(around.most_range_m, ranges_m().front());
  const double clear_range_m =
      std::max(most_range_m_[level(candidate.resolution_m)], around.clear_range_m);
  return candidate.resolution_m <= coarsest_m && candidate.resolution_m >= around.finest_m &&
         candidate.range_m <= std::min(most_range_m, clear_range_m) &&
         !(candidate.range_m < least_range_m) && candidate.clock_hz <= most_clock_hz_ &&
         (!around.needs_top_clock || candidate.clock_hz == most_clock_hz_);
}

double EnergySearch::feared_s(std::size_t point, const Surroundings& around) const {
  const double in_open_s = response_s(open_over_room * predicted_s(setting(point)));
  return around.is_enclosed ? expected_s_[point] : std::min(expected_s_[point], in_open_s);
}

EnergyEstimate EnergySearch::best_of(const Surroundings& around, double least_range_m) {
  double least_j = std::numeric_limits<double>::infinity();
  for (std::size_t point = 0; point < points_.size(); ++point) {
    const MapSetting candidate = setting(point);
    EnergyEstimate& estimated = estimates_[point];
    estimated.joules_per_m = std::numeric_limits<double>::infinity();
    if (!is_allowed(candidate, around, least_range_m)) {
      continue;
    }
    estimated = estimate(candidate, around);
    estimated.joules_per_m *= around.waits.delay(candidate.clock_hz, most_clock_hz_);
    if (std::max(estimated.response_s, feared_s(point, around)) > around.most_response_s) {
      estimated.joules_per_m *= too_slow;
    }
    least_j = std::min(least_j, estimated.joules_per_m);
  }
  EnergyEstimate best;
  best.joules_per_m = std::numeric_limits<double>::infinity();
  best.response_s = std::numeric_limits<double>::infinity();
  for (const EnergyEstimate& estimated : estimates_) {
    const bool is_sooner = estimated.response_s < best.response_s;
    const bool is_equal = estimated.joules_per_m <= (1.0 + equal) * least_j;
    if (is_equal && std::isfinite(least_j) && is_sooner) {
      best = estimated;
    }
  }
  return best;
}

EnergyEstimate EnergySearch::choose(const Surroundings& around, MissionTime now) {
  EnergyEstimate best = best_of(around, around.least_range_m);
  if (!std::isfinite(best.joules_per_m)) {  // No allowed level has such a range.
    best = best_of(around, 0.0);
  }
  FLYBALL_ASSERT(std::isfinite(best.joules_per_m), "no setting of %zu is finite", points_.size());
  put_in_force(best.setting, now);
  return best;
}

MapSetting EnergySearch::idle(
    double resolution_m, double range_m, double within_s, std::size_t raised_by, MissionTime now) {
  const double factor = bound_.tracker(level(resolution_m)).factor();
  std::size_t slowest = 0;
  while (slowest + 1 < clocks_hz().size() &&
         factor * predicted_s({resolution_m, range_m, clocks_hz()[slowest]}) > within_s) {
    ++slowest;
  }
  const std::size_t chosen = std::min(slowest + raised_by, clocks_hz().size() - 1);
  for (EnergyEstimate& none : estimates_) {
    none.joules_per_m = std::numeric_limits<double>::infinity();  // The vehicle makes no progress.
  }
  put_in_force({resolution_m, range_m, std::min(clocks_hz()[chosen], most_clock_hz_)}, now);
  return in_force_;
}

void EnergySearch::put_in_force(const MapSetting& setting, MissionTime now) {
  if (setting == in_force_) {
    return;
  }
  if (setting.resolution_m != in_force_.resolution_m) {
    cells_since_ = now;
  }
  in_force_ = setting;
  in_force_since_ = now;
  // The ticket assumes the clock that it was issued at; `note_clock` sees what is granted.
  bound_.widen(
      ticket_, level(setting.resolution_m),
      from_seconds(predicted_s({setting.resolution_m, setting.range_m, issued_at_.value()})));
}

}  // namespace flyball
