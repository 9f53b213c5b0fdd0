// SPDX-License-Identifier: BSD-3-Clause
#include "mission_way.h"

#include "flyball/governors/required_knobs.h"
#include "flyball/governors/search_space.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace flyball {
namespace {

constexpr double standing_m_s = 0.1;
constexpr double failed_plan_j = 750.0;     // A loss of some 2.5 s of speed, at 300 W.
constexpr double spacing_between_m = 20.0;  // From obstacle to obstacle, in RoboRun's congestion.

// Where an RGB-D camera's noise, .0657 d - .4193 beyond 6 m (MAVBench's code), is half a cell.
// Farther off it fills the cells beside an obstacle too, and closes gaps.
double noise_free_m(double resolution_m, double least_m) {
  return std::max(least_m, (0.5 * resolution_m + 0.4193) / 0.0657);
}

/// All cells of a lattice between the finest and the coarsest one; else these two. A mapper may
/// know certain cells only; the search needs one that it has.
std::vector<double> levels_of(const Parameters& given, const KnobSpec& resolution) {
  constexpr double usual_coarse_m = 0.8;  // MAVBench's coarse cells.
  const bool is_lattice = !resolution.legal.empty();
  const double given_m = given.number("coarse_m");
  const double coarsest_m = is_lattice ? resolution.legal.back() : usual_coarse_m;
  const double fine_m = resolution.nearest(given.number("fine_m"));
  const double coarse_m = resolution.nearest(given_m > 0.0 ? given_m : coarsest_m);
  if (!is_lattice || fine_m >= coarse_m) {
    return {fine_m, coarse_m};
  }
  std::vector<double> levels_m;
  std::copy_if(resolution.legal.begin(), resolution.legal.end(), std::back_inserter(levels_m),
               [&](double r_m) { return r_m >= fine_m && r_m <= coarse_m; });
  return levels_m;
}

double longest_m(const Parameters& given, const KnobSettings& knobs) {
  constexpr double usual_m = 12.0;
  const double most_m = given.number("most_range_m");
  if (most_m > 0.0) {
    return most_m;
  }
  return knobs.spec("map.range_m") == nullptr ? usual_m
                                              : std::max(usual_m, knobs.value("map.range_m"));
}

}  // namespace

std::vector<ParameterSpec> MissionWay::parameters() {
  return {
      {"fine_m", 0.15, 0.05, 2.0, "Resolution that passes every gap of the mission."},
      {"coarse_m", 0.0, 0.0, 2.0, "For the open; 0: the mapper's coarsest, .8 without a lattice."},
      {"least_range_m", 7.0, 0.5, 100.0, "Shortest range of the map."},
      {"most_range_m", 0.0, 0.0, 100.0, "Longest; 0: the mission's own, 12 at least."},
      {"narrow_m_s", 2.0, 0.0, 50.0, "A limit of speed, 20 m ahead, that means narrow gaps."},
      {"body_m", 0.71, 0.1, 5.0, "Width of the vehicle with its tube at a crawl."},
      {"min_fine_s", 2.0, 0.0, 3600.0, "Finer cells last at least this long."},
      {"coarse_budget", 200.0, 100.0, 1e6, "Of a plan in coarse cells, iterations."},
      {"rest_s", 1.0, 0.01, 3600.0, "While the vehicle waits: a map in so long is enough."},
      {"patience_s", 3.0, 0.1, 3600.0, "Standing for this long: fine."}};
}

Result<MissionWay> MissionWay::make(const std::string& owner,
                                    const Parameters& given,
                                    const KnobSettings& knobs) {
  const auto refused = [&owner](const std::string& why) {
    return Error{ErrorCode::invalid_input, owner + ": " + why};
  };
  if (const Status status =
          require_knobs(owner, knobs, {"planner.budget", "map.resolution_m", "map.range_m"});
      !status) {
    return status.error();
  }
  MissionWay way{given, knobs, !knobs.spec("map.resolution_m")->legal.empty()};
  if (way.levels_m_.front() >= way.levels_m_.back()) {
    return refused("fine_m = " + std::to_string(way.levels_m_.front()) +
                   " must be below coarse_m = " + std::to_string(way.levels_m_.back()));
  }
  const double most_m = longest_m(given, knobs);
  if (way.least_range_m_ >= most_m) {
    return refused("least_range_m = " + std::to_string(way.least_range_m_) +
                   " must be below most_range_m = " + std::to_string(most_m));
  }
  way.ranges_m_ = ranges_between(way.least_range_m_, most_m);
  return way;
}

MissionWay::MissionWay(const Parameters& given, const KnobSettings& knobs, bool is_lattice)
    : is_lattice_{is_lattice},
      least_range_m_{given.number("least_range_m")},
      narrow_m_s_{given.number("narrow_m_s")},
      patience_s_{given.number("patience_s")},
      body_m_{given.number("body_m")},
      large_m_{is_lattice ? 0.5 * body_m_ : std::numeric_limits<double>::max()},
      full_budget_{knobs.value("planner.budget")},
      coarse_budget_{std::min(knobs.spec("planner.budget")->nearest(given.number("coarse_budget")),
                              full_budget_)},
      home_{knobs.value("map.resolution_m"), knobs.value("map.range_m"), 0.0},
      levels_m_{levels_of(given, *knobs.spec("map.resolution_m"))},
      resting_{given.number("rest_s")},
      passability_{passability(given)},
      sight_{least_range_m_} {}

