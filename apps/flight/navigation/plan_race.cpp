// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/plan_race.h"

#include "flyball/runtime/assert.h"
#include "flyball/runtime/random.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace flyball {
namespace {

double iterations_of(const Plan& plan) {
  return plan.work.count("iterations");
}

/// What of a plan's work the race is about.
const Work& searching(const Plan& plan) {
  return plan.searching.items().empty() ? plan.work : plan.searching;
}

/// The first by iterations, and then by number, that found a path; without one, the first.
std::size_t winner_of(const std::vector<Plan>& plans) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < plans.size(); ++i) {
    const bool is_found = !plans[i].waypoints_W.empty();
    if (is_found &&
        (plans[best].waypoints_W.empty() || iterations_of(plans[i]) < iterations_of(plans[best]))) {
      best = i;
    }
  }
  return best;
}

/// All that was searched until the winner had found its path can be shared. What the winner did
/// before and after its search cannot, nor what the first one of a new kind pays (`switches`).
Work work_of(const std::vector<Plan>& plans, std::size_t winner) {
  const Plan& won = plans[winner];
  const bool is_found = !won.waypoints_W.empty();
  Work work;
  work.charge_as(won.work.charged_as());
  for (const WorkItem& item : won.work.items()) {
    work.add(item.name, item.count - searching(won).count(item.name));
  }
  if (winner != 0 && plans.front().work.count("switches") > 0.0) {
    work.add("switches", plans.front().work.count("switches"));
  }
  for (const Plan& plan : plans) {
    const double all = iterations_of(plan);
    const double part = is_found && all > 0.0 ? std::min(1.0, iterations_of(won) / all) : 1.0;
    for (const WorkItem& item : searching(plan).items()) {
      work.add_shared(item.name, part * item.count);
    }
  }
  return work;
}

}  // namespace

void add(Work& sum, const Work& more) {
  const Work shared = more.shared();
  for (const WorkItem& item : more.items()) {
    sum.add(item.name, item.count - shared.count(item.name));
    if (more.tells_shared()) {
      sum.add_shared(item.name, shared.count(item.name));
    }
  }
  sum.charge_as(more.charged_as());
}

Plan race_of(int searches,
             PathPlanner& planner,
             const PlanRequest& request,
             const OccupancyView& map) {
  FLYBALL_ASSERT(searches >= 1, "searches=%d", searches);
  if (searches == 1) {
    return planner.plan(request, map);
  }
  PlanRequest each = request;
  each.max_iterations = std::max(1, request.max_iterations / searches);
  std::vector<Plan> plans{planner.plan(each, map)};
  // Where nothing was searched for, because the way is straight or shut, there is no race.
  for (int i = 1; i < searches && iterations_of(plans.front()) > 0.0; ++i) {
    each.seed = RandomStream{request.seed, "race", static_cast<std::uint64_t>(i)}.next();
    plans.push_back(planner.plan(each, map));
  }
  const std::size_t winner = winner_of(plans);
  Plan won = plans[winner];
  won.work = work_of(plans, winner);
  if (iterations_of(plans.front()) == 0.0) {
    won.work = plans.front().work;
    won.work.add_shared("iterations", 0.0);  // All of it is done by one core.
  }
  return won;
}

}  // namespace flyball
