// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// RoboRun's optimisation (DAC 2021, arXiv 2108.13354): which precisions and volumes fill a budget.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include <nlopt.h>

namespace flyball {

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
struct RoborunProblem {
  StageLatency map{};
  StageLatency planner{};
  double budget_s{};  ///< For the stages that knobs change.
  double volume_weight_s2{};
  double least_share{};  ///< Of each volume.
  std::array<double, 3> most_m3{};

  /// Of the map, with all else in proportion.
  void set_view(double view_m3) {
    constexpr double sensor_over_map = 0.3;   // V0 <= .3 V1.
    constexpr double map_over_planner = 3.0;  // V1 <= 3 V2.
    most_m3 = {view_m3, view_m3 / sensor_over_map, view_m3 / sensor_over_map / map_over_planner};
  }
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

/// SLSQP over the five variables.
class RoborunSolver {
 public:
  struct Answer {
    double precision_m{};
    double volume_share{};
  };

  RoborunSolver() : solver_{nlopt_create(NLOPT_LD_SLSQP, 5)} {
    nlopt_set_min_objective(solver_.get(), objective, &problem_);
    for (Order& order : orders_) {
      nlopt_add_inequality_constraint(solver_.get(), keeps_order, &order, 1e-9);
    }
    nlopt_set_ftol_rel(solver_.get(), 1e-6);
    nlopt_set_maxeval(solver_.get(), 200);
  }
  RoborunSolver(const RoborunSolver&) = delete;  // NLopt keeps the addresses of its members.
  RoborunSolver& operator=(const RoborunSolver&) = delete;

  [[nodiscard]] RoborunProblem& problem() { return problem_; }

  /// With precisions between the two. Empty: it found nothing.
  [[nodiscard]] std::optional<Answer> solve(double finest_m, double coarsest_m) noexcept {
    const double low = std::log(finest_m);
    const double high = std::log(coarsest_m);
    const double least_share = problem_.least_share;
    const std::array<double, 5> least{low, low, least_share, least_share, least_share};
    const std::array<double, 5> most{high, high, 1.0, 1.0, 1.0};
    nlopt_set_lower_bounds(solver_.get(), least.data());
    nlopt_set_upper_bounds(solver_.get(), most.data());
    // From the coarse side: on the fine one latencies are so long that the first step leads far
    // off.
    const double start = low + 0.75 * (high - low);
    const double share = std::max(0.5, least_share);
    std::array<double, 5> x{start, start, share, share, share};
    double found = 0.0;
    const nlopt_result result = nlopt_optimize(solver_.get(), x.data(), &found);
    const bool is_found =
        (result > 0 || result == NLOPT_ROUNDOFF_LIMITED) && std::isfinite(found) &&
        std::all_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
    return is_found ? std::optional<Answer>{{std::exp(x[0]), x[2]}} : std::nullopt;
  }

 private:
  struct Destroy {
    void operator()(nlopt_opt solver) const { nlopt_destroy(solver); }
  };
  /// x[less] - x[more] <= 0, in the variables of the problem, whose largest volumes keep the
  /// ratios.
  struct Order {
    std::size_t less;
    std::size_t more;
  };

  static double objective(unsigned n, const double* x, double* gradient, void* context) {
    const auto& problem = *static_cast<const RoborunProblem*>(context);
    const double missing_s = problem.budget_s - problem.latency_s(x);
    if (gradient != nullptr) {
      problem.latency_gradient_s(x, gradient);
      std::transform(gradient, gradient + n, gradient,
                     [missing_s](double slope) { return -2.0 * missing_s * slope; });
      gradient[2] -= problem.volume_weight_s2;
    }
    return missing_s * missing_s - problem.volume_weight_s2 * x[2];
  }
  static double keeps_order(unsigned n, const double* x, double* gradient, void* context) {
    const auto& [less, more] = *static_cast<const Order*>(context);
    if (gradient != nullptr) {
      std::fill(gradient, gradient + n, 0.0);
      gradient[less] = 1.0;
      gradient[more] = -1.0;
    }
    return x[less] - x[more];
  }

  RoborunProblem problem_{};
  std::array<Order, 3> orders_{{{0, 1}, {2, 3}, {3, 4}}};
  std::unique_ptr<nlopt_opt_s, Destroy> solver_;
};

}  // namespace flyball
