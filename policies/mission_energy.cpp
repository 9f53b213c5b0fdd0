// SPDX-License-Identifier: BSD-3-Clause
//
// The least joules per metre of progress. EnergySearch looks through settings of map and clock;
// this file says what the way ahead allows:
// - The coarsest passable cell. A door is shut in a coarse map, and the finer one needs frames
//   before the gap is reached, so the density of obstacles is looked at around the vehicle and
//   ahead on the committed path. A plan that failed asks for the fine map too; so does a vehicle
//   that stands before something: with the coarse map alone it would stand there for ever.
// - Sight: where the world ends what is known to be free, a longer range buys nothing.
// - The mission's own limit of speed, at which latency is worth nothing.

#include "flyball/governors/energy_search.h"
#include "flyball/governors/policy.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace {

using flyball::Duration;
using flyball::MapSetting;
using flyball::MissionTime;
using flyball::Observation;

/// Hysteresis in density and time: when must the map be fine?
class Passability {
 public:
  struct Thresholds {
    double enter{};
    double leave{};
  };
  struct Settings {
    Thresholds open{};
    Thresholds narrow{};  ///< Near places that the mission declares narrow.
    double enter_ahead{};
    Duration least{};
    Duration patience{};  ///< Standing in cruise.
  };
  Passability() = default;
  explicit Passability(const Settings& settings) : settings_{settings} {}

  [[nodiscard]] bool needs_fine(const Observation& seen, bool is_near_narrow) {
    const Thresholds& density = is_near_narrow ? settings_.narrow : settings_.open;
    const bool enters = seen.obstacle_density >= density.enter ||
                        seen.density_ahead >= settings_.enter_ahead || seen.planner_failures > 0 ||
                        is_stuck(seen);
    const bool leaves =
        seen.obstacle_density <= density.leave && !(seen.density_ahead >= settings_.enter_ahead);
    if (enters) {
      fine_since_ = fine_since_.value_or(seen.now);
    } else if (fine_since_ && leaves && seen.now - *fine_since_ >= settings_.least) {
      fine_since_.reset();
    }
    return fine_since_.has_value();
  }

 private:
  [[nodiscard]] bool is_stuck(const Observation& seen) {
    const bool stands = seen.phase == flyball::MissionPhase::cruise && !(seen.speed_m_s > 0.1);
    standing_since_ = stands ? standing_since_.value_or(seen.now) : std::optional<MissionTime>{};
    return stands && seen.now - *standing_since_ >= settings_.patience;
  }

  Settings settings_{};
  std::optional<MissionTime> fine_since_{};
  std::optional<MissionTime> standing_since_{};
};

// Where an RGB-D camera's noise, .0657 d - .4193 beyond 6 m (MAVBench's code), is half a cell.
// Farther off it fills the cells beside an obstacle too, and closes gaps.
double noise_free_m(double resolution_m, double least_m) {
  return std::max(least_m, (0.5 * resolution_m + 0.4193) / 0.0657);
}

