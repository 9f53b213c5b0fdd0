// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/learned_latency.h"

#include "flyball/runtime/assert.h"

#include <cmath>

namespace flyball {

bool is_a_range(double any_m) {
  return any_m > 0.01 && any_m < 1e4;
}

bool is_a_clock(double any_hz) {
  return any_hz >= 1e6 && any_hz <= 1e12;
}

std::vector<LatencyLevel> levels_between(const std::vector<double>& resolutions_m,
                                         double fine_s,
                                         double coarse_s) {
  FLYBALL_ASSERT(!resolutions_m.empty() && fine_s > 0.0 && coarse_s > 0.0, "%zu levels, %g s, %g s",
                 resolutions_m.size(), fine_s, coarse_s);
  constexpr double fine_slope = 2.2;  // Volume dominates in small cells, rays in large ones.
  constexpr double coarse_slope = 1.0;
  const double span = std::log(resolutions_m.back() / resolutions_m.front());
  std::vector<LatencyLevel> levels;
  for (const double r_m : resolutions_m) {
    const double u = span > 0.0 ? std::log(r_m / resolutions_m.front()) / span : 0.0;
    LatencyLevel level;
    level.resolution_m = r_m;
    level.latency_s = fine_s * std::pow(coarse_s / fine_s, u);
    level.range_slope = fine_slope + (coarse_slope - fine_slope) * u;
    levels.push_back(level);
  }
  return levels;
}

double frame_interval_s(const std::optional<DepthCameraSpec>& camera, const KnobSettings& knobs) {
  std::optional<double> interval_s;
  if (camera && camera->rate_hz > 0.0) {
    interval_s = 1.0 / camera->rate_hz;
  }
  for (const char* limit : {"camera.rate_hz", "map.rate_hz"}) {
    const double rate_hz = knobs.spec(limit) != nullptr ? knobs.value(limit) : 0.0;
    if (rate_hz > 0.0) {
      interval_s = interval_s ? passed_interval_s(*interval_s, rate_hz) : 1.0 / rate_hz;
    }
  }
  return interval_s.value_or(LearnedLatencySettings{}.frame_s);
}

LearnedLatency::LearnedLatency(const LearnedLatencySettings& settings,
                               const std::vector<LatencyLevel>& levels,
                               const MapSetting& in_force,
                               Hertz top_clock)
    : settings_{settings},
      bound_{levels.size(), settings.bound},
      top_clock_{top_clock},
      in_force_{in_force} {
  for (const LatencyLevel& level : levels) {
    LatencyPrior prior;
    prior.clock = settings.clock;
    prior.slope = level.range_slope;
    prior.seconds = level.latency_s / std::pow(level.range_m, level.range_slope) /
                    settings.clock.factor(top_clock);
    prior.sigma = 0.5;  // Chosen: the given latency may be wrong by a factor of 1.6.
    models_.add(prior);
    cells_m_.push_back(level.resolution_m);
  }
}

// The nearest level, because somebody else may have set the cells of the map.
std::size_t LearnedLatency::level(double resolution_m) const {
  std::size_t best = 0;
  for (std::size_t i = 1; i < cells_m_.size(); ++i) {
    if (std::abs(cells_m_[i] - resolution_m) < std::abs(cells_m_[best] - resolution_m)) {
      best = i;
    }
  }
  return best;
}

double LearnedLatency::predicted_s(const MapSetting& setting) const {
  return models_.predict_s(level(setting.resolution_m), {setting.range_m, Hertz{setting.clock_hz}});
}

double LearnedLatency::bounded_s(const MapSetting& setting) const {
  return bound_.tracker(level(setting.resolution_m)).factor() * predicted_s(setting);
}

/// A board that is too hot grants a lower clock than was asked for, and a governor may change it
/// later. So a map counts with the clocks that were observed, not with the one that was asked for.
void LearnedLatency::note_clock(const Observation& seen) {
  const bool is_told = is_a_clock(seen.frequency.value());
  clock_factors_ += settings_.clock.factor(is_told ? seen.frequency : Hertz{in_force_.clock_hz});
  ++looks_;
}

/// The clock at which a map would take as long as at the observed ones together.
Hertz LearnedLatency::mean_clock() const {
  return Hertz{1e9 * settings_.clock.a / (clock_factors_ / looks_ - settings_.clock.b)};
}

void LearnedLatency::learn(const Observation& seen) {
  const double measured_s = to_seconds(seen.latency);
  constexpr double absurd_s = 100.0;
  const bool is_new = seen.map_revision != revision_ && measured_s > 0.0 && measured_s < absurd_s;
  revision_ = seen.map_revision;
  first_look_ = first_look_.value_or(seen.now);
  note_clock(seen);
  const Hertz clock = mean_clock();
  bound_.regrant(settings_.clock.factor(clock) / settings_.clock.factor(issued_at_));
  if (!is_new) {
    // The next map begins with the next frame, so nothing is late before that.
    bound_.expire(seen.now - from_seconds(settings_.frame_s));
    return;
  }
  bound_.settle(issued_ + seen.latency);
  clock_factors_ = 0.0;
  looks_ = 0;
  learn_from(seen, clock);
}

/// @param clock  Of the new map.
void LearnedLatency::learn_from(const Observation& seen, Hertz clock) {
  const MissionTime captured = seen.now - seen.latency;
  // The first map of other cells tells little: its frame has waited for one of the cells before, or
  // its level has to be made.
  const bool is_of_these_cells =
      captured >= cells_since_ && std::abs(seen.map_resolution_m - in_force_.resolution_m) < 1e-9;
  const bool is_of_this_setting = is_of_these_cells && captured >= in_force_since_;
  const bool tells_range = is_of_these_cells && is_a_range(seen.map_range_m);
  const bool learns =
      settings_.learn_s == 0.0 || to_seconds(seen.now - *first_look_) < settings_.learn_s;
  if (learns && (tells_range || is_of_this_setting)) {
    const double range_m = tells_range ? seen.map_range_m : in_force_.range_m;
    models_.learn(level(in_force_.resolution_m), {range_m, clock}, seen.latency);
  }
  if (is_of_this_setting) {
    issued_ = seen.now;
    issued_at_ = Hertz{in_force_.clock_hz};
    bound_.issue(level(in_force_.resolution_m), issued_, from_seconds(predicted_s(in_force_)));
  }
}

void LearnedLatency::put_in_force(const MapSetting& setting, MissionTime now) {
  if (setting == in_force_) {
    return;
  }
  if (setting.resolution_m != in_force_.resolution_m) {
    cells_since_ = now;
  }
  in_force_ = setting;
  in_force_since_ = now;
  // The bound assumes the clock that it was issued at; `note_clock` sees what is granted.
  bound_.widen(
      level(setting.resolution_m),
      from_seconds(predicted_s({setting.resolution_m, setting.range_m, issued_at_.value()})));
}

BoundCount LearnedLatency::bounds() const {
  BoundCount count;
  for (std::size_t i = 0; i < bound_.levels(); ++i) {
    count.issued += bound_.tracker(i).decisions();
    count.late += bound_.tracker(i).misses();
  }
  count.factor = bound_.tracker(level(in_force_.resolution_m)).factor();
  return count;
}

std::vector<LevelBounds> LearnedLatency::bound_levels() const {
  constexpr double worst = 4.0;  // Above the factor of 3 that `flyball drift` tries.
  std::vector<LevelBounds> levels;
  for (std::size_t i = 0; i < bound_.levels(); ++i) {
    const QuantileTracker& one = bound_.tracker(i);
    levels.push_back({cells_m_[i], one.decisions(), one.misses(), one.most_misses(worst)});
  }
  return levels;
}

}  // namespace flyball
