// SPDX-License-Identifier: BSD-3-Clause
#include "plan_lead.h"

#include "flight_recorder.h"
#include <algorithm>
#include <cstddef>

namespace flyball {
namespace {

constexpr double lead_over_usual = 1.5;
constexpr double usual_share = 0.8;
constexpr std::size_t plans_remembered = 5;
constexpr double most_lead_s = 3.0;

}  // namespace

void PlanLead::took(double plan_s) {
  taken_s_.push_back(plan_s);
  if (taken_s_.size() > plans_remembered) {
    taken_s_.pop_front();
  }
}

double PlanLead::lead_s() const {
  const double usual_s = quantile({taken_s_.begin(), taken_s_.end()}, usual_share);
  return std::clamp(lead_over_usual * usual_s, least_plan_lead_s, most_lead_s);
}

}  // namespace flyball