class MissionEnergy final : public flyball::Policy {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    // Densities are shares of .8 m columns within 6 m. At 12 m of range depth noise makes a single
    // block up to .15; rooms have .085-.20, a facade that is seen whole .19.
    return {{"fine_m", 0.15, 0.05, 2.0, "Resolution that passes every gap of the mission."},
            {"coarse_m", 0.80, 0.05, 2.0, "Resolution for the open."},
            {"least_range_m", 7.0, 0.5, 100.0, "Shortest range of the map."},
            {"most_range_m", 12.0, 0.5, 100.0, "Longest range of the map."},
            {"narrow_m_s", 2.0, 0.0, 50.0, "A limit of speed, 20 m ahead, that means narrow gaps."},
            {"enter_density", 0.06, 0.0, 1.0, "Near narrow gaps, at or above: fine."},
            {"leave_density", 0.045, 0.0, 1.0, "Near narrow gaps, at or below: coarse."},
            {"enter_open", 0.16, 0.0, 1.0, "Elsewhere, at or above: fine."},
            {"leave_open", 0.12, 0.0, 1.0, "Elsewhere, at or below: coarse."},
            {"enter_ahead", 0.24, 0.0, 1.0, "Ahead on the path, at or above: fine."},
            {"min_fine_s", 2.0, 0.0, 3600.0, "Fine lasts at least this long."},
            {"fine_latency_s", 0.5, 0.001, 60.0, "Sensor to map, 7 m, top clock; learned later."},
            {"coarse_latency_s", 0.12, 0.001, 60.0, "The same of the coarse map."},
            {"patience_s", 3.0, 0.1, 3600.0, "Standing for this long: fine."},
            {"alpha", 0.05, 0.001, 0.5, "Share of maps that may come later than bounded."},
            {"deceleration_m_s2", 6.0, 0.1, 20.0, "Of eq. 2, as the mission brakes."}};
  }

  flyball::Status start(const flyball::Parameters& given,
                        const flyball::KnobSettings& knobs) override {
    flyball::EnergySearchSettings settings;
    settings.bound.alpha = given.number("alpha");
    settings.deceleration_m_s2 = given.number("deceleration_m_s2");
    fine_m_ = nearest_level(given.number("fine_m"), knobs);
    coarse_m_ = nearest_level(given.number("coarse_m"), knobs);
    if (fine_m_ >= coarse_m_) {
      return refused("fine_m = " + std::to_string(fine_m_) +
                     " must be below coarse_m = " + std::to_string(coarse_m_));
    }
    const double least_m = least_range_m_ = given.number("least_range_m");
    const double most_m = given.number("most_range_m");
    if (least_m >= most_m) {
      return refused("least_range_m = " + std::to_string(least_m) +
                     " must be below most_range_m = " + std::to_string(most_m));
    }
    const double step_m = (most_m - least_m) / 3.0;
    auto search = flyball::EnergySearch::make(
        settings,
        {{fine_m_, given.number("fine_latency_s"), 2.2, noise_free_m(fine_m_, least_m)},
         {coarse_m_, given.number("coarse_latency_s"), 1.0, noise_free_m(coarse_m_, least_m)}},
        {least_m, least_m + step_m, least_m + 2.0 * step_m, most_m}, knobs);
    if (!search) {
      return refused(search.error().message);
    }
    search_.emplace(std::move(*search));
    Passability::Settings passable;
    passable.narrow = {given.number("enter_density"), given.number("leave_density")};
    passable.open = {given.number("enter_open"), given.number("leave_open")};
    passable.enter_ahead = given.number("enter_ahead");
    narrow_m_s_ = given.number("narrow_m_s");
    passable.least = flyball::from_seconds(given.number("min_fine_s"));
    passable.patience = flyball::from_seconds(given.number("patience_s"));
    passability_ = Passability{passable};
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Decision decide(const Observation& seen) noexcept override {
    search_->learn(seen);
    const flyball::EnergyEstimate best = search_->choose(surroundings(seen), seen.now);
    flyball::Decision wish;
    wish.reason = flyball::Reason::energy;
    wish.set("map.resolution_m", best.setting.resolution_m);
    wish.set("map.range_m", best.setting.range_m);
    wish.set("cpu.frequency_hz", best.setting.clock_hz);
    return wish;
  }

 private:
  static flyball::Error refused(const std::string& why) {
    return {flyball::ErrorCode::invalid_input, "policy \"mission_energy\": " + why};
  }

  // A mapper may know certain cells only; the search needs one that it has.
  static double nearest_level(double wish_m, const flyball::KnobSettings& knobs) {
    const flyball::KnobSpec* spec = knobs.spec("map.resolution_m");
    return spec != nullptr ? spec->nearest(wish_m) : wish_m;
  }

  [[nodiscard]] flyball::Surroundings surroundings(const Observation& seen) noexcept {
    constexpr double usual_m_s = 10.0;
    const bool near = seen.speed_limit_m_s <= narrow_m_s_;
    const bool fine = passability_.needs_fine(seen, near);
    flyball::Surroundings around;
    around.coarsest_m = fine ? fine_m_ : coarse_m_;
    // Noise from afar opens and closes gaps: what is narrow is looked at from nearby only.
    around.most_range_m = fine || near ? least_range_m_ : std::numeric_limits<double>::max();
    around.needs_top_clock = fine || near || seen.phase != flyball::MissionPhase::cruise;
    const double limit_m_s = seen.speed_limit_m_s;
    around.speed_limit_m_s =
        std::isfinite(limit_m_s) && limit_m_s > 0.0 ? std::min(limit_m_s, 100.0) : usual_m_s;
    // Free nearly up to the end of the range: a longer one would show more.
    constexpr double nearly_m = 1.5;
    const MapSetting& now = search_->in_force();
    const bool world_ends_it = fine && !(seen.known_free_m >= now.range_m - nearly_m);
    around.sight_m = world_ends_it ? least_range_m_ : std::numeric_limits<double>::max();
    return around;
  }

  double fine_m_{};
  double coarse_m_{};
  double least_range_m_{};
  double narrow_m_s_{};
  std::optional<flyball::EnergySearch> search_{};
  Passability passability_{};
};

}  // namespace

FLYBALL_PLUGIN(mission_energy) {
  registry.add<flyball::Policy>("mission_energy", [] { return std::make_unique<MissionEnergy>(); });
}
