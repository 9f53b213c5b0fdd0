// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/plan_with_tubes.h"

#include "flyball/flight/navigation/gap_scan.h"
#include "flyball/flight/navigation/known_path.h"
#include "flyball/flight/perception/counted_map.h"
#include "flyball/runtime/random.h"

#include <algorithm>

namespace flyball {
namespace {

// The room beside the tube of cruise speed is two of the cells with which that speed can be flown
// (.30 m): an obstacle fills one of them by its border, and the other must be known free. A map of
// such cells stays passable along a path with so much room. A path that cuts a corner more closely
// needs finer cells, and with them half the speed.
constexpr double room_m = 0.6;

constexpr double aside_m = 20.0;     // Chosen: a path farther off the line is a detour in any case.
constexpr double exact_to_m = 0.25;  // To this, `gaps_ahead` knows the widths of openings.
constexpr double half_band_m = 0.3;  // A little more than half the body's height.

// Chosen by hand, apart from those with a source.
constexpr double worthwhile = 0.5;  // Flight is slower in a narrow tube: it must save this share.
constexpr int shorter_iterations = 400;  // A known door takes fewer (tests/kernels/rrt_test.cpp).
constexpr int most_improvements = 3;
constexpr int wide_iterations = 500;    // A wide path is found within so many, if there is one.
constexpr int first_iterations = 1000;  // Of 518 plans on mixed missions 39 took more in all.
constexpr int most_doublings = 10;      // More than any budget.
// Measured in flights of delivery_mixed: 9 of 88 such searches found a path, and a vehicle in
// motion loses this share of the time that it searches, because it flies on meanwhile.
constexpr double finds_one = 0.1;
constexpr double lost_in_motion = 0.37;

void add(Work& sum, const Work& more) {
  for (const WorkItem& item : more.items()) {
    sum.add(item.name, item.count);
  }
  sum.charge_as(more.charged_as());
}

class Search {
 public:
  Search(const Situation& situation, PathPlanner& planner, const PlanQuery& query)
      : situation_{situation}, planner_{planner}, query_{query} {
    request_.start_W = query.start_W;
    request_.goal_W = query.goal_W;
    request_.bounds_W = situation.brief.site.bounds_W;
    request_.slow_W = situation.slow_zones_W();
    request_.seed = RandomStream{situation.brief.settings.seed, "planner", query.id}.next();
  }

  Plan plan() {
    if (find_any()) {
      look_for_shorter();
    }
    plan_.work = work_;
    return plan_;
  }
  [[nodiscard]] const Cylinder& body() const { return body_; }

 private:
  // The first search asks for room around the wide tube that cruise speed needs, the second one for
  // the wide tube alone, each with few iterations. A tube that fits through none of the openings
  // ahead is not tried, since before doors that would take most of the time. With the narrow tube
  // there may be no path at all, and the vehicle stands while a search uses up its iterations. So
  // the first one is short, and each after a failed one is twice as long and on a newer map (Luby,
  // Sinclair and Zuckerman 1993, doi:10.1016/0020-0190(93)90029-9).
  bool find_any() {
    const int budget = std::min(static_cast<int>(situation_.knobs.value("planner.budget")),
                                first_iterations << std::min(query_.failures, most_doublings));
    if (query_.may_be_tight) {
      return try_narrow(budget);
    }
    const double opening_m = narrowest_opening_m();
    const auto fits = [&](const Cylinder& body) {
      return 2.0 * body.radius_m <= opening_m + exact_to_m;
    };
    const int few = std::min(wide_iterations, budget);
    const Cylinder wide = situation_.brief.body_at(situation_.knobs.value("mission.max_speed_m_s"));
    const Cylinder roomy{wide.radius_m + room_m, wide.half_height_m};
    const bool tries_roomy = 2.0 * situation_.map.resolution_m() <= room_m && fits(roomy);
    const bool tries_wide = fits(wide);
    return (tries_roomy && try_with(roomy, few)) || (tries_wide && try_with(wide, few)) ||
           try_narrow(budget);
  }

  // The way that was flown is not always the shortest, so it takes the place of the longest search.
  bool try_narrow(int budget) {
    request_.flown_W = query_.flown_W;
    return try_with(situation_.brief.narrow_body(), budget);
  }

  [[nodiscard]] double narrowest_opening_m() {
    GapScan scan;
    scan.reach_m = (request_.goal_W - request_.start_W).norm();
    scan.aside_m = aside_m;
    scan.half_band_m = half_band_m;
    scan.bounds_W = situation_.brief.site.bounds_W;
    const CountedMap map{situation_.map};
    const GapsAhead gaps = gaps_ahead(map, request_.start_W, request_.goal_W, scan);
    map.add_to(work_);
    return gaps.narrowest_m;
  }

  void look_for_shorter() {
    const double line_m = (request_.goal_W - request_.start_W).norm();
    for (int i = 0; i < most_improvements; ++i) {
      const double now_m = length_m(plan_.waypoints_W);
      const double saved_m = worthwhile * (now_m - line_m);
      request_.shorter_than_m = now_m - saved_m;
      const int iterations = now_m > line_m + least_detour_m ? iterations_worth() : 0;
      if (iterations == 0 || !try_with(situation_.brief.narrow_body(), iterations)) {
        return;
      }
    }
  }

  /// As many iterations as take no longer than the time that a shorter path may save.
  [[nodiscard]] int iterations_worth() const {
    const double saved_s = worthwhile * situation_.detour_s(plan_.waypoints_W);
    const double lost = query_.start_direction_W.isZero() ? 1.0 : lost_in_motion;
    if (saved_s <= 0.0) {
      return 0;
    }
    const double worth_s = finds_one * saved_s / lost;
    return worth_s >= shorter_iterations * query_.iteration_s
               ? shorter_iterations
               : static_cast<int>(worth_s / query_.iteration_s);
  }

  /// Keeps the plan that was found before when this search finds none.
  bool try_with(const Cylinder& body, int iterations) {
    request_.body = body;
    request_.max_iterations = iterations;
    Plan plan = planner_.plan(request_, situation_.map);
    add(work_, plan.work);
    const bool found = !plan.waypoints_W.empty();
    if (found || plan_.waypoints_W.empty()) {
      plan_ = std::move(plan);
      body_ = body;
    }
    return found;
  }

  Situation situation_;
  PathPlanner& planner_;
  const PlanQuery& query_;
  PlanRequest request_;
  Plan plan_;
  Cylinder body_;
  Work work_;
};

}  // namespace

Plan plan_with_tubes(const Situation& situation,
                     PathPlanner& planner,
                     const PlanQuery& query,
                     Cylinder& body) {
  Search search{situation, planner, query};
  Plan plan = search.plan();
  body = search.body();
  return plan;
}

}  // namespace flyball
