// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/plan_lead.h"

#include "flyball/runtime/quantile.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace flyball {
namespace {

// Chosen by hand. A lead that is too short wastes the plan; one that is too long splices it far
// ahead, where the map shows less. So most plans are to come in time, and none is waited for long.
constexpr double lead_over_usual = 1.5;
constexpr double usual_share = 0.8;  // The quantile of the times that counts as usual.
constexpr std::size_t plans_remembered = 5;
constexpr double most_lead_s = 3.0;
constexpr double least_iterations = 100.0;  // With fewer, the fixed part of a plan would dominate.

}  // namespace

void PlanLead::took(double plan_s, double iterations) {
  taken_.push_back({plan_s, iterations});
  if (taken_.size() > plans_remembered) {
    taken_.pop_front();
  }
}

double PlanLead::lead_s() const {
  std::vector<double> taken_s;
  taken_s.reserve(taken_.size());
  for (const Taken& plan : taken_) {
    taken_s.push_back(plan.s);
  }
  const double usual_s = quantile(std::move(taken_s), usual_share);
  return std::clamp(lead_over_usual * usual_s, least_plan_lead_s, most_lead_s);
}

double PlanLead::iteration_s() const {
  Taken all;
  for (const Taken& plan : taken_) {
    if (plan.iterations > 0.0) {  // Else nothing was searched through.
      all.s += plan.s;
      all.iterations += plan.iterations;
    }
  }
  return all.iterations < least_iterations ? 0.0 : all.s / all.iterations;
}

}  // namespace flyball
