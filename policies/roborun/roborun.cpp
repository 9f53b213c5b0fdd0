// flyball-package: NLopt
// flyball-link: NLopt::nlopt
// SPDX-License-Identifier: BSD-3-Clause
//
// RoboRun (Boroujerdian et al., DAC 2021, arXiv 2108.13354):
//
//   budget    t = share (d - stop(v)) / v, rolled along the planned speeds, at most the cap; d to
//             the closest unknown. Less the stages that no knob changes; where they are not paid
//             for nothing is left to fill, and the vehicle has no budget to keep
//   stage     latency = (q0 / r^3 + q1 / r^2 + q2 / r) V, q fitted once: mapping with r0 and V0,
//             the map for the planner and two planner stages with r1 and V1, V2
//   solver    min (t - sum of latencies)^2 - w V0 over r0 <= r1, V0 <= .3 V1, V1 <= 3 V2, by SLSQP
//   r         one of finest 2^k, k = 0..5, at most the one below gaps and the nearest obstacle
//             (the least of the last maps), 1.2 m near the goal; what is solved is rounded to the
//             next coarser one. The finest after two failed plans
//
// In its published code (branch roborun_improved of MAVBench's applications, August 2020) r0 is no
// finer than half of the mean gap either: rounded up that is the ceiling itself, so space alone
// sets the precision; and w is 1 s^2 for each cubic metre, so V0 is all there is to see. Its logs
// show both: medians of V0 at each precision are the same for budgets above and below the median.
// `gap_share` and `volume_weight_s2` choose between that and a rule that fills its budget.
//
// The precision r0 is the map's resolution, the volume V0 that of the camera's view, hence its
// range. Our planner has neither, so r1, V1 and V2 only bind the others. Latency bounds: each map
// is held against the budget that was in force when its frame began, as in RoboRun's logs.

#include "flyball/governors/policy.h"
#include "flyball/governors/policy_abilities.h"
#include "flyball/governors/required_knobs.h"
#include "flyball/runtime/registry.h"

#include "budget_ledger.h"
#include "roborun_solver.h"
#include "time_budget.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace {

using flyball::Observation;

constexpr std::size_t most_levels = 6;  // r = finest 2^k, k = 0..5.
constexpr double near_goal_m = 40.0;
constexpr double near_goal_resolution_m = 1.2;
constexpr std::uint32_t failures_to_finest = 2;
constexpr std::size_t ceilings_kept = 5;  // Of the last maps.
constexpr std::size_t budgets_kept = 256;
constexpr double at_rest_m_s = 0.2;
// The view of 90 by 59 degrees is a pyramid of volume 4/3 tan(45) tan(29.4) R^3.
constexpr double view_volume = 0.75;

