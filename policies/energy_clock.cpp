// SPDX-License-Identifier: BSD-3-Clause
//
// Sets the clock alone, with the model of mission_energy, beside an application that sets its map
// itself. It takes the clock with the least energy per metre for the cells in force, but only where
// nothing but the map holds the vehicle up, and only if that saves more than the mission could lose
// by waiting longer for everything else that it computes. While the vehicle is idle, it takes the
// lowest clock that makes maps soon enough.

#include "flyball/governors/clock_search.h"
#include "flyball/governors/policy.h"
#include "flyball/governors/policy_abilities.h"
#include "flyball/governors/required_knobs.h"
#include "flyball/governors/required_power.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>

namespace {

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
    map_ = {knobs.value(cells.name), knobs.value("map.range_m"), 0.0};
    flyball::ClockSearchSettings settings;
    settings.reaction_s = flyball::to_seconds(board.vehicle.reaction_time);
    settings.rest_s = given.number("rest_s");
    settings.latency.frame_s = flyball::frame_interval_s(board.vehicle.depth_camera, knobs);
    const auto levels = flyball::levels_between(cells_m, given.number("fine_latency_s"),
                                                given.number("coarse_latency_s"));
    auto search = flyball::ClockSearch::make(settings, levels, knobs, *power);
    if (!search) {
      return flyball::Error{search.error().code,
                            "policy \"energy_clock\": " + search.error().message};
    }
    search_.emplace(std::move(*search));
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Decision decide(const Observation& seen) noexcept override {
    search_->learn(seen);
    flyball::Decision wish;
    wish.reason = flyball::Reason::energy;
    wish.set("cpu.frequency_hz", clock_hz(seen));
    return wish;
  }

  [[nodiscard]] flyball::BoundCount bounds() const noexcept override {
    return search_->latency().bounds();
  }
  [[nodiscard]] std::vector<flyball::LevelBounds> bound_levels() const override {
    return search_->latency().bound_levels();
  }

 private:
  [[nodiscard]] double clock_hz(const Observation& seen) noexcept {
    // The application's own cells, which need not be those of a level: a map counts for the latency
    // of the cells that are in force only.
    if (std::isfinite(seen.map_resolution_m) && seen.map_resolution_m > 0.0) {
      map_.resolution_m = seen.map_resolution_m;
    }
    if (flyball::is_a_range(seen.map_range_m)) {
      map_.range_m = seen.map_range_m;
    }
    if (const auto within_s = search_->idle_map_s(seen)) {
      return search_->rest(map_, *within_s, seen.now).clock_hz;
    }
    return search_->choose(map_, seen, seen.planner_failures > 0).clock_hz;
  }

  flyball::MapSetting map_{};  ///< The scenario's, until a map tells its own.
  std::optional<flyball::ClockSearch> search_{};
};

}  // namespace

FLYBALL_PLUGIN(energy_clock) {
  registry.add<flyball::Policy>("energy_clock", [] { return std::make_unique<EnergyClock>(); });
}
