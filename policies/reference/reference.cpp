// SPDX-License-Identifier: BSD-3-Clause
//
// A bound for other policies to approach. It has the limits of mission_energy, but knows the true
// durations of the jobs to come instead of learning them, and compares all cells, ranges and clocks
// over the next 60 m at once. Only a simulator can tell these durations (UsesForesight), so the
// policy is of no use in the field. Without them it decides like mission_energy.

#include "flyball/governors/clock_search.h"
#include "flyball/governors/policy.h"
#include "flyball/governors/policy_abilities.h"
#include "flyball/runtime/registry.h"

#include "horizon_search.h"
#include "mission_energy/map_and_clock.h"
#include "visibility.h"
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace {

using flyball::MapSetting;
using flyball::Observation;
using flyball::PlaceLimits;

// The vehicle must be this far beyond a gap before the gap stops limiting the cell size (as in
// Passability).
constexpr double behind_m = 3.0;
// Observations count obstacles within this radius, here and up to this far ahead. Near them, large
// cells end known-free space earlier than the obstacles do.
constexpr double beside_m = 6.0;
constexpr double look_ahead_m = 12.0;
constexpr double zone_ahead_m = 20.0;  // Observations tell of speed limits up to here.

class Reference final : public flyball::Policy,
                        public flyball::ComparesOptions,
                        public flyball::UsesForesight {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    auto all = flyball::MapAndClock::parameters();
    for (flyball::ParameterSpec& spec : all) {
      if (spec.name == "door_m") {
        spec.fallback = 0.0;  // The horizon is searched in one finest level.
      }
    }
    return all;
  }

  flyball::Status start(const flyball::Parameters& given,
                        const flyball::KnobSettings& knobs,
                        const flyball::BoardModel& board) override {
    auto made = flyball::MapAndClock::make("policy \"reference\"", given, knobs, board,
                                           flyball::LearnedLatencySettings{});
    if (!made) {
      return made.error();
    }
    both_.emplace(std::move(*made));
    visibility_.emplace(both_->map.least_range_m());
    horizon_.emplace(flyball::HorizonSettings{}, both_->clock, points(knobs, board.vehicle));
    limits_.resize(flyball::HorizonSettings{}.places);
    return flyball::Done{};
  }

  [[nodiscard]] std::vector<MapSetting> foresees() const override { return horizon_->points(); }
  void foretell(const flyball::Foresight& truth) noexcept override { truth_ = &truth; }

  [[nodiscard]] flyball::Decision decide(const Observation& seen) noexcept override {
    both_->clock.learn(seen);
    const MapSetting best = chosen(seen);
    truth_ = nullptr;
    return flyball::decision_for(best);
  }

  [[nodiscard]] std::vector<flyball::PolicyOption> options() const override {
    return flyball::options_of(was_told_ ? horizon_->weighed() : both_->clock.weighed());
  }

 private:
  /// Each of the rule's cells with ranges from the shortest to the longest that it may have, and
  /// with each clock.
  [[nodiscard]] std::vector<MapSetting> points(const flyball::KnobSettings& knobs,
                                               const flyball::VehicleModel& vehicle) {
    const flyball::KnobSpec& range = *knobs.spec("map.range_m");
    const double camera_m = vehicle.depth_camera ? vehicle.depth_camera->max_range_m : range.max;
    std::vector<MapSetting> all;
    for (const flyball::LatencyLevel& level :
         both_->map.levels(1.0, 1.0)) {  // Only the cells count.
      levels_m_.push_back(level.resolution_m);
      const double most_m = both_->map.most_range_m(level.resolution_m);
      for (const double range_m : ranges_m(std::min({most_m, camera_m, range.max}))) {
        for (const double clock_hz : both_->clock.clocks_hz()) {
          all.push_back({level.resolution_m, range.nearest(range_m), clock_hz});
        }
      }
    }
    return all;
  }

  /// Ranges with equal ratios between them, because latency grows with a power of the range.
  [[nodiscard]] std::vector<double> ranges_m(double most_m) const {
    constexpr double shortest_m = 2.0;
    constexpr double ratio = 1.4;  // Chosen: seven ranges between 2 and 20 m.
    std::vector<double> all_m;
    for (double one_m = shortest_m; one_m < most_m / std::sqrt(ratio); one_m *= ratio) {
      all_m.push_back(one_m);
    }
    all_m.push_back(most_m);
    return all_m;
  }

  [[nodiscard]] MapSetting chosen(const Observation& seen) noexcept {
    flyball::ClockSearch& clock = both_->clock;
    was_told_ = false;
    visibility_->note(seen, clock.in_force().range_m);
    if (const auto within_s = clock.idle_map_s(seen)) {
      return clock.rest(both_->map.home(), *within_s, seen.now);
    }
    const flyball::MapNeeds needs = both_->map.look(seen, clock.in_force().resolution_m);
    if (truth_ != nullptr && truth_->places.size() >= 2 &&
        truth_->places.size() <= limits_.size() && truth_->is_whole(horizon_->points().size())) {
      look_ahead(seen, needs);
      if (const auto best = horizon_->choose(clock, *truth_, limits_, seen.speed_m_s)) {
        was_told_ = true;
        clock.put_in_force(best->setting, seen.now);
        return best->setting;
      }
    }
    return clock.choose(both_->map.setting(needs), seen, needs.needs_top_clock);
  }

  /// The limits here are those of MapRule with its memory; farther on they are what the map shows
  /// now.
  void look_ahead(const Observation& seen, const flyball::MapNeeds& needs) noexcept {
    const auto& places = truth_->places;
    PlaceLimits here;
    here.around = flyball::surroundings_of(seen);
    here.around.visibility_m = visibility_->distance_m();
    here.coarsest_m = needs.cells_m;
    here.least_range_m = needs.least_range_m;
    here.most_response_s =
        both_->map.patience_s();  // Later ones would make the vehicle look stuck.
    here.needs_top_clock = needs.needs_top_clock || flyball::is_held_up(seen);
    limits_[0] = here;
    for (std::size_t i = 1; i < places.size(); ++i) {
      PlaceLimits& there = limits_[i];
      there = here;
      const bool is_near = places[i].ahead_m <= both_->map.near_m();
      there.least_range_m = is_near ? here.least_range_m : 0.0;
      there.around.speed_limit_m_s =
          std::min(places[i].speed_limit_m_s, flyball::HorizonSettings{}.most_speed_m_s);
      there.coarsest_m = std::min(is_near ? here.coarsest_m : 1e9, coarsest_m(seen, i));
      there.needs_top_clock = there.coarsest_m <= levels_m_.front();
    }
  }

  /// Cells that leave every gap open of which maps must show the inside, from here.
  [[nodiscard]] double coarsest_m(const Observation& seen, std::size_t place) const noexcept {
    const auto& places = truth_->places;
    double coarsest_m = levels_m_.back();
    for (const flyball::PlaceAhead& other : places) {
      const double on_m = other.ahead_m - places[place].ahead_m;
      if (on_m >= -behind_m && on_m <= both_->map.near_m()) {
        coarsest_m = std::min(coarsest_m, open_m(other.opening_m, seen.map_resolution_m));
      }
      const bool is_beside = on_m >= 0.0 && on_m <= look_ahead_m && other.obstacle_m < beside_m;
      const bool is_slow =
          on_m >= 0.0 && on_m <= zone_ahead_m && other.speed_limit_m_s <= both_->map.narrow_m_s();
      if (is_beside || is_slow) {
        coarsest_m = std::min(coarsest_m, both_->map.large_m());
      }
    }
    return coarsest_m;
  }

  /// The largest cells that leave this opening wide enough, as in Passability.
  [[nodiscard]] double open_m(double opening_m, double map_resolution_m) const noexcept {
    for (std::size_t i = levels_m_.size(); i-- > 1;) {
      const double r_m = levels_m_[i];
      const double least_m = both_->map.body_m() + 2.0 * r_m;
      if (flyball::left_of_gap_m(opening_m, r_m, map_resolution_m) >= least_m) {
        return r_m;
      }
    }
    return levels_m_.front();
  }

  std::vector<double> levels_m_{};
  std::optional<flyball::MapAndClock> both_{};
  std::optional<flyball::Visibility> visibility_{};
  std::optional<flyball::HorizonSearch> horizon_{};
  std::vector<PlaceLimits> limits_{};
  const flyball::Foresight* truth_{};
  bool was_told_{};
};

}  // namespace

FLYBALL_PLUGIN(reference) {
  registry.add<flyball::Policy>("reference", [] { return std::make_unique<Reference>(); });
}
