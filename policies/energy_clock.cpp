// SPDX-License-Identifier: BSD-3-Clause
//
// Sets the clock alone, with the model of mission_energy, beside an application that sets its map
// itself. It takes the clock with the least energy per metre for the cells in force, but only where
// nothing but the map holds the vehicle up, and only if that saves more than the mission could lose
// by waiting longer for everything else that it computes. While the vehicle is idle, it takes the
// lowest clock that makes maps soon enough.

#include "flyball/governors/energy_search.h"
#include "flyball/governors/idle.h"
#include "flyball/governors/policy.h"
#include "flyball/governors/policy_abilities.h"
#include "flyball/governors/required_knobs.h"
#include "flyball/governors/required_power.h"
#include "flyball/governors/search_space.h"
#include "flyball/governors/waiting_share.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

namespace {

using flyball::MissionPhase;
using flyball::Observation;

class EnergyClock final : public flyball::Policy, public flyball::BoundsLatency {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"fine_latency_s", 0.5, 0.001, 60.0,
             "Sensor to map, .15 m, 7 m, top clock; learned later."},
            {"coarse_latency_s", 0.12, 0.001, 60.0, "The same of the coarsest map."},
            {"rest_s", 1.0, 0.01, 3600.0,
             "While the vehicle waits, a map may take so long, unless the mission says."}};
  }

  flyball::Status start(const flyball::Parameters& given,
                        const flyball::KnobSettings& knobs,
                        const flyball::BoardModel& board) override {
    if (flyball::Status status =
            flyball::require_knobs("policy \"energy_clock\"", knobs,
                                   {"map.resolution_m", "map.range_m", "cpu.frequency_hz"});
        !status) {
      return status;
    }
    const auto power = flyball::required_power("policy \"energy_clock\"", board);
    if (!power) {
      return power.error();
    }
    const flyball::KnobSpec& cells = *knobs.spec("map.resolution_m");
    std::vector<double> cells_m = cells.legal;
    if (cells_m.empty()) {  // Those that presets have, and the scenario's own.
      const std::set<double> usual_m{0.15, 0.30, 0.60, 0.80, 1.20, knobs.value(cells.name)};
      std::copy_if(usual_m.begin(), usual_m.end(), std::back_inserter(cells_m),
                   [&](double one_m) { return cells.is_legal(one_m); });
    }
    range_m_ = knobs.value("map.range_m");
    const auto levels = flyball::levels_between(cells_m, given.number("fine_latency_s"),
                                                given.number("coarse_latency_s"));
    flyball::EnergySearchSettings settings;
    settings.reaction_s = flyball::to_seconds(board.vehicle.reaction_time);
    auto search = flyball::EnergySearch::make(settings, levels, {range_m_}, knobs, *power);
    if (!search) {
      return flyball::Error{search.error().code,
                            "policy \"energy_clock\": " + search.error().message};
    }
    search_.emplace(std::move(*search));
    idle_.emplace(given.number("rest_s"));
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Decision decide(const Observation& seen) noexcept override {
    search_->learn(seen);
    waiting_.note(seen);
    flyball::Decision wish;
    wish.reason = flyball::Reason::energy;
    wish.set("cpu.frequency_hz", clock_hz(seen));
    return wish;
  }

  [[nodiscard]] flyball::BoundCount bounds() const noexcept override { return search_->bounds(); }
  [[nodiscard]] std::vector<flyball::LevelBounds> bound_levels() const override {
    return search_->bound_levels();
  }

 private:
  [[nodiscard]] double clock_hz(const Observation& seen) noexcept {
    const double cells_m = search_->nearest_cells_m(seen.map_resolution_m);
    if (const auto within_s = idle_->allowed_s(seen)) {
      return search_->idle(cells_m, range_m_, *within_s, idle_->raised_by(), seen.now).clock_hz;
    }
    flyball::Surroundings around = flyball::limits_of(seen);
    // Indoors paths are short and walls end the view, so latency limits the speed long before the
    // map's range does.
    around.visibility_m = flyball::shown_free_m(seen);
    around.coarsest_m = around.finest_m = cells_m;
    around.needs_top_clock = flyball::is_held_up(seen) || seen.planner_failures > 0;
    around.waits = waiting_;
    return search_->choose(around, seen.now).setting.clock_hz;
  }

  double range_m_{};
  std::optional<flyball::EnergySearch> search_{};
  std::optional<flyball::Idle> idle_{};
  flyball::WaitingShare waiting_{};
};

}  // namespace

FLYBALL_PLUGIN(energy_clock) {
  registry.add<flyball::Policy>("energy_clock", [] { return std::make_unique<EnergyClock>(); });
}
