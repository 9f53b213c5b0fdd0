// SPDX-License-Identifier: BSD-3-Clause
#include "map_rule.h"

#include "flyball/governors/required_knobs.h"
#include "flyball/governors/surroundings.h"
#include "flyball/governors/waiting_share.h"
#include "flyball/runtime/text/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

namespace flyball {
namespace {

constexpr double limit_ahead_m = 20.0;  // Observation::speed_limit_m_s looks so far.
constexpr double next_maps_s = 0.5;     // Chosen: for two decisions a range stays in force.

/// The largest cells that are worth having, of a lattice if there is one. The ground's must not
/// reach up to the vehicle: there every plan would begin in an occupied cell.
double largest_cells_m(const std::vector<double>& lattice_m, const VehicleModel& vehicle) {
  // Larger cells block more of the paths between trees: in delivery_forest, .8 m take 1.06 of the
  // energy that .6 m take (stock OctoMap, n 96), and they gain nothing in congestion.
  constexpr double usual_m = 0.6;
  const double most_m = std::min(usual_m, vehicle.ground_clearance_m.value_or(usual_m));
  if (lattice_m.empty()) {
    return most_m;
  }
  const auto too_large = std::upper_bound(lattice_m.begin(), lattice_m.end(), most_m);
  return too_large != lattice_m.begin() ? *std::prev(too_large) : lattice_m.front();
}

/// All cells of a lattice between the finest and the coarsest one. A mapper that takes any cells
/// gets some that are about half as large as the next ones, with equal ratios between them.
std::vector<double> levels_of(const Parameters& given,
                              const KnobSpec& resolution,
                              const VehicleModel& vehicle) {
  const std::vector<double>& lattice_m = resolution.legal;
  const double given_m = given.number("coarse_m");
  const double fine_m = smallest_cells_m(resolution, given.number("fine_m"));
  const double coarse_m =
      resolution.nearest(given_m > 0.0 ? given_m : largest_cells_m(lattice_m, vehicle));
  if (fine_m >= coarse_m) {
    return {fine_m, coarse_m};
  }
  std::vector<double> levels_m;
  if (lattice_m.empty()) {
    const int steps = std::max(1, std::ilogb(coarse_m / fine_m));
    for (int step = 0; step <= steps; ++step) {
      const double share = static_cast<double>(step) / steps;
      levels_m.push_back(resolution.nearest(fine_m * std::pow(coarse_m / fine_m, share)));
    }
  }
  std::copy_if(lattice_m.begin(), lattice_m.end(), std::back_inserter(levels_m),
               [&](double r_m) { return r_m >= fine_m && r_m <= coarse_m; });
  return levels_m;
}

}  // namespace

bool explores(const Observation& seen) {
  return seen.progress_unit == ProgressUnit::cubic_metre ||
         seen.progress_unit == ProgressUnit::square_metre;
}

std::vector<ParameterSpec> MapRule::parameters() {
  return {
      {"fine_m", 0.0, 0.0, 2.0, "Cells that pass every gap; 0: the mapper's finest, or .15 m."},
      {"coarse_m", 0.0, 0.0, 2.0,
       "For open space; 0: .6 m, or less where the ground would reach up to the vehicle."},
      // A door of .82 m (MAVBench's) stays open to a body of .71 m wherever it stands.
      {"door_m", 0.05, 0.0, 2.0,
       "Where plans keep failing near narrow gaps, if the mapper takes any cells; 0: none."},
      {"range_m", 10.0, 0.5, 100.0,
       "With cells of .15 m; larger ones reach farther, smaller ones never do."},
      // A TX2 takes .27 s for a map of stock OctoMap with cells of .15 m and a range of 10 m.
      {"small_cells_s", 0.25, 0.001, 60.0,
       "Cells below .15 m reach as far as a map takes so long."},
      {"least_range_m", 7.0, 0.5, 100.0, "Shortest, but where narrow gaps are declared."},
      {"most_range_m", 0.0, 0.0, 100.0, "Longest; 0: as far as the camera can tell a cell."},
      {"narrow_m_s", 2.0, 0.0, 50.0, "A speed limit, up to 20 m ahead, that means narrow gaps."},
      {"body_m", 0.0, 0.0, 5.0, "Width with the tube at a crawl; 0: the vehicle's own."},
      {"min_fine_s", 2.0, 0.0, 3600.0, "Finer cells last at least this long."},
      {"patience_s", 3.0, 0.1, 3600.0, "After standing for so long, the map gets fine cells."}};
}

Result<MapRule> MapRule::make(const std::string& owner,
                              const Parameters& given,
                              const KnobSettings& knobs,
                              const VehicleModel& vehicle) {
  const auto refused = [&owner](const std::string& why) {
    return Error{ErrorCode::invalid_input, owner + ": " + why};
  };
  if (const Status status = require_knobs(owner, knobs, {"map.resolution_m", "map.range_m"});
      !status) {
    return status.error();
  }
  MapRule rule{given, knobs, vehicle};
  if (rule.levels_m_.front() >= rule.levels_m_.back()) {
    return refused("fine_m = " + short_number_text(rule.levels_m_.front()) +
                   " must be below coarse_m = " + short_number_text(rule.levels_m_.back()));
  }
  if (rule.most_range_m_ > 0.0 && rule.least_range_m_ >= rule.most_range_m_) {
    return refused("least_range_m = " + short_number_text(rule.least_range_m_) +
                   " must be below most_range_m = " + short_number_text(rule.most_range_m_));
  }
  if (const double door_m = given.number("door_m"); door_m > 0.0 && !rule.keeps_hits_) {
    const double nearest_m = rule.cells_knob_.nearest(door_m);
    rule.door_m_ = nearest_m < rule.levels_m_.front() ? nearest_m : 0.0;
  }
  return rule;
}

MapRule::MapRule(const Parameters& given, const KnobSettings& knobs, const VehicleModel& vehicle)
    : cells_knob_{*knobs.spec("map.resolution_m")},
      range_knob_{*knobs.spec("map.range_m")},
      keeps_hits_{!cells_knob_.legal.empty()},
      range_m_{given.number("range_m")},
      least_range_m_{given.number("least_range_m")},
      most_range_m_{given.number("most_range_m")},
      small_cells_s_{given.number("small_cells_s")},
      narrow_m_s_{given.number("narrow_m_s")},
      body_m_{given.number("body_m") > 0.0 ? given.number("body_m") : vehicle.narrow_width_m},
      large_m_{0.5 * body_m_},
      camera_{vehicle.depth_camera},
      home_{knobs.value("map.resolution_m"), knobs.value("map.range_m"), 0.0},
      levels_m_{levels_of(given, cells_knob_, vehicle)},
      passability_{passability(given)} {}

Passability MapRule::passability(const Parameters& given) const {
  PassabilitySettings passable;
  passable.body_m = body_m_;
  passable.least = from_seconds(given.number("min_fine_s"));
  passable.patience = from_seconds(given.number("patience_s"));
  passable.retry_m = large_m_;
  passable.near_m = least_range_m_ + 1.0;
  // They are sorted here although `make` may refuse them afterwards.
  std::vector<double> levels_m = levels_m_;
  std::sort(levels_m.begin(), levels_m.end());
  return {passable, std::move(levels_m)};
}

// Beyond half a cell, noise fills the cells beside an obstacle too. A lattice keeps all hits in its
// finest cells, where they still are when the vehicle comes to a gap, whatever cells it had before.
// So with a lattice noise also stays below a quarter of the body's width on each side: a gap of one
// and a half bodies stays passable.
double MapRule::noise_free_m(double cells_m) const {
  return range_with_m(std::min(0.5 * cells_m, keeps_hits_ ? 0.25 * body_m_ : 1e9));
}

double MapRule::range_with_m(double noise_m) const {
  constexpr double step_m = 0.05;  // A fraction of the finest cells.
  double range_m = camera_->max_range_m;
  while (range_m > 0.0 && camera_->noise_m(range_m) > noise_m) {
    range_m -= step_m;
  }
  return range_m;
}

// Hits that noise has moved narrow a gap from both sides. Where no narrow ones are declared, noise
// may be a quarter of what the narrowest gap ahead leaves beside the body. Where none is seen, the
// next one is taken to be as wide as the last one was. The range ends before a zone where the
// vehicle must be slower, because noise of that distance would close the doors of a house.
double MapRule::clear_range_m(const Observation& seen, bool near) {
  if (!camera_ || near || seen.phase != MissionPhase::cruise) {
    last_gap_m_.reset();
    return 0.0;
  }
  if (seen.narrowest_gap_m < open_path_m) {
    last_gap_m_ = seen.narrowest_gap_m;
  }
  if (!last_gap_m_) {
    return 0.0;
  }
  const double flown_m = next_maps_s * std::max(0.0, seen.speed_m_s);
  const double zone_m = seen.slower_zone_m > 0.0 ? seen.slower_zone_m : limit_ahead_m;
  // Whole metres, so that a range stays for some maps: a bound on latency is one of a setting.
  return std::floor(std::min(zone_m - flown_m, range_with_m(0.25 * (*last_gap_m_ - body_m_))));
}

std::vector<LatencyLevel> MapRule::levels(double fine_s, double coarse_s) const {
  auto levels = levels_between(levels_m_, fine_s, coarse_s);
  if (door_m_ > 0.0) {
    levels.insert(levels.begin(), door_level(levels));
  }
  return levels;
}

// Its latency is on the line through those of the others, in log latency over log cells.
LatencyLevel MapRule::door_level(const std::vector<LatencyLevel>& others) const {
  const LatencyLevel& fine = others.front();
  const LatencyLevel& coarse = others.back();
  const double slope = std::log(fine.latency_s / coarse.latency_s) /
                       std::log(coarse.resolution_m / fine.resolution_m);
  LatencyLevel door = fine;
  door.resolution_m = door_m_;
  door.latency_s *= std::pow(fine.resolution_m / door_m_, slope);
  return door;
}

// A camera that nobody knows is trusted as far as the rule reaches.
double MapRule::most_range_m(double cells_m) const {
  if (most_range_m_ > 0.0) {
    return most_range_m_;
  }
  return camera_ ? std::max(least_range_m_, noise_free_m(cells_m)) : 1e9;
}

// With larger cells than these, `range_m` grows as tuning has found it (gap_switch's 10, 15 and 22
// m with cells of .15, .30 and .60 m). Where the mission is slow, 5 m would take .93 of the energy
// in building_079 (n 30), but 1.03 to 1.06 in other buildings (n 12), which 10 m show better.
double MapRule::usual_range_m(double cells_m, const LearnedLatency& latency) const {
  constexpr double tuned_m = 0.15;
  return cells_m < tuned_m ? quick_range_m(cells_m, latency)
                           : range_m_ * std::pow(cells_m / tuned_m, 0.57);
}

// Far maps of small cells come too late on one computer and cost nothing on another: with cells of
// .05 m, stock OctoMap has time for 2 m on a TX2, and our own map for 10 m, which takes .87 of the
// energy in an office (n 16). The steps are so large that a range stays for some maps, because a
// bound on latency is one of a setting.
double MapRule::quick_range_m(double cells_m, const LearnedLatency& latency) const {
  constexpr double step = 0.8;
  constexpr double least_m = 2.0;  // Chosen: a vehicle in rooms must see the next door.
  double range_m = range_m_;
  while (range_m > least_m &&
         latency.predicted_s({cells_m, range_m, latency.top_clock_hz()}) > small_cells_s_) {
    range_m *= step;
  }
  return range_m;
}

MapSetting MapRule::setting(const MapNeeds& needs, const LearnedLatency& latency) const {
  const double most_m = std::max(most_range_m(needs.cells_m), needs.clear_range_m);
  const double range_m = std::max(usual_range_m(needs.cells_m, latency), needs.least_range_m);
  // The values that the governor would make of them, because latency and energy are those of them.
  return {cells_knob_.nearest(needs.cells_m), range_knob_.nearest(std::min(range_m, most_m)), 0.0};
}

MapNeeds MapRule::look(const Observation& seen, double cells_m) {
  const Passability::Verdict gaps = passability_.judge(seen);
  const bool near = seen.speed_limit_m_s <= narrow_m_s_;
  MapNeeds needs;
  needs.cells_m = std::min(levels_m_[gaps.coarsest_level], coarsest_m(seen, near, cells_m));
  needs.cells_m = std::max(needs.cells_m, levels_m_.front());
  if (needs_door_cells(seen, near)) {
    needs.cells_m = door_m_;
  }
  needs.least_range_m = gaps.look_m;
  if (!near || explores(seen)) {  // A vehicle that may be fast needs to see farther, too.
    needs.least_range_m = std::max(needs.least_range_m, least_range_m_);
  }
  needs.clear_range_m = clear_range_m(seen, near);
  needs.needs_top_clock = gaps.coarsest_level == 0 || near;
  return needs;
}

// Cells are limited where the mission's speed limit tells of narrow gaps, before any of them can be
// seen. A vehicle that stands waits for a plan, and the map must keep its cells until that plan is
// there. On the ground, cells are those of the flight, because a path that was planned in smaller
// ones is blocked as soon as larger ones come.
double MapRule::coarsest_m(const Observation& seen, bool near, double cells_m) {
  if (needs_finest(seen, near, cells_m)) {
    return levels_m_.front();
  }
  double coarsest_m = under_ceiling_m(seen);
  if (near) {
    coarsest_m = std::min(coarsest_m, large_m_);
  }
  if (stands_in_cruise(seen)) {
    coarsest_m = std::min(coarsest_m, cells_m);
  }
  return coarsest_m;
}

// In cells that the ceiling fills down to the vehicle, every plan would begin in an occupied cell.
// Cells of size r >= q reach at most r - q farther down than the map's own cells of q.
double MapRule::under_ceiling_m(const Observation& seen) const {
  double largest_m = levels_m_.front();
  for (const double one_m : levels_m_) {
    const double lost_m = std::max(0.0, one_m - seen.map_resolution_m);
    largest_m = seen.headroom_m == 0.0 || seen.headroom_m > lost_m ? one_m : largest_m;
  }
  return largest_m;
}

// Before a narrow place, a plan may fail because the cells are larger than its door, so the next
// plan is made in the finest cells. Inside, they are kept even when the space looks clear for a
// moment: larger cells would close the door through which the path leads, and at this speed the
// finest ones cost no time.
bool MapRule::needs_finest(const Observation& seen, bool near, double cells_m) {
  seeks_door_ = near && (seeks_door_ || seen.planner_failures > 0);
  const bool is_within = near && seen.speed_m_s <= narrow_m_s_ && !(cells_m > levels_m_.front());
  return seeks_door_ || is_within;
}

// A plan that fails in the finest level may fail because a door has lost too much of its width.
// Inside, such cells are kept: larger ones would close the door that the path leads through. Who
// explores would have to see all rooms anew in them, and has other doors to try.
bool MapRule::needs_door_cells(const Observation& seen, bool near) {
  constexpr std::uint32_t enough = 2;  // One fails now and then where larger cells would do.
  const bool is_place = near && door_m_ > 0.0 && !explores(seen);
  has_door_cells_ = is_place && (has_door_cells_ || seen.planner_failures >= enough);
  return has_door_cells_;
}

}  // namespace flyball
