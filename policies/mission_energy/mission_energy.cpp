// SPDX-License-Identifier: BSD-3-Clause
//
// The map by a rule, and the clock with the least energy per metre for that map. MapRule says which
// cells and which range the path ahead asks for; ClockSearch compares the clocks, and learns
// latency, its bound and rotor power in flight. While the vehicle is idle, the scenario's map stays
// and only the clock is chosen. ViewBudget says how long a vehicle that explores looks for its next
// view, and all cores look for it: those that other jobs need are theirs first.

#include "flyball/governors/clock_search.h"
#include "flyball/governors/policy.h"
#include "flyball/governors/policy_abilities.h"
#include "flyball/governors/required_knobs.h"
#include "flyball/governors/required_power.h"
#include "flyball/runtime/registry.h"
#include "flyball/runtime/text/number_text.h"

#include "ablation.h"
#include "map_rule.h"
#include "view_budget.h"
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace {

using flyball::MapSetting;
using flyball::Observation;

// Chosen. A vehicle of 350 W saves at most 1 % in the open. Among obstacles it loses more than
// that, because later maps show the way later: into a building with depth noise, the top clock
// takes .94 [.88, .99] of the energy (n 12).
constexpr double least_saving = 0.02;

class MissionEnergy final : public flyball::Policy,
                            public flyball::BoundsLatency,
                            public flyball::ComparesOptions {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    auto all = flyball::MapRule::parameters();
    const std::vector<flyball::ParameterSpec> own{
        {"fine_latency_s", 0.5, 0.001, 60.0, "Sensor to map, 7 m, top clock; learned later."},
        {"coarse_latency_s", 0.12, 0.001, 60.0, "The same of the coarse map."},
        {"rest_s", 1.0, 0.01, 3600.0,
         "While the vehicle waits, a map may take so long, unless the mission says."},
        {"alpha", 0.05, 0.001, 0.5, "Share of maps that may come later than bounded."},
        {"margin", 0.0, 0.0, 100.0, "Bound over prediction; 0: calibrated in flight."},
        {"learn_s", 0.0, 0.0, 1e6, "Latency is learned for so long; 0: all the time."},
        {"half_view_nodes", 0.35, 0.0, 1000.0,
         "Nodes with which an explorer's view shows half of what the best would; 0: as set."},
        {"view_threads", 0.0, 0.0, 16.0, "So many look for a view at once; 0: one for each core."}};
    all.insert(all.end(), own.begin(), own.end());
    all.push_back(flyball::Ablation::parameter());
    return all;
  }

  flyball::Status start(const flyball::Parameters& all,
                        const flyball::KnobSettings& knobs,
                        const flyball::BoardModel& board) override {
    without_.emplace(all);
    const flyball::Parameters given = without_->begins_with(all, parameters());
    if (flyball::Status status = flyball::require_knobs(
            self, knobs, {"map.resolution_m", "map.range_m", "cpu.frequency_hz"});
        !status) {
      return status;
    }
    const auto power = flyball::required_power(self, board);
    if (!power) {
      return power.error();
    }
    auto map = flyball::MapRule::make(self, given, knobs, without_->begins_with(board).vehicle);
    if (!map) {
      return map.error();
    }
    auto settings = clock_settings(given, board);
    if (!settings) {
      return settings.error();
    }
    settings->latency.frame_s = flyball::frame_interval_s(board.vehicle.depth_camera, knobs);
    const auto levels =
        map->levels(given.number("fine_latency_s"), given.number("coarse_latency_s"));
    auto clock = flyball::ClockSearch::make(*settings, levels, knobs, *power);
    if (!clock) {
      return flyball::Error{clock.error().code, std::string{self} + ": " + clock.error().message};
    }
    const double half = given.number("half_view_nodes");
    if (knobs.spec("explore.iterations") != nullptr && half > 0.0) {
      views_.emplace(half);
    }
    shares_views_ = knobs.spec("explore.threads") != nullptr;
    view_threads_ = given.number("view_threads");
    map_.emplace(std::move(*map));
    clock_.emplace(std::move(*clock));
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Decision decide(const Observation& all) noexcept override {
    const Observation seen = without_->seen(all);
    clock_->learn(seen);
    flyball::Decision wish = flyball::decision_for(chosen(seen));
    if (flyball::explores(seen)) {
      look_for_views(seen, wish);
    }
    return wish;
  }

  [[nodiscard]] flyball::BoundCount bounds() const noexcept override {
    return clock_->latency().bounds();
  }
  [[nodiscard]] std::vector<flyball::LevelBounds> bound_levels() const override {
    return clock_->latency().bound_levels();
  }

  [[nodiscard]] std::vector<flyball::PolicyOption> options() const override {
    return flyball::options_of(clock_->weighed());
  }

 private:
  static constexpr const char* self = "policy \"mission_energy\"";

  [[nodiscard]] flyball::Result<flyball::ClockSearchSettings> clock_settings(
      const flyball::Parameters& given, const flyball::BoardModel& board) const {
    flyball::ClockSearchSettings settings;
    settings.reaction_s = flyball::to_seconds(board.vehicle.reaction_time);
    settings.rest_s = given.number("rest_s");
    settings.least_saving = least_saving;
    settings.latency = without_->begins_with(settings.latency);
    settings.latency.bound.alpha = given.number("alpha");
    settings.latency.learn_s = given.number("learn_s");
    if (const double margin = given.number("margin"); margin != 0.0) {
      if (margin < 1.0) {
        return flyball::Error{flyball::ErrorCode::invalid_input,
                              std::string{self} + ": margin = " +
                                  flyball::short_number_text(margin) + " must be at least 1, or 0"};
      }
      settings.latency.bound.first = std::log(margin);
      settings.latency.bound.eta = 0.0;
    }
    return settings;
  }

  void look_for_views(const Observation& seen, flyball::Decision& wish) noexcept {
    if (views_) {
      views_->note(seen);
      wish.set("explore.iterations", views_->nodes());
    }
    const double threads = view_threads_ > 0.0 ? view_threads_ : seen.cores;
    if (shares_views_ && threads >= 1.0) {
      wish.set("explore.threads", threads);
    }
  }

  [[nodiscard]] MapSetting chosen(const Observation& seen) noexcept {
    const bool keeps_top = without_->keeps_top_clock();
    if (const auto within_s = clock_->idle_map_s(seen)) {
      const MapSetting& home = map_->home();
      return keeps_top ? clock_->choose(home, seen, true) : clock_->rest(home, *within_s, seen.now);
    }
    const flyball::MapNeeds needs = map_->look(seen, clock_->in_force().resolution_m);
    const MapSetting map = without_->map(*map_, needs, clock_->latency());
    return clock_->choose(map, seen, keeps_top || needs.needs_top_clock);
  }

  std::optional<flyball::Ablation> without_{};
  std::optional<flyball::MapRule> map_{};
  std::optional<flyball::ClockSearch> clock_{};
  std::optional<flyball::ViewBudget> views_{};  ///< Empty where that knob is not to be turned.
  bool shares_views_{};
  double view_threads_{};
};

}  // namespace

FLYBALL_PLUGIN(mission_energy) {
  registry.add<flyball::Policy>("mission_energy", [] { return std::make_unique<MissionEnergy>(); });
}
