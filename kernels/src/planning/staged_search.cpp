// SPDX-License-Identifier: BSD-3-Clause
#include "planning/staged_search.h"

#include "flyball/runtime/random.h"

#include "planning/path_simplifier.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <utility>

namespace flyball {
namespace {

// This distance is kept from obstacles, so that a later check of the plan in other steps does not
// find it touching one. A door leaves 20 mm.
constexpr double margin_m = 0.003;
// Chosen: most paths stay within 8 m of start and goal; the search then widens to 20 m.
constexpr std::array<double, 2> box_margins_m{8.0, 20.0};

/// Start and goal with `around_m` beside them, inside the bounds. The height is that of the bounds:
/// a path over or under something is often the shortest. A vehicle that has drifted out of the
/// bounds may still start.
Aabb search_box(const PlanRequest& request, double around_m) {
  const Vec3 around{around_m, around_m, 0.0};
  Aabb box{request.start_W.cwiseMin(request.goal_W) - around,
           request.start_W.cwiseMax(request.goal_W) + around};
  box.min.z() = request.bounds_W.min.z();
  box.max.z() = request.bounds_W.max.z();
  box.min = box.min.cwiseMax(request.bounds_W.min).cwiseMin(request.start_W);
  box.max = box.max.cwiseMin(request.bounds_W.max).cwiseMax(request.start_W);
  return box;
}

/// A point of the ellipsoid is at most half of what the path may be longer than the straight line
/// behind its ends, and half the minor axis beside the line.
SearchStage short_path_stage(const PlanRequest& request) {
  const double line_m = (request.goal_W - request.start_W).norm();
  const double longest_m = std::max(request.shorter_than_m, line_m);
  const double aside_m = 0.5 * std::sqrt(longest_m * longest_m - line_m * line_m);
  SearchStage stage{request.start_W, request.goal_W, search_box(request, aside_m),
                    request.max_iterations};
  stage.seed = RandomStream{request.seed, "short_path_stage"}.next();
  stage.shorter_than_m = request.shorter_than_m;
  return stage;
}

Cylinder with_margin(const Cylinder& body) {
  return {body.radius_m + margin_m, body.half_height_m + margin_m};
}

Plan failed(Plan plan, std::string why) {
  plan.failure = std::move(why);
  plan.waypoints_W.clear();
  return plan;
}

/// The place farthest on the way to which a straight piece leads; `here` itself where not even the
/// next one is free. The longest free piece need not lead to the last place that can be
/// reached, but to try all would take too long: lengths are doubled, and then halved.
std::size_t farthest(const std::vector<Vec3>& way_W, std::size_t here, MotionChecker& checker) {
  const std::size_t last = way_W.size() - 1;
  std::size_t reached = here;
  std::size_t step = 1;
  while (reached < last && checker.is_flyable(way_W[here], way_W[std::min(here + step, last)])) {
    reached = std::min(here + step, last);
    step *= 2;
  }
  for (step /= 4; step > 0 && reached > here; step /= 2) {
    const std::size_t next = std::min(reached + step, last);
    if (next > reached && checker.is_flyable(way_W[here], way_W[next])) {
      reached = next;
    }
  }
  return reached;
}

/// The way that was flown, with few way-points; empty where it is not free or leaves the bounds, or
/// a shorter one is looked for.
std::vector<Vec3> free_way(const PlanRequest& request, MotionChecker& checker) {
  const auto is_inside = [&](const Vec3& p_W) { return request.bounds_W.contains(p_W); };
  if (request.flown_W.empty() || std::isfinite(request.shorter_than_m) ||
      !std::all_of(request.flown_W.begin(), request.flown_W.end(), is_inside)) {
    return {};
  }
  std::vector<Vec3> all_W{request.start_W};
  all_W.insert(all_W.end(), request.flown_W.begin(), request.flown_W.end());
  all_W.push_back(request.goal_W);
  std::vector<Vec3> way_W{all_W.front()};
  for (std::size_t here = 0; here + 1 < all_W.size();) {
    const std::size_t next = farthest(all_W, here, checker);
    if (next == here) {
      return {};
    }
    way_W.push_back(all_W[next]);
    here = next;
  }
  return way_W;
}

/// Tries stage after stage; adds what they did to `iterations`.
StageResult search_all(const PlanRequest& request,
                       const TreeSearch& search,
                       MotionChecker& checker) {
  StageResult result;
  int iterations = 0;
  for (const SearchStage& stage : search_stages(request)) {
    checker.expect_motions_in(stage.box_W);
    result = search(stage, checker);
    iterations += result.iterations;
    if (!result.points_W.empty() || !result.error.empty()) {
      break;
    }
  }
  result.iterations = iterations;
  return result;
}

Plan plan_with(const PlanRequest& request, const TreeSearch& search, MotionChecker& checker) {
  Plan plan;
  StageResult found;
  if (checker.is_flyable(request.start_W, request.goal_W)) {
    plan.waypoints_W = {request.start_W, request.goal_W};
  } else {
    found.points_W = free_way(request, checker);
    if (found.points_W.empty()) {
      found = search_all(request, search, checker);
    }
    if (!found.points_W.empty()) {
      plan.waypoints_W = simplify(std::move(found.points_W), checker, request);
    }
  }
  plan.work.add("iterations", found.iterations);
  plan.work.add("collision_queries", checker.queries());
  if (!found.error.empty()) {
    return failed(std::move(plan), found.error);
  }
  if (plan.waypoints_W.empty()) {
    return failed(std::move(plan),
                  "no path within " + std::to_string(request.max_iterations) + " iterations");
  }
  if (length_m(plan.waypoints_W) >= request.shorter_than_m) {
    std::array<char, 64> why{};
    std::snprintf(why.data(), why.size(), "no path shorter than %.1f m", request.shorter_than_m);
    return failed(std::move(plan), why.data());
  }
  return plan;
}

}  // namespace

std::vector<SearchStage> search_stages(const PlanRequest& request) {
  if (std::isfinite(request.shorter_than_m)) {
    return {short_path_stage(request)};
  }
  std::vector<SearchStage> stages;
  const Aabb whole = search_box(request, (request.bounds_W.max - request.bounds_W.min).norm());
  const auto is_whole = [&](const Aabb& box) {
    return box.min == whole.min && box.max == whole.max;
  };
  int left = request.max_iterations;
  for (const double around_m : box_margins_m) {
    SearchStage stage{request.start_W, request.goal_W, search_box(request, around_m),
                      request.max_iterations / 4};
    if (is_whole(stage.box_W)) {
      break;
    }
    left -= stage.max_iterations;
    stages.push_back(stage);
  }
  stages.push_back({request.start_W, request.goal_W, whole, left});
  for (std::size_t i = 0; i < stages.size(); ++i) {
    stages[i].seed = RandomStream{request.seed, "search_stage", i}.next();
  }
  return stages;
}

namespace {

bool is_finite(const PlanRequest& request) {
  return request.start_W.allFinite() && request.goal_W.allFinite() &&
         request.bounds_W.min.allFinite() && request.bounds_W.max.allFinite() &&
         std::isfinite(request.body.radius_m) && std::isfinite(request.body.half_height_m);
}

}  // namespace

Plan staged_plan(const PlanRequest& request, const OccupancyView& map, const TreeSearch& search) {
  MotionChecker bare{map, request.body, request.max_slope_rad};
  MotionChecker wide{map, with_margin(request.body), request.max_slope_rad};
  const auto count = [&](Plan plan, const char* why) {
    plan.work.add("iterations", 0.0);
    plan.work.add("collision_queries", bare.queries() + wide.queries());
    return failed(std::move(plan), why);
  };
  if (!is_finite(request)) {
    return count({}, "not finite");
  }
  if (!bare.is_free(request.start_W)) {
    return count({}, "start blocked");
  }
  if (!request.bounds_W.contains(request.goal_W) || !bare.is_free(request.goal_W)) {
    return count({}, "goal blocked");
  }
  // A vehicle may have stopped closer to something than the margin.
  const bool roomy = wide.is_free(request.start_W) && wide.is_free(request.goal_W);
  Plan plan = plan_with(request, search, roomy ? wide : bare);
  plan.work.add("collision_queries", roomy ? bare.queries() : wide.queries());
  return plan;
}

}  // namespace flyball