Passability MissionWay::passability(const Parameters& given) const {
  PassabilitySettings passable;
  passable.body_m = body_m_;
  passable.least = from_seconds(given.number("min_fine_s"));
  passable.patience = from_seconds(patience_s_);
  if (is_lattice_) {
    passable.retry_m = large_m_;
    passable.near_m = near_m();
  }
  // In order even where `make` will refuse them.
  std::vector<double> levels_m = levels_m_;
  std::sort(levels_m.begin(), levels_m.end());
  return {passable, std::move(levels_m)};
}

double MissionWay::near_m() const {
  return least_range_m_ + 1.0;
}

double MissionWay::spacing_m() const {
  return is_lattice_ ? spacing_between_m : 0.0;
}

std::vector<SearchLevel> MissionWay::levels(double fine_s, double coarse_s) const {
  auto levels = levels_between(levels_m_, fine_s, coarse_s);
  // A mission that integrates farther than noise allows has a better camera.
  constexpr double noisy_m = 12.0;
  const double most_m = ranges_m_.back();
  for (SearchLevel& level : levels) {
    level.most_range_m =
        most_m <= noisy_m ? noise_free_m(level.resolution_m, least_range_m_) : most_m;
  }
  return levels;
}

Surroundings MissionWay::look(const Observation& seen, const MapSetting& in_force) {
  const Passability::Verdict way = passability_.judge(seen);
  const bool near = seen.speed_limit_m_s <= narrow_m_s_;
  Surroundings around = limits_of(seen);
  around.coarsest_m = levels_m_[way.coarsest_level];
  around.least_range_m = way.look_m;
  around.needs_top_clock = way.coarsest_level == 0 || near || seen.phase != MissionPhase::cruise;
  is_lattice_ ? limit_lattice(seen, near, in_force, around)
              : limit_two_levels(seen, near, in_force, around);
  return around;
}

void MissionWay::limit_lattice(const Observation& seen,
                               bool near,
                               const MapSetting& in_force,
                               Surroundings& around) {
  // The mission says so, from farther off than any gap shows; or a new goal asks for a plan.
  // Where it stands it waits for one, and what it is planned in must still be the map when it
  // comes.
  const bool cruises = seen.phase == MissionPhase::cruise;
  const bool waits = cruises && !(seen.speed_m_s > standing_m_s);
  around.coarsest_m = std::min(
      {around.coarsest_m, near || !cruises ? large_m_ : 1e9, waits ? in_force.resolution_m : 1e9});
  if (needs_finest(seen, near, in_force)) {
    around.coarsest_m = levels_m_.front();
  }
  // Ways among finest cells pass obstacles closer, bend more sharply and take longer to find: where
  // a computer is so quick that they cost no time, they still do no good that nothing asks for.
  around.finest_m = levels_m_[1] <= around.coarsest_m ? levels_m_[1] : 0.0;
  failed_.note(seen, in_force.resolution_m > large_m_);
  around.large_m = large_m_;
  around.large_j_m = failed_.per_m() * failed_plan_j;
  sight_.note(seen, in_force.range_m);
  around.sight_m = sight_.distance_m();
  around.most_response_s = patience_s_;  // Else it would be taken for stuck.
  around.needs_top_clock |= !flies_at_limit(seen);
}

// What shuts the way to a narrow place are the cells, which may be larger than its door: after one
// plan that failed it is looked for in the finest ones. And within, what seems clear for a moment
// is no reason to leave them: larger ones shut the door that the path leads through, and at this
// speed the finest ones cost no time.
bool MissionWay::needs_finest(const Observation& seen, bool near, const MapSetting& in_force) {
  seeks_door_ = near && (seeks_door_ || seen.planner_failures > 0);
  const bool is_within =
      near && seen.speed_m_s <= narrow_m_s_ && !(in_force.resolution_m > levels_m_.front());
  return seeks_door_ || is_within;
}

void MissionWay::limit_two_levels(const Observation& seen,
                                  bool near,
                                  const MapSetting& in_force,
                                  Surroundings& around) const {
  constexpr double no_limit = std::numeric_limits<double>::max();
  const bool fine = around.coarsest_m <= levels_m_.front();
  // Noise from afar opens and closes gaps: what is narrow is looked at from nearby only.
  const bool from_nearby = (fine || near) && !(around.least_range_m > 0.0);
  around.most_range_m = from_nearby ? least_range_m_ : no_limit;
  // Free nearly up to the end of the range: a longer one would show more.
  constexpr double nearly_m = 1.5;
  const bool world_ends_it = fine && !(seen.known_free_m >= in_force.range_m - nearly_m);
  around.sight_m = world_ends_it ? least_range_m_ : no_limit;
}

double MissionWay::plan_budget(const Observation& seen, double resolution_m) const {
  return resolution_m > large_m_ ? coarse_budget_ : fine_budget(seen);
}

Decision MissionWay::wish(const Observation& seen, const MapSetting& setting) const {
  Decision wish;
  wish.reason = Reason::energy;
  wish.set("map.resolution_m", setting.resolution_m);
  wish.set("map.range_m", setting.range_m);
  wish.set("cpu.frequency_hz", setting.clock_hz);
  wish.set("planner.budget", plan_budget(seen, setting.resolution_m));
  return wish;
}

/// A plan that is there is mostly found soon, one that is not costs the whole budget, and the
/// vehicle stands: begun anew with another seed and a newer map, and twice as long each time
/// (Luby, Sinclair and Zuckerman 1993, doi:10.1016/0020-0190(93)90029-9).
double MissionWay::fine_budget(const Observation& seen) const {
  if (!is_lattice_) {
    return full_budget_;
  }
  const double halvings = std::max(0.0, 2.0 - static_cast<double>(seen.planner_failures));
  return std::max(coarse_budget_, full_budget_ * std::pow(0.5, halvings));
}

}  // namespace flyball