class Roborun final : public flyball::Policy, public flyball::BoundsLatency {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    // q of the map: through the TX2's median latencies at 25 m in delivery_mixed and
    // delivery_congestion, 10.55 s at .15 m, .52 s at .60 m and .19 s at 1.2 m. A stage of the
    // planner is taken for an eighth of mapping; ours plans aside and does not hold the map up.
    return {
        {"finest_m", 0.3, 0.05, 2.0, "Finest precision; the others are 2, 4 .. 32 times it."},
        {"most_range_m", 25.0, 2.0, 100.0, "Range of the largest volume."},
        {"least_range_m", 5.0, 0.5, 100.0, "Range of the smallest."},
        {"v_max_m_s", 0.0, 0.0, 50.0, "Commanded; 0: as the scenario says."},
        {"share", 0.5, 0.01, 1.0, "Of the budget that is filled."},
        {"gap_share", 0.0, 0.0, 1.0,
         "No finer than this share of the mean gap; 0: as is paid for."},
        {"cap_s", 15.0, 0.1, 100.0, "Largest budget."},
        {"deceleration_m_s2", 3.0, 0.0, 20.0, "Of a stop; 0: the fit of RoboRun's own vehicle."},
        {"overhead_s", 0.19, 0.0, 10.0, "Its own decision, off the budget."},
        {"fixed_s", 0.44, 0.0, 10.0, "Other stages that no knob changes, off the budget."},
        {"volume_weight_s2", 0.01, 0.0, 1e6, "w, for the whole of the largest V0."},
        {"map_q0_s", 2.24e-6, 0.0, 1.0, "q0 of mapping, times m^3 / m^3."},
        {"map_q1_s", 3.05e-6, 0.0, 1.0, "q1 of mapping."},
        {"map_q2_s", 1.53e-5, 0.0, 1.0, "q2 of mapping."},
        {"planner_share", 0.125, 0.0, 10.0, "Cost of a planner stage over mapping's, per volume."}};
  }

  flyball::Status start(const flyball::Parameters& given,
                        const flyball::KnobSettings& knobs,
                        const flyball::BoardModel& /*board*/) override {
    if (flyball::Status status =
            flyball::require_knobs("policy \"roborun\"", knobs,
                                   {"map.resolution_m", "map.range_m", "mission.max_speed_m_s"});
        !status) {
      return status;
    }
    finest_m_ = given.number("finest_m");
    least_range_m_ = given.number("least_range_m");
    most_range_m_ = given.number("most_range_m");
    if (least_range_m_ >= most_range_m_) {
      return refused("least_range_m = " + std::to_string(least_range_m_) +
                     " must be below most_range_m = " + std::to_string(most_range_m_));
    }
    const double v_max = given.number("v_max_m_s");
    v_max_m_s_ = v_max > 0.0 ? v_max : knobs.value("mission.max_speed_m_s");
    const double a = given.number("deceleration_m_s2");
    budget_.stop =
        a > 0.0 ? flyball::StoppingDistance::braking(a) : flyball::StoppingDistance::roborun();
    budget_.share = given.number("share");
    budget_.cap_s = given.number("cap_s");
    gap_share_ = given.number("gap_share");
    set_levels(*knobs.spec("map.resolution_m"));
    set_problem(given);
    wish_ = {};
    remember(knobs.value("map.resolution_m"), knobs.value("map.range_m"));
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Decision decide(const Observation& seen) noexcept override {
    const double limit_m = coarsest(seen);
    if (seen.map_revision != map_revision_) {
      map_revision_ = seen.map_revision;
      ledger_.came(seen.now, seen.latency);
      ceilings_m_[next_ceiling_] = limit_m;
      next_ceiling_ = (next_ceiling_ + 1) % ceilings_kept;
    }
    const double coarsest_m =
        std::min(limit_m, *std::min_element(ceilings_m_.begin(), ceilings_m_.end()));
    const double whole_s = whole_budget_s(seen);
    const bool is_paid = whole_s >= fixed_s_;
    // Its code keeps the old settings where nothing is left, and stops the vehicle. Here the guard
    // slows it down; with the old settings, if they are a short range, the next budget would be no
    // larger, and the vehicle would crawl for good.
    solver_.problem().budget_s = std::max(0.0, whole_s - fixed_s_);
    if (seen.planner_failures >= failures_to_finest) {
      remember(finest_m_, range_m_);
    } else if (const auto found = solver_.solve(finest(seen, coarsest_m), coarsest_m)) {
      remember(rounded_up(found->precision_m, coarsest_m),
               most_range_m_ * std::cbrt(found->volume_share));
    }  // Else the knobs stay.
    ledger_.set(seen.now, level_, is_paid ? whole_s : 0.0);
    return wish_;
  }

  [[nodiscard]] flyball::BoundCount bounds() const noexcept override {
    const flyball::BudgetLedger::Count all = ledger_.all();
    return flyball::BoundCount{all.results, all.late, 1.0};
  }
  [[nodiscard]] std::vector<flyball::LevelBounds> bound_levels() const override {
    std::vector<flyball::LevelBounds> all;
    for (std::size_t k = 0; k < levels_; ++k) {
      const flyball::BudgetLedger::Count& one = ledger_.levels()[k];
      all.push_back({level_m(k), one.results, one.late, std::nullopt});
    }
    return all;
  }

 private:
  static flyball::Error refused(const std::string& why) {
    return {flyball::ErrorCode::invalid_input, "policy \"roborun\": " + why};
  }
  static double finite(double value) { return std::isfinite(value) ? value : 0.0; }

  void set_problem(const flyball::Parameters& given) {
    flyball::RoborunProblem& problem = solver_.problem();
    problem = {};
    problem.map = {given.number("map_q0_s"), given.number("map_q1_s"), given.number("map_q2_s")};
    const double share = given.number("planner_share");
    problem.planner = {share * problem.map.q0_s, share * problem.map.q1_s,
                       share * problem.map.q2_s};
    problem.volume_weight_s2 = given.number("volume_weight_s2");
    problem.least_share = std::pow(least_range_m_ / most_range_m_, 3.0);
    problem.set_view(view_volume * std::pow(most_range_m_, 3.0));
    fixed_s_ = given.number("fixed_s") + given.number("overhead_s");
  }

  /// The mapper may know no cells as coarse: what is solved for must be what is mapped.
  void set_levels(const flyball::KnobSpec& resolution) {
    levels_ = 1;
    const auto is_known = [&resolution](double r_m) {
      return std::abs(resolution.nearest(r_m) - r_m) < 1e-6 * r_m;
    };
    while (levels_ < most_levels && is_known(level_m(levels_))) {
      ++levels_;
    }
    ledger_ = flyball::BudgetLedger{levels_, budgets_kept};
    map_revision_ = 0;
    next_ceiling_ = 0;
    ceilings_m_.fill(level_m(levels_ - 1));
  }
  [[nodiscard]] double level_m(std::size_t k) const noexcept {
    return std::ldexp(finest_m_, static_cast<int>(k));
  }

  /// A vehicle that stands has all the time there is when its way does not say otherwise: without
  /// a path, before unknown space, after a failed plan.
  [[nodiscard]] double whole_budget_s(const Observation& seen) const noexcept {
    const double room_m = std::clamp(finite(seen.known_free_m - seen.tracking_error_m), 0.0, 1e3);
    const double speed_m_s = std::clamp(finite(seen.speed_m_s), 0.0, v_max_m_s_);
    const double ahead_s = budget_ahead_s(
        budget_, {speed_m_s, v_max_m_s_, std::max(0.0, finite(seen.max_deceleration_m_s2))},
        room_m);
    return ahead_s >= fixed_s_ || speed_m_s > at_rest_m_s ? ahead_s : budget_.cap_s;
  }

  /// Gaps and obstacles, and the goal's neighbourhood: the precision that is not above them.
  [[nodiscard]] double coarsest(const Observation& seen) const noexcept {
    double limit_m = std::min(finite(seen.nearest_obstacle_m), finite(seen.mean_gap_m));
    if (!(finite(seen.distance_to_goal_m) > near_goal_m)) {
      limit_m = std::min(limit_m, near_goal_resolution_m);
    }
    std::size_t k = levels_ - 1;
    while (k > 0 && level_m(k) > limit_m * (1.0 + 1e-9)) {
      --k;
    }
    return level_m(k);
  }

  /// What it may be refined to.
  [[nodiscard]] double finest(const Observation& seen, double coarsest_m) const noexcept {
    const double worth_m = gap_share_ > 0.0 ? std::min(gap_share_ * finite(seen.mean_gap_m),
                                                       finite(seen.nearest_obstacle_m))
                                            : finest_m_;
    return std::clamp(worth_m, finest_m_, coarsest_m);
  }

  /// The next coarser precision there is, as in RoboRun's code.
  [[nodiscard]] double rounded_up(double r_m, double coarsest_m) const noexcept {
    std::size_t k = 0;
    while (level_m(k) < r_m * (1.0 - 1e-3)) {
      ++k;
    }
    return std::min(level_m(k), coarsest_m);
  }

  void remember(double resolution_m, double range_m) noexcept {
    range_m_ =
        std::clamp(std::isfinite(range_m) ? range_m : most_range_m_, least_range_m_, most_range_m_);
    level_ = 0;
    while (level_ + 1 < levels_ && level_m(level_ + 1) < resolution_m * (1.0 + 1e-9)) {
      ++level_;
    }
    wish_ = {};
    wish_.reason = flyball::Reason::deadline;
    wish_.set("map.resolution_m", resolution_m);
    wish_.set("map.range_m", range_m_);
    wish_.set("mission.max_speed_m_s", v_max_m_s_);
  }

  double finest_m_{};
  double least_range_m_{};
  double most_range_m_{};
  double v_max_m_s_{};
  double gap_share_{};
  double range_m_{};     ///< Wished last.
  std::size_t level_{};  ///< Of the resolution that is wished.
  std::uint64_t map_revision_{};
  std::array<double, ceilings_kept> ceilings_m_{};  ///< A ring.
  std::size_t next_ceiling_{};
  std::size_t levels_{1};
  flyball::BudgetLedger ledger_{1, budgets_kept};
  flyball::TimeBudget budget_{};
  double fixed_s_{};
  flyball::RoborunSolver solver_{};
  flyball::Decision wish_{};
};

}  // namespace

FLYBALL_PLUGIN(roborun) {
  registry.add<flyball::Policy>("roborun", [] { return std::make_unique<Roborun>(); });
}
