// SPDX-License-Identifier: BSD-3-Clause
//
// A bound for other policies to approach. It has the limits and prices of mission_energy, but knows
// the true durations of the jobs to come instead of learning them, and optimizes the next 60 m at
// once. Only a simulator can tell these durations (UsesForesight), so the policy is of no use in
// the field. Without them it decides like mission_energy, for the next metre.

#include "flyball/governors/energy_search.h"
#include "flyball/governors/policy.h"
#include "flyball/governors/policy_abilities.h"
#include "flyball/governors/search_space.h"
#include "flyball/runtime/registry.h"

#include "horizon_search.h"
#include "mission_energy/limited_search.h"
#include <algorithm>
#include <optional>
#include <utility>

namespace {

using flyball::MapSetting;
using flyball::Observation;
using flyball::Surroundings;

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
    auto all = flyball::MissionLimits::parameters();
    for (flyball::ParameterSpec& spec : all) {
      if (spec.name == "door_m") {
        spec.fallback = 0.0;  // The horizon is searched in one finest level.
      }
    }
    all.push_back({"fine_latency_s", 0.5, 0.001, 60.0, "Sensor to map, 7 m, top clock; untold."});
    all.push_back({"coarse_latency_s", 0.12, 0.001, 60.0, "The same of the coarse map."});
    return all;
  }

  flyball::Status start(const flyball::Parameters& given,
                        const flyball::KnobSettings& knobs,
                        const flyball::BoardModel& board) override {
    auto made = flyball::LimitedSearch::make("policy \"reference\"", given, knobs, board,
                                             flyball::EnergySearchSettings{});
    if (!made) {
      return made.error();
    }
    levels_m_ = made->search.cells_m();
    limits_.emplace(std::move(made->limits));
    search_.emplace(std::move(made->search));
    horizon_.emplace(flyball::HorizonSettings{}, *search_);
    around_.resize(flyball::HorizonSettings{}.places);
    return flyball::Done{};
  }

  [[nodiscard]] std::vector<MapSetting> foresees() const override { return horizon_->points(); }
  void foretell(const flyball::Foresight& truth) noexcept override { truth_ = &truth; }

  [[nodiscard]] flyball::Decision decide(const Observation& seen) noexcept override {
    search_->learn(seen);
    const MapSetting best = chosen(seen);
    truth_ = nullptr;
    return flyball::decision_for(best);
  }

  [[nodiscard]] std::vector<flyball::PolicyOption> options() const override {
    return flyball::options_of(was_told_ ? horizon_->weighed() : search_->weighed());
  }

 private:
  [[nodiscard]] MapSetting chosen(const Observation& seen) noexcept {
    was_told_ = false;
    if (const auto within_s = limits_->idle_map_s(seen)) {
      const MapSetting& home = limits_->home();
      return search_->idle(home.resolution_m, home.range_m, *within_s, limits_->idle_raised_by(),
                           seen.now);
    }
    const Surroundings here = limits_->look(seen, search_->in_force());
    if (truth_ != nullptr && truth_->places.size() >= 2 &&
        truth_->places.size() <= around_.size() && truth_->is_whole(horizon_->points().size())) {
      look_ahead(seen, here);
      if (const auto best = horizon_->choose(*search_, *truth_, around_, seen.speed_m_s)) {
        was_told_ = true;
        search_->put_in_force(best->setting, seen.now);
        return best->setting;
      }
    }
    return search_->choose(here, seen.now).setting;
  }

  /// The limits here are those of MissionLimits with its memory; farther on they are what the map
  /// shows now.
  void look_ahead(const Observation& seen, const Surroundings& here) noexcept {
    const auto& places = truth_->places;
    for (std::size_t i = 0; i < places.size(); ++i) {
      around_[i] = here;
      if (i == 0) {
        continue;
      }
      Surroundings& there = around_[i];
      const bool is_near = places[i].ahead_m <= limits_->near_m();
      there.least_range_m = is_near ? here.least_range_m : 0.0;
      there.speed_limit_m_s =
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
      if (on_m >= -behind_m && on_m <= limits_->near_m()) {
        coarsest_m = std::min(coarsest_m, open_m(other.opening_m, seen.map_resolution_m));
      }
      const bool is_beside = on_m >= 0.0 && on_m <= look_ahead_m && other.obstacle_m < beside_m;
      const bool is_slow =
          on_m >= 0.0 && on_m <= zone_ahead_m && other.speed_limit_m_s <= limits_->narrow_m_s();
      if (is_beside || is_slow) {
        coarsest_m = std::min(coarsest_m, limits_->large_m());
      }
    }
    return coarsest_m;
  }

  /// The largest cells that leave this opening wide enough, as in Passability.
  [[nodiscard]] double open_m(double opening_m, double map_resolution_m) const noexcept {
    for (std::size_t i = levels_m_.size(); i-- > 1;) {
      const double r_m = levels_m_[i];
      const double least_m = limits_->body_m() + 2.0 * r_m;
      if (flyball::left_of_gap_m(opening_m, r_m, map_resolution_m) >= least_m) {
        return r_m;
      }
    }
    return levels_m_.front();
  }

  std::vector<double> levels_m_{};
  std::optional<flyball::MissionLimits> limits_{};
  std::optional<flyball::EnergySearch> search_{};
  std::optional<flyball::HorizonSearch> horizon_{};
  std::vector<Surroundings> around_{};
  const flyball::Foresight* truth_{};
  bool was_told_{};
};

}  // namespace

FLYBALL_PLUGIN(reference) {
  registry.add<flyball::Policy>("reference", [] { return std::make_unique<Reference>(); });
}
