// flyball-package: NLopt
// flyball-link: NLopt::nlopt
// SPDX-License-Identifier: BSD-3-Clause
//
// RoboRun (Boroujerdian et al., DAC 2021, arXiv 2108.13354). The vehicle flies with its largest
// speed; what that leaves is a time budget, and the budget is filled:
//
//   budget    t = share (d - stop(v)) / v, at most the cap; d to the closest unknown
//   stage     latency = (q0 / r^3 + q1 / r^2 + q2 / r) V, q fitted once: mapping with r0 and V0,
//   the
//             map for the planner and two planner stages with r1 and V1, V2
//   solver    min (t - sum of latencies)^2 - w V0 over r0 <= r1, V0 <= .3 V1, V1 <= 3 V2, by SLSQP
//   r         one of finest 2^k, k = 0..5; not above gaps and the nearest obstacle; at most 1.2 m
//             near the goal, the finest after two failed plans
//
// The precision r0 is the map's resolution, the volume V0 that of the camera's view, hence its
// range. Our planner has neither, so r1, V1 and V2 only bind the others. v is the speed that is
// commanded, not the one that is flown: at rest the budget would be endless, be filled, and hold
// the vehicle there.

#include "flyball/governors/policy.h"
#include "flyball/governors/time_budget.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <nlopt.h>

namespace {

using flyball::Observation;

constexpr int levels = 6;                 // r = finest 2^k, k = 0..5.
constexpr double sensor_over_map = 0.3;   // V0 <= .3 V1.
constexpr double map_over_planner = 3.0;  // V1 <= 3 V2.
constexpr double near_goal_m = 40.0;
constexpr double near_goal_resolution_m = 1.2;
constexpr std::uint32_t failures_to_finest = 2;
// The view of 90 by 59 degrees is a pyramid of volume 4/3 tan(45) tan(29.4) R^3.
constexpr double view_volume = 0.75;

/// Seconds for a precision r [m] and a volume V [m3].
struct StageLatency {
  double q0_s{};  ///< Times r^-3.
  double q1_s{};  ///< Times r^-2.
  double q2_s{};  ///< Times r^-1.
  [[nodiscard]] double per_m3_s(double r_m) const {
    return ((q0_s / r_m + q1_s) / r_m + q2_s) / r_m;
  }
  /// Of `per_m3_s` over ln r.
  [[nodiscard]] double slope_s(double r_m) const {
    return -((3.0 * q0_s / r_m + 2.0 * q1_s) / r_m + q2_s) / r_m;
  }
};

/// What the solver minimises: x = ln r0, ln r1, and V0, V1, V2 as shares of their largest.
struct Problem {
  StageLatency map{};
  StageLatency planner{};
  double fixed_s{};   ///< Stages that no knob changes.
  double budget_s{};  ///< Less `fixed_s`, for the stages that knobs change; not below zero.
  double volume_weight_s2{};
  std::array<double, 3> most_m3{};

