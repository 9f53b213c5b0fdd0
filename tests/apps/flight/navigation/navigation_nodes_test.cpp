// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/navigation_nodes.h"

#include "flyball/runtime/modeled/virtual_executor.h"

#include "grid_map.h"
#include "mission_rig.h"
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

/// The nodes from map to set-point, in a corridor along x, and the paths that come out of them.
class NavigationNodes : public testing::Test {
 protected:
  NavigationNodes() {
    kernels_of(rig.kernels, rig.scenario.plugins);
    const FlightParts parts = rig.parts(graph);
    mission = parts.mission;
    perception = add_perception(graph, parts);
    topics = add_navigation(graph, parts, perception);
  }

  static void kernels_of(MissionKernels& kernels, const Plugins& plugins) {
    kernels.planner = plugins.make<PathPlanner>("rrt");
    kernels.smoother = plugins.make<Smoother>("minimum_jerk");
    kernels.collision_check = plugins.make<CollisionChecker>("swept_cylinder");
  }

  /// What becomes of a query.
  PlannedPath answer_to(const PlanQuery& query) {
    VirtualExecutor executor{graph, *rig.platform, queue, {1, Hertz{1e9}}};
    executor.subscribe<PlannedPath>(topics.path,
                                    [this](const PlannedPath& path) { paths.push_back(path); });
    executor.publish(mission.knobs, *rig.knobs);
    executor.publish(perception.map,
                     MapRevision{1, MissionTime{}, 0.15, std::make_shared<kit::GridMap>(map)});
    executor.publish(topics.plan.request, query);
    queue.run([&] { return queue.now() >= MissionTime{1s}; });
    EXPECT_EQ(paths.size(), 1U);
    return paths.empty() ? PlannedPath{} : paths.front();
  }

  kit::GridMap map = kit::corridor(20.0);
  kit::MissionRig rig{map};
  EventQueue queue;
  Graph graph{"navigation"};
  MissionTopics mission;
  PerceptionTopics perception;
  NavigationTopics topics;
  std::vector<PlannedPath> paths;
};

/// A known path whose next corner, (2, .5), lies behind a vehicle at (5, 0) that flies east.
PlanQuery joins_behind() {
  PlanQuery query;
  query.id = 7;
  query.start_W = {5.0, 0.0, 1.5};
  query.start_direction_W = Vec3::UnitX();
  query.goal_W = {2.0, 2.0, 1.5};
  query.known = KnownPath{{{6.0, 0.0, 1.5}, {2.0, 0.5, 1.5}, {2.0, 2.0, 1.5}}, {0.4, 0.15}};
  return query;
}

TEST_F(NavigationNodes, join_no_path_that_begins_backwards_for_a_fast_vehicle) {
  PlanQuery query = joins_behind();
  query.may_turn_back = false;
  const PlannedPath planned = answer_to(query);
  EXPECT_EQ(planned.id, 7U);
  EXPECT_EQ(planned.failure, "it would turn back");
  EXPECT_FALSE(planned.map_moved_on);
}

TEST_F(NavigationNodes, join_a_path_that_begins_backwards_when_there_is_time_to_turn) {
  const PlannedPath planned = answer_to(joins_behind());
  EXPECT_EQ(planned.failure, "");
  EXPECT_EQ(planned.iterations, 0.0) << "nothing is searched for";
  EXPECT_FALSE(planned.trajectory.pieces.empty());
}

TEST_F(NavigationNodes, say_why_there_is_no_path) {
  rig.brief->site.bounds_W = {Vec3{-2.0, -3.0, 0.0}, Vec3{60.0, 3.0, 3.0}};
  PlanQuery query = joins_behind();
  query.known.reset();
  map.fill({query.start_W - Vec3::Constant(0.1), query.start_W + Vec3::Constant(0.1)},
           CellState::occupied);
  EXPECT_EQ(answer_to(query).failure, "start blocked");
}

}  // namespace
}  // namespace flyball
