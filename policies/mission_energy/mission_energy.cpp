// SPDX-License-Identifier: BSD-3-Clause
//
// The least energy per metre of progress. MissionLimits says which settings the path ahead allows;
// EnergySearch compares the settings of map and clock, and learns latency and rotor power in
// flight. While the vehicle is idle, only the clock is chosen. ViewBudget says how long a vehicle
// that explores looks for its next view.

#include "flyball/governors/energy_search.h"
#include "flyball/governors/policy.h"
#include "flyball/governors/policy_abilities.h"
#include "flyball/governors/search_space.h"
#include "flyball/runtime/registry.h"

#include "ablation.h"
#include "limited_search.h"
#include "view_budget.h"
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace {

using flyball::MapSetting;
using flyball::Observation;

class MissionEnergy final : public flyball::Policy,
                            public flyball::BoundsLatency,
                            public flyball::ComparesOptions {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    auto all = flyball::MissionLimits::parameters();
    const std::vector<flyball::ParameterSpec> own{
        {"fine_latency_s", 0.5, 0.001, 60.0, "Sensor to map, 7 m, top clock; learned later."},
        {"coarse_latency_s", 0.12, 0.001, 60.0, "The same of the coarse map."},
        {"alpha", 0.05, 0.001, 0.5, "Share of maps that may come later than bounded."},
        {"margin", 0.0, 0.0, 100.0, "Bound over prediction; 0: calibrated in flight."},
        {"learn_s", 0.0, 0.0, 1e6, "Latency is learned for so long; 0: all the time."},
        {"half_view_nodes", 0.35, 0.0, 1000.0,
         "Nodes with which an explorer's view shows half of what the best would; 0: as set."},
        {"deceleration_m_s2", 0.0, 0.0, 20.0, "Of eq. 2; 0: as the mission brakes."}};
    all.insert(all.end(), own.begin(), own.end());
    all.push_back(flyball::Ablation::parameter());
    return all;
  }

  flyball::Status start(const flyball::Parameters& all,
                        const flyball::KnobSettings& knobs,
                        const flyball::BoardModel& board) override {
    without_.emplace(all);
    const flyball::Parameters given = without_->begins_with(all, parameters());
    deceleration_m_s2_ = given.number("deceleration_m_s2");
    auto made = flyball::LimitedSearch::make(std::string{self}, given, knobs,
                                             without_->begins_with(board), search_settings(given));
    if (!made) {
      return made.error();
    }
    const bool can_explore = knobs.spec("explore.iterations") != nullptr;
    if (const double half = given.number("half_view_nodes"); can_explore && half > 0.0) {
      views_.emplace(half);
    }
    limits_.emplace(std::move(made->limits));
    search_.emplace(std::move(made->search));
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Decision decide(const Observation& all) noexcept override {
    constexpr std::size_t every_step = 1000;  // More than any computer has clocks.
    const Observation seen = without_->seen(all);
    search_->learn(seen);
    const auto within_s = limits_->idle_map_s(seen);
    const MapSetting& home = limits_->home();
    const std::size_t raised_by =
        without_->keeps_top_clock() ? every_step : limits_->idle_raised_by();
    const MapSetting best =
        within_s ? search_->idle(home.resolution_m, home.range_m, *within_s, raised_by, seen.now)
                 : search_->choose(surroundings(seen), seen.now).setting;
    flyball::Decision wish = flyball::decision_for(best);
    if (views_ && flyball::explores(seen)) {
      views_->note(seen);
      wish.set("explore.iterations", views_->nodes());
    }
    return wish;
  }

  [[nodiscard]] flyball::BoundCount bounds() const noexcept override { return search_->bounds(); }
  [[nodiscard]] std::vector<flyball::LevelBounds> bound_levels() const override {
    return search_->bound_levels();
  }

  [[nodiscard]] std::vector<flyball::PolicyOption> options() const override {
    return flyball::options_of(search_->weighed());
  }

 private:
  static constexpr const char* self = "policy \"mission_energy\"";

  [[nodiscard]] flyball::Result<flyball::EnergySearchSettings> search_settings(
      const flyball::Parameters& given) const {
    flyball::EnergySearchSettings settings = without_->begins_with(flyball::EnergySearchSettings{});
    settings.bound.alpha = given.number("alpha");
    settings.learn_s = given.number("learn_s");
    if (const double margin = given.number("margin"); margin != 0.0) {
      if (margin < 1.0) {
        return flyball::Error{flyball::ErrorCode::invalid_input,
                              std::string{self} + ": margin = " + std::to_string(margin) +
                                  " must be at least 1, or 0"};
      }
      settings.bound.first = std::log(margin);
      settings.bound.eta = 0.0;
    }
    return settings;
  }

  [[nodiscard]] flyball::Surroundings surroundings(const Observation& seen) noexcept {
    flyball::Surroundings around = limits_->look(seen, search_->in_force());
    if (deceleration_m_s2_ > 0.0) {
      around.deceleration_m_s2 = deceleration_m_s2_;
    }
    without_->limit(around, *search_);
    return around;
  }

  double deceleration_m_s2_{};
  std::optional<flyball::Ablation> without_{};
  std::optional<flyball::MissionLimits> limits_{};
  std::optional<flyball::EnergySearch> search_{};
  std::optional<flyball::ViewBudget> views_{};  ///< Empty where that knob is not to be turned.
};

}  // namespace

FLYBALL_PLUGIN(mission_energy) {
  registry.add<flyball::Policy>("mission_energy", [] { return std::make_unique<MissionEnergy>(); });
}