  [[nodiscard]] double latency_s(const double* x) const {
    return map.per_m3_s(std::exp(x[0])) * x[2] * most_m3[0] +
           planner.per_m3_s(std::exp(x[1])) * (x[3] * most_m3[1] + 2.0 * x[4] * most_m3[2]);
  }
  void latency_gradient_s(const double* x, double* slope) const {
    const double r0_m = std::exp(x[0]);
    const double r1_m = std::exp(x[1]);
    const double planned_m3 = x[3] * most_m3[1] + 2.0 * x[4] * most_m3[2];
    slope[0] = map.slope_s(r0_m) * x[2] * most_m3[0];
    slope[1] = planner.slope_s(r1_m) * planned_m3;
    slope[2] = map.per_m3_s(r0_m) * most_m3[0];
    slope[3] = planner.per_m3_s(r1_m) * most_m3[1];
    slope[4] = 2.0 * planner.per_m3_s(r1_m) * most_m3[2];
  }
};

double objective(unsigned n, const double* x, double* gradient, void* context) {
  const auto& problem = *static_cast<const Problem*>(context);
  const double missing_s = problem.budget_s - problem.latency_s(x);
  if (gradient != nullptr) {
    problem.latency_gradient_s(x, gradient);
    std::transform(gradient, gradient + n, gradient,
                   [missing_s](double slope) { return -2.0 * missing_s * slope; });
    gradient[2] -= problem.volume_weight_s2;
  }
  return missing_s * missing_s - problem.volume_weight_s2 * x[2];
}

/// x[less] - x[more] <= 0, in the variables of `Problem`, whose largest volumes keep the ratios.
struct Order {
  std::size_t less;
  std::size_t more;
};
constexpr std::array<Order, 3> orders{{{0, 1}, {2, 3}, {3, 4}}};

double keeps_order(unsigned n, const double* x, double* gradient, void* context) {
  const auto& [less, more] = *static_cast<const Order*>(context);
  if (gradient != nullptr) {
    std::fill(gradient, gradient + n, 0.0);
    gradient[less] = 1.0;
    gradient[more] = -1.0;
  }
  return x[less] - x[more];
}

class Roborun final : public flyball::Policy {
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
        {"cap_s", 15.0, 0.1, 100.0, "Largest budget."},
        {"deceleration_m_s2", 3.0, 0.0, 20.0, "Of a stop; 0: the fit of RoboRun's own vehicle."},
        {"overhead_s", 0.19, 0.0, 10.0, "Its own decision, off the budget."},
        {"fixed_s", 0.59, 0.0, 10.0, "Stages that no knob changes, off the budget."},
        {"volume_weight_s2", 0.01, 0.0, 1e6, "w, for the whole of the largest V0."},
        {"map_q0_s", 2.24e-6, 0.0, 1.0, "q0 of mapping, times m^3 / m^3."},
        {"map_q1_s", 3.05e-6, 0.0, 1.0, "q1 of mapping."},
        {"map_q2_s", 1.53e-5, 0.0, 1.0, "q2 of mapping."},
        {"planner_share", 0.125, 0.0, 10.0, "Cost of a planner stage over mapping's, per volume."}};
  }

  flyball::Status start(const flyball::Parameters& given,
                        const flyball::KnobSettings& knobs) override {
    for (const char* knob : {"map.resolution_m", "map.range_m", "mission.max_speed_m_s"}) {
      if (knobs.spec(knob) == nullptr) {
        return refused(std::string{"there is no knob "} + knob + "; try: flyball list knobs");
      }
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
    set_problem(given);
    set_solver();
    wish_ = {};
    remember(knobs.value("map.resolution_m"), knobs.value("map.range_m"));
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Decision decide(const Observation& seen) noexcept override {
    const double room_m = std::clamp(finite(seen.known_free_m - seen.tracking_error_m), 0.0, 1e3);
    // Stages that no knob changes must not count among those that are squeezed: where they alone
    // are over the budget the volume would go to its least, the vehicle would see no farther, and
    // the next budget would be no larger.
    problem_.budget_s = std::max(0.0, budget_.budget_s(v_max_m_s_, room_m) - problem_.fixed_s);
    const double coarsest_m = coarsest(seen);
    std::array<double, 5> x{};
    if (seen.planner_failures >= failures_to_finest) {
      remember(finest_m_, range_m_);
    } else if (solve(coarsest_m, x)) {
      const double r0_m = rounded(std::exp(x[0]), coarsest_m);
      remember(r0_m, fitting_range_m(std::exp(x[0]), r0_m, x[2]));
    }  // Else the knobs stay.
    return wish_;
  }

 private:
  struct Destroy {
    void operator()(nlopt_opt solver) const { nlopt_destroy(solver); }
  };

  static flyball::Error refused(const std::string& why) {
    return {flyball::ErrorCode::invalid_input, "policy \"roborun\": " + why};
  }
  static double finite(double value) { return std::isfinite(value) ? value : 0.0; }

  void set_problem(const flyball::Parameters& given) {
    problem_ = {};
    problem_.map = {given.number("map_q0_s"), given.number("map_q1_s"), given.number("map_q2_s")};
    const double share = given.number("planner_share");
    problem_.planner = {share * problem_.map.q0_s, share * problem_.map.q1_s,
                        share * problem_.map.q2_s};
    problem_.fixed_s = given.number("fixed_s") + given.number("overhead_s");
    problem_.volume_weight_s2 = given.number("volume_weight_s2");
    const double view_m3 = view_volume * std::pow(most_range_m_, 3.0);
    problem_.most_m3 = {view_m3, view_m3 / sensor_over_map,
                        view_m3 / sensor_over_map / map_over_planner};
  }

  void set_solver() {
    solver_.reset(nlopt_create(NLOPT_LD_SLSQP, 5));
    nlopt_set_min_objective(solver_.get(), objective, &problem_);
    orders_ = orders;
    for (Order& order : orders_) {
      nlopt_add_inequality_constraint(solver_.get(), keeps_order, &order, 1e-9);
    }
    nlopt_set_ftol_rel(solver_.get(), 1e-6);
    nlopt_set_maxeval(solver_.get(), 200);
  }

  bool solve(double coarsest_m, std::array<double, 5>& x) noexcept {
    const double least_share = std::pow(least_range_m_ / most_range_m_, 3.0);
    const double low = std::log(finest_m_);
    const double high = std::log(coarsest_m);
    const std::array<double, 5> least{low, low, least_share, least_share, least_share};
    const std::array<double, 5> most{high, high, 1.0, 1.0, 1.0};
    nlopt_set_lower_bounds(solver_.get(), least.data());
    nlopt_set_upper_bounds(solver_.get(), most.data());
    // From the coarse side: on the fine one latencies are so long that the first step leads far
    // off.
    const double start = low + 0.75 * (high - low);
    const double share = std::max(0.5, least_share);
    x = {start, start, share, share, share};
    double found = 0.0;
    const nlopt_result result = nlopt_optimize(solver_.get(), x.data(), &found);
    return (result > 0 || result == NLOPT_ROUNDOFF_LIMITED) && std::isfinite(found) &&
           std::all_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
  }

  /// Gaps and obstacles, and the goal's neighbourhood.
  [[nodiscard]] double coarsest(const Observation& seen) const noexcept {
    double limit_m = std::min(finite(seen.nearest_obstacle_m), finite(seen.mean_gap_m));
    if (!(finite(seen.distance_to_goal_m) > near_goal_m)) {
      limit_m = std::min(limit_m, near_goal_resolution_m);
    }
    return std::clamp(limit_m, finest_m_, finest_m_ * (1 << (levels - 1)));
  }

  /// The nearest precision there is, in proportion, that is not above the limit.
  [[nodiscard]] double rounded(double r_m, double coarsest_m) const noexcept {
    const double steps = std::log2(r_m / finest_m_);
    const double most = std::floor(std::log2(coarsest_m / finest_m_) + 1e-9);
    const double k = std::clamp(std::round(steps), 0.0, std::min(most, levels - 1.0));
    return finest_m_ * std::exp2(k);
  }

  /// Rounding to a finer precision costs more than was solved for: the volume pays.
  [[nodiscard]] double fitting_range_m(double solved_m, double r_m, double share) const noexcept {
    const double dearer = problem_.map.per_m3_s(r_m) / problem_.map.per_m3_s(solved_m);
    const double range_m = most_range_m_ * std::cbrt(std::min(share, share / dearer));
    return std::clamp(std::isfinite(range_m) ? range_m : most_range_m_, least_range_m_,
                      most_range_m_);
  }

  void remember(double resolution_m, double range_m) noexcept {
    range_m_ = range_m;
    wish_ = {};
    wish_.reason = flyball::Reason::deadline;
    wish_.set("map.resolution_m", resolution_m);
    wish_.set("map.range_m", range_m);
    wish_.set("mission.max_speed_m_s", v_max_m_s_);
  }

  double finest_m_{};
  double least_range_m_{};
  double most_range_m_{};
  double v_max_m_s_{};
  double range_m_{};  ///< Wished last.
  flyball::TimeBudget budget_{};
  Problem problem_{};
  std::array<Order, 3> orders_{};
  std::unique_ptr<nlopt_opt_s, Destroy> solver_{};
  flyball::Decision wish_{};
};

}  // namespace

FLYBALL_PLUGIN(roborun) {
  registry.add<flyball::Policy>("roborun", [] { return std::make_unique<Roborun>(); });
}
