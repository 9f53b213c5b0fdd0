// SPDX-License-Identifier: BSD-3-Clause
//
// The map by a rule, and the clock with the least energy per metre for that map. MapRule says which
// cells and which range the path ahead asks for; ClockSearch compares the clocks, and learns
// latency, its bound and rotor power in flight. While the vehicle is idle, the scenario's map stays
// and only the clock is chosen. ViewBudget says how long a vehicle that explores looks for its next
// view.

#include "flyball/governors/clock_search.h"
#include "flyball/governors/policy.h"
#include "flyball/governors/policy_abilities.h"
#include "flyball/runtime/registry.h"

#include "ablation.h"
#include "map_and_clock.h"
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
    auto all = flyball::MapAndClock::parameters();
    const std::vector<flyball::ParameterSpec> own{
        {"alpha", 0.05, 0.001, 0.5, "Share of maps that may come later than bounded."},
        {"margin", 0.0, 0.0, 100.0, "Bound over prediction; 0: calibrated in flight."},
        {"learn_s", 0.0, 0.0, 1e6, "Latency is learned for so long; 0: all the time."},
        {"half_view_nodes", 0.35, 0.0, 1000.0,
         "Nodes with which an explorer's view shows half of what the best would; 0: as set."}};
    all.insert(all.end(), own.begin(), own.end());
    all.push_back(flyball::Ablation::parameter());
    return all;
  }

  flyball::Status start(const flyball::Parameters& all,
                        const flyball::KnobSettings& knobs,
                        const flyball::BoardModel& board) override {
    without_.emplace(all);
    const flyball::Parameters given = without_->begins_with(all, parameters());
    auto made = flyball::MapAndClock::make(std::string{self}, given, knobs,
                                           without_->begins_with(board), latency_settings(given));
    if (!made) {
      return made.error();
    }
    const bool can_explore = knobs.spec("explore.iterations") != nullptr;
    if (const double half = given.number("half_view_nodes"); can_explore && half > 0.0) {
      views_.emplace(half);
    }
    both_.emplace(std::move(*made));
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Decision decide(const Observation& all) noexcept override {
    const Observation seen = without_->seen(all);
    both_->clock.learn(seen);
    flyball::Decision wish = flyball::decision_for(chosen(seen));
    if (views_ && flyball::explores(seen)) {
      views_->note(seen);
      wish.set("explore.iterations", views_->nodes());
    }
    return wish;
  }

  [[nodiscard]] flyball::BoundCount bounds() const noexcept override {
    return both_->clock.latency().bounds();
  }
  [[nodiscard]] std::vector<flyball::LevelBounds> bound_levels() const override {
    return both_->clock.latency().bound_levels();
  }

  [[nodiscard]] std::vector<flyball::PolicyOption> options() const override {
    return flyball::options_of(both_->clock.weighed());
  }

 private:
  static constexpr const char* self = "policy \"mission_energy\"";

  [[nodiscard]] flyball::Result<flyball::LearnedLatencySettings> latency_settings(
      const flyball::Parameters& given) const {
    flyball::LearnedLatencySettings settings =
        without_->begins_with(flyball::LearnedLatencySettings{});
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

  [[nodiscard]] MapSetting chosen(const Observation& seen) noexcept {
    flyball::ClockSearch& clock = both_->clock;
    const bool keeps_top = without_->keeps_top_clock();
    if (const auto within_s = clock.idle_map_s(seen)) {
      const MapSetting& home = both_->map.home();
      return keeps_top ? clock.choose(home, seen, true) : clock.rest(home, *within_s, seen.now);
    }
    const flyball::MapNeeds needs = both_->map.look(seen, clock.in_force().resolution_m);
    const MapSetting map = without_->map(both_->map, needs);
    return clock.choose(map, seen, keeps_top || needs.needs_top_clock);
  }

  std::optional<flyball::Ablation> without_{};
  std::optional<flyball::MapAndClock> both_{};
  std::optional<flyball::ViewBudget> views_{};  ///< Empty where that knob is not to be turned.
};

}  // namespace

FLYBALL_PLUGIN(mission_energy) {
  registry.add<flyball::Policy>("mission_energy", [] { return std::make_unique<MissionEnergy>(); });
}
