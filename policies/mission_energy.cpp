// SPDX-License-Identifier: BSD-3-Clause
//
// The least joules per metre of progress. EnergySearch looks through settings of map and clock;
// this file says what the way ahead allows:
// - The coarsest cells that leave the narrowest gap ahead open (Passability).
// - The price of a failed plan: in coarse cells one that is not found soon is not there, and a long
//   search for it would keep the vehicle standing; so it gets a small budget there, and how often
//   that happens is a price of such cells (FailedPlans).
// - Sight: where the world ends what is known to be free, a longer range buys nothing.
// - The mission's own limit of speed, at which latency is worth nothing, but to see farther ahead
//   still makes the way shorter.
// Where the vehicle waits, or flies without a map, only the clock is left to save.
//
// A mapper with a lattice of cells keeps what was hit at its finest level, so finer cells are
// there when they are asked for. Others start a map of their own: with them, what is narrow is
// looked at from nearby only, and two levels are used.

#include "flyball/governors/energy_search.h"
#include "flyball/governors/failed_plans.h"
#include "flyball/governors/passability.h"
#include "flyball/governors/policy.h"
#include "flyball/governors/resting.h"
#include "flyball/governors/search_space.h"
#include "flyball/governors/sight.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

namespace {

using flyball::MapSetting;
using flyball::Observation;

constexpr double at_limit = 0.9;  // Of the speed: the reference eases towards it.
constexpr double standing_m_s = 0.1;
constexpr double failed_plan_j = 750.0;  // A loss of some 2.5 s of speed, at 300 W.
constexpr double spacing_m = 20.0;       // From obstacle to obstacle, in RoboRun's congestion.

// Where an RGB-D camera's noise, .0657 d - .4193 beyond 6 m (MAVBench's code), is half a cell.
// Farther off it fills the cells beside an obstacle too, and closes gaps.
double noise_free_m(double resolution_m, double least_m) {
  return std::max(least_m, (0.5 * resolution_m + 0.4193) / 0.0657);
}

class MissionEnergy final : public flyball::Policy {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"fine_m", 0.15, 0.05, 2.0, "Resolution that passes every gap of the mission."},
            {"coarse_m", 0.0, 0.0, 2.0,
             "For the open; 0: the mapper's coarsest, .8 without a lattice."},
            {"least_range_m", 7.0, 0.5, 100.0, "Shortest range of the map."},
            {"most_range_m", 0.0, 0.0, 100.0, "Longest; 0: the mission's own, 12 at least."},
            {"narrow_m_s", 2.0, 0.0, 50.0, "A limit of speed, 20 m ahead, that means narrow gaps."},
            {"body_m", 0.71, 0.1, 5.0, "Width of the vehicle with its tube at a crawl."},
            {"min_fine_s", 2.0, 0.0, 3600.0, "Finer cells last at least this long."},
            {"coarse_budget", 200.0, 100.0, 1e6, "Of a plan in coarse cells, iterations."},
            {"fine_latency_s", 0.5, 0.001, 60.0, "Sensor to map, 7 m, top clock; learned later."},
            {"coarse_latency_s", 0.12, 0.001, 60.0, "The same of the coarse map."},
            {"rest_s", 1.0, 0.01, 3600.0, "While the vehicle waits: a map in so long is enough."},
            {"patience_s", 3.0, 0.1, 3600.0, "Standing for this long: fine."},
            {"alpha", 0.05, 0.001, 0.5, "Share of maps that may come later than bounded."},
            {"margin", 0.0, 0.0, 100.0, "Bound over prediction; 0: calibrated in flight."},
            {"learn_s", 0.0, 0.0, 1e6, "Latency is learned for so long; 0: all the time."},
            {"deceleration_m_s2", 0.0, 0.0, 20.0, "Of eq. 2; 0: as the mission brakes."}};
  }

  flyball::Status start(const flyball::Parameters& given,
                        const flyball::KnobSettings& knobs) override {
    least_range_m_ = given.number("least_range_m");
    narrow_m_s_ = given.number("narrow_m_s");
    deceleration_m_s2_ = given.number("deceleration_m_s2");
    const flyball::KnobSpec* budget = knobs.spec("planner.budget");
    if (budget == nullptr) {
      return refused("there is no knob planner.budget; try: flyball list knobs");
    }
    full_budget_ = knobs.value(budget->name);
    resting_.emplace(given.number("rest_s"));
    home_ = {knobs.value("map.resolution_m"), knobs.value("map.range_m"), 0.0};
    coarse_budget_ = std::min(budget->nearest(given.number("coarse_budget")), full_budget_);
    if (flyball::Status set = set_levels(given, knobs); !set) {
      return set;
    }
    const auto ranges_m = ranges(given, knobs);
    if (!ranges_m) {
      return ranges_m.error();
    }
    const auto settings = search_settings(given);
    if (!settings) {
      return settings.error();
    }
    auto search = flyball::EnergySearch::make(*settings, map_levels(given, ranges_m->back()),
                                              *ranges_m, knobs);
    if (!search) {
      return refused(search.error().message);
    }
    search_.emplace(std::move(*search));
    failed_ = {};
    sight_.emplace(least_range_m_);
    set_passable(given);
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Decision decide(const Observation& seen) noexcept override {
    search_->learn(seen);
    const auto within_s = resting_->allowed_s(seen);
    const MapSetting best = within_s ? search_->rest(home_.resolution_m, home_.range_m, *within_s,
                                                     resting_->raised_by(), seen.now)
                                     : search_->choose(surroundings(seen), seen.now).setting;
    flyball::Decision wish;
    wish.reason = flyball::Reason::energy;
    wish.set("map.resolution_m", best.resolution_m);
    wish.set("map.range_m", best.range_m);
    wish.set("cpu.frequency_hz", best.clock_hz);
    wish.set("planner.budget", best.resolution_m > large_m_ ? coarse_budget_ : fine_budget(seen));
    return wish;
  }

  [[nodiscard]] std::optional<flyball::PromiseCount> promises() const noexcept override {
    return search_->promises();
  }

  [[nodiscard]] std::vector<flyball::PolicyOption> options() const override {
    return flyball::options_of(search_->weighed());
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

  /// All cells of a lattice between the finest and the coarsest one; else these two.
  flyball::Status set_levels(const flyball::Parameters& given, const flyball::KnobSettings& knobs) {
    const flyball::KnobSpec* spec = knobs.spec("map.resolution_m");
    is_lattice_ = spec != nullptr && !spec->legal.empty();
    const double given_m = given.number("coarse_m");
    const double coarsest_m = is_lattice_ ? spec->legal.back() : 0.8;  // MAVBench's coarse cells.
    const double fine_m = nearest_level(given.number("fine_m"), knobs);
    const double coarse_m = nearest_level(given_m > 0.0 ? given_m : coarsest_m, knobs);
    if (fine_m >= coarse_m) {
      return refused("fine_m = " + std::to_string(fine_m) +
                     " must be below coarse_m = " + std::to_string(coarse_m));
    }
    levels_m_ = {fine_m, coarse_m};
    if (is_lattice_) {
      levels_m_.clear();
      std::copy_if(spec->legal.begin(), spec->legal.end(), std::back_inserter(levels_m_),
                   [&](double r_m) { return r_m >= fine_m && r_m <= coarse_m; });
    }
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Result<flyball::EnergySearchSettings> search_settings(
      const flyball::Parameters& given) const {
    flyball::EnergySearchSettings settings;
    settings.bound.alpha = given.number("alpha");
    settings.learn_s = given.number("learn_s");
    settings.spacing_m = is_lattice_ ? spacing_m : 0.0;
    if (const double margin = given.number("margin"); margin != 0.0) {
      if (margin < 1.0) {
        return refused("margin = " + std::to_string(margin) + " must be at least 1, or 0");
      }
      settings.bound.first = std::log(margin);
      settings.bound.eta = 0.0;
    }
    return settings;
  }

  void set_passable(const flyball::Parameters& given) {
    flyball::PassabilitySettings passable;
    passable.body_m = given.number("body_m");
    passable.least = flyball::from_seconds(given.number("min_fine_s"));
    patience_s_ = given.number("patience_s");
    passable.patience = flyball::from_seconds(patience_s_);
    large_m_ = is_lattice_ ? 0.5 * passable.body_m : std::numeric_limits<double>::max();
    if (is_lattice_) {
      passable.beside_m = large_m_;
      passable.near_m = least_range_m_ + 1.0;
    }
    passability_.emplace(passable, levels_m_);
  }

  static flyball::Result<std::vector<double>> ranges(const flyball::Parameters& given,
                                                     const flyball::KnobSettings& knobs) {
    constexpr double usual_m = 12.0;
    const double least_m = given.number("least_range_m");
    double most_m = given.number("most_range_m");
    if (most_m <= 0.0) {
      const flyball::KnobSpec* spec = knobs.spec("map.range_m");
      most_m = spec == nullptr ? usual_m : std::max(usual_m, knobs.value("map.range_m"));
    }
    if (least_m >= most_m) {
      return refused("least_range_m = " + std::to_string(least_m) +
                     " must be below most_range_m = " + std::to_string(most_m));
    }
    return flyball::ranges_between(least_m, most_m);
  }

  [[nodiscard]] std::vector<flyball::SearchLevel> map_levels(const flyball::Parameters& given,
                                                             double most_m) const {
    auto levels = flyball::levels_between(levels_m_, given.number("fine_latency_s"),
                                          given.number("coarse_latency_s"));
    // A mission that integrates farther than noise allows has a better camera.
    const bool is_noisy = most_m <= 12.0;
    for (flyball::SearchLevel& level : levels) {
      level.most_range_m = is_noisy ? noise_free_m(level.resolution_m, least_range_m_) : most_m;
    }
    return levels;
  }

  [[nodiscard]] flyball::Surroundings surroundings(const Observation& seen) noexcept {
    const flyball::Passability::Verdict way = passability_->judge(seen);
    const bool near = seen.speed_limit_m_s <= narrow_m_s_;
    flyball::Surroundings around = flyball::limits_of(seen);
    around.coarsest_m = levels_m_[way.coarsest_level];
    around.least_range_m = way.look_m;
    around.needs_top_clock =
        way.coarsest_level == 0 || near || seen.phase != flyball::MissionPhase::cruise;
    if (deceleration_m_s2_ > 0.0) {
      around.deceleration_m_s2 = deceleration_m_s2_;
    }
    is_lattice_ ? limit_lattice(seen, near, around) : limit_two_levels(seen, near, around);
    return around;
  }

  void limit_lattice(const Observation& seen, bool near, flyball::Surroundings& around) noexcept {
    // The mission says so, from farther off than any gap shows; or a new goal asks for a plan.
    // Where it stands it waits for one, and what it is planned in must still be the map when it
    // comes.
    const bool cruises = seen.phase == flyball::MissionPhase::cruise;
    const bool waits = cruises && !(seen.speed_m_s > standing_m_s);
    around.coarsest_m = std::min({around.coarsest_m, near || !cruises ? large_m_ : 1e9,
                                  waits ? search_->in_force().resolution_m : 1e9});
    failed_.note(seen, search_->in_force().resolution_m > large_m_);
    around.large_m = large_m_;
    around.large_j_m = failed_.per_m() * failed_plan_j;
    sight_->note(seen, search_->in_force().range_m);
    around.sight_m = sight_->distance_m();
    around.most_response_s = patience_s_;  // Else it would be taken for stuck.
    // Only at the mission's own limit a second buys nothing: elsewhere a plan may be wanted.
    around.needs_top_clock |= !(seen.speed_m_s >= at_limit * around.speed_limit_m_s);
  }

  void limit_two_levels(const Observation& seen,
                        bool near,
                        flyball::Surroundings& around) const noexcept {
    constexpr double no_limit = std::numeric_limits<double>::max();
    const bool fine = around.coarsest_m <= levels_m_.front();
    // Noise from afar opens and closes gaps: what is narrow is looked at from nearby only.
    const bool from_nearby = (fine || near) && !(around.least_range_m > 0.0);
    around.most_range_m = from_nearby ? least_range_m_ : no_limit;
    // Free nearly up to the end of the range: a longer one would show more.
    constexpr double nearly_m = 1.5;
    const bool world_ends_it =
        fine && !(seen.known_free_m >= search_->in_force().range_m - nearly_m);
    around.sight_m = world_ends_it ? least_range_m_ : no_limit;
  }

  /// A plan that is there is mostly found soon, one that is not costs the whole budget, and the
  /// vehicle stands: begun anew with another seed and a newer map, and twice as long each time
  /// (Luby, Sinclair and Zuckerman 1993, doi:10.1016/0020-0190(93)90029-9).
  [[nodiscard]] double fine_budget(const Observation& seen) const noexcept {
    if (!is_lattice_) {
      return full_budget_;
    }
    const double halvings = std::max(0.0, 2.0 - static_cast<double>(seen.planner_failures));
    return std::max(coarse_budget_, full_budget_ * std::pow(0.5, halvings));
  }

  std::vector<double> levels_m_{};  ///< Finest first.
  bool is_lattice_{};
  double large_m_{};  ///< Cells beyond half the body shut openings that nobody has seen yet.
  double full_budget_{};
  double coarse_budget_{};
  double least_range_m_{};
  double narrow_m_s_{};
  double deceleration_m_s2_{};
  double patience_s_{};
  MapSetting home_{};  ///< The map as the scenario has it.
  std::optional<flyball::Resting> resting_{};
  std::optional<flyball::EnergySearch> search_{};
  std::optional<flyball::Passability> passability_{};
  std::optional<flyball::Sight> sight_{};
  flyball::FailedPlans failed_{};
};

}  // namespace

FLYBALL_PLUGIN(mission_energy) {
  registry.add<flyball::Policy>("mission_energy", [] { return std::make_unique<MissionEnergy>(); });
}
