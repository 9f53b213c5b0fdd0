// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/navigation_nodes.h"

#include "flyball/flight/navigation/flown_way.h"
#include "flyball/flight/navigation/follow_node.h"
#include "flyball/flight/navigation/plan_with_tubes.h"
#include "flyball/flight/navigation/sub_goal.h"
#include "flyball/flight/perception/counted_map.h"

#include <functional>
#include <utility>

namespace flyball {
namespace {

using namespace std::chrono_literals;

/// The newest map that a job may look at; null before the first one.
using MapSource = std::function<std::shared_ptr<const OccupancyView>(JobContext&)>;

/// Holds the committed path against each new map, and hands both on.
void add_check(Graph& graph,
               const FlightParts& parts,
               const PerceptionTopics& perception,
               const NavigationTopics& topics) {
  NodeSpec spec;
  spec.name = "check";
  spec.cost = parts.brief->settings.kernels.collision_check;
  spec.trigger = OnMessage{perception.map.index};
  spec.priority = 25;
  spec.reads = {topics.guidance.state.index, parts.mission.knobs.index};
  spec.writes = {topics.clearance->index};
  graph.node(std::move(spec), [=, brief = parts.brief, knobs_topic = parts.mission.knobs,
                               checker = parts.kernels.collision_check](JobContext& job) {
    Work work;
    const auto revision = job.latest(perception.map);
    const auto knobs = job.latest(knobs_topic);
    if (!revision || !knobs) {
      return work;
    }
    PathClearance clearance;
    clearance.revision = *revision;
    clearance.published = job.released();
    const auto navigator = job.latest(topics.guidance.state);
    if (navigator && navigator->has_path()) {
      const Path& path = *navigator->path;
      const PathSpan span{&path, navigator->s_m, knobs->value("map.range_m")};
      clearance.path_number = navigator->path_number;
      checker->apply(knobs->knobs);
      clearance.blocked_at_m =
          checker->check(*revision->map, span, brief->narrow_body(), work).blocked_at_m;
      const CountedMap map{*revision->map};
      clearance.free_until_m = known_free_until_m(map, path, navigator->s_m, *brief, *knobs);
      map.add_to(work);
    }
    job.publish(*topics.clearance, std::move(clearance));
    return work;
  });
}

/// The goal of the next leg in place of the mission's, which may be too far away for one plan.
void choose_leg(const Situation& situation, PlanQuery& query) {
  query.flown_W = free_leg_W(situation, std::move(query.flown_W));
  if (query.flown_W.empty()) {
    query.goal_W = sub_goal_W(situation, query.start_W, query.goal_W, query.failures);
  } else if ((query.flown_W.back() - query.goal_W).norm() > beside_way_m) {
    query.goal_W = query.flown_W.back();
  }
}

/// The answer to one query, and what it cost: the search, and what else the map was asked.
PlanAnswer planned(const Situation& situation, PathPlanner& planner, PlanQuery query, Work& work) {
  const CountedMap map{situation.map};
  PlanAnswer answer;
  answer.id = query.id;
  answer.start_direction_W = query.start_direction_W;
  if (query.known) {
    answer.body = query.known->body;
    answer.waypoints_W = joined_to(query.start_W, *query.known, map);
    map.add_to(work);
    if (!query.may_turn_back && turns_back(answer.waypoints_W, query.start_direction_W)) {
      answer.failure = "it would turn back";
    }
    return answer;
  }
  choose_leg({situation.brief, situation.knobs, map}, query);
  Plan plan = plan_with_tubes(situation, planner, query, answer.body);
  answer.failure = plan.failure;
  answer.iterations = plan.work.count("iterations");
  answer.waypoints_W = std::move(plan.waypoints_W);
  work = plan.work;
  map.add_to(work);
  return answer;
}

void add_plan(Graph& graph,
              const FlightParts& parts,
              const PerceptionTopics& perception,
              const NavigationTopics& topics) {
  NodeSpec spec;
  spec.name = "plan";
  spec.cost = parts.brief->settings.kernels.planner;
  spec.trigger = OnMessage{topics.plan.request.index};
  spec.priority = 15;
  spec.deadline = 10s;
  spec.reads = {perception.map.index, parts.mission.knobs.index};
  spec.writes = {topics.plan.response.index};
  graph.node(std::move(spec), [=, brief = parts.brief, knobs_topic = parts.mission.knobs,
                               planner = parts.kernels.planner](JobContext& job) {
    Work work;
    const auto query = job.take(topics.plan.request);
    const auto revision = job.latest(perception.map);
    const auto knobs = job.latest(knobs_topic);
    if (query && revision && knobs) {
      planner->apply(knobs->knobs);
      job.publish(topics.plan.response,
                  planned({*brief, *knobs, *revision->map}, *planner, *query, work));
    }
    return work;
  });
}

/// The plan as a trajectory, or why there is none.
PlannedPath smoothed(const PlanAnswer& answer,
                     const Situation& situation,
                     Smoother& smoother,
                     Work& work) {
  PlannedPath planned;
  planned.id = answer.id;
  planned.failure = answer.failure;
  planned.path = {answer.waypoints_W, answer.body};
  planned.iterations = answer.iterations;
  if (!planned.failure.empty()) {
    return planned;
  }
  SmoothRequest request;
  request.waypoints_W = answer.waypoints_W;
  request.start_velocity_W = answer.start_direction_W;
  request.max_speed_m_s = situation.knobs.value("mission.max_speed_m_s");
  request.max_acceleration_m_s2 = 0.5 * situation.brief.settings.mission.max_acceleration_m_s2;
  request.body = answer.body;
  request.bounds_W = situation.brief.site.bounds_W;
  auto smooth = smoother.smooth(request, situation.map);
  if (smooth) {
    planned.trajectory = std::move(smooth->trajectory);
    work = smooth->work;
  } else {
    planned.failure = smooth.error().message;
    planned.map_moved_on = true;
  }
  return planned;
}

void log_plan(JobContext& job,
              const MissionTopics& mission,
              const PlanAnswer& answer,
              const PlannedPath& planned) {
  log(job, mission, "plan",
      {{"ok", static_cast<std::int64_t>(planned.failure.empty())},
       {"waypoints", static_cast<std::int64_t>(answer.waypoints_W.size())},
       {"iterations", answer.iterations},
       {"radius_m", answer.body.radius_m},
       {"failure", planned.failure}});
}

/// @param reads_map  The topic that `map` reads; -1: none.
void add_smooth(Graph& graph,
                const FlightParts& parts,
                const NavigationTopics& topics,
                const MapSource& newest_map,
                int reads_map) {
  NodeSpec spec;
  spec.name = "smooth";
  spec.cost = parts.brief->settings.kernels.smoother;
  spec.trigger = OnMessage{topics.plan.response.index};
  spec.priority = 15;
  spec.reads = {parts.mission.knobs.index};
  if (reads_map >= 0) {
    spec.reads.push_back(reads_map);
  }
  spec.writes = {topics.path.index};
  declare_log(spec, parts.mission);
  graph.node(std::move(spec), [=, brief = parts.brief, mission = parts.mission,
                               smoother = parts.kernels.smoother](JobContext& job) {
    Work work;
    const auto answer = job.take(topics.plan.response);
    const auto knobs = job.latest(mission.knobs);
    const auto map = newest_map(job);
    if (answer && knobs && map) {
      smoother->apply(knobs->knobs);
      PlannedPath planned = smoothed(*answer, {*brief, *knobs, *map}, *smoother, work);
      log_plan(job, mission, *answer, planned);
      job.publish(topics.path, std::move(planned));
    }
    return work;
  });
}

NavigationTopics add_topics(Graph& graph) {
  NavigationTopics topics;
  topics.guidance.command = graph.topic<GuidanceCommand>("guidance", 8);
  topics.guidance.state = graph.topic<NavigatorState>("navigator");
  topics.plan = graph.service<PlanQuery, PlanAnswer>("plan");
  topics.path = graph.topic<PlannedPath>("path");
  topics.map_use = graph.topic<MapUse>("map_use", 8);
  return topics;
}

}  // namespace

NavigationTopics add_path_following(Graph& graph,
                                    const FlightParts& parts,
                                    const LocalizationTopics& localization,
                                    std::shared_ptr<const OccupancyView> declared) {
  const NavigationTopics topics = add_topics(graph);
  add_smooth(
      graph, parts, topics, [declared](JobContext& /*job*/) { return declared; }, -1);
  FollowNode follow{parts, localization, topics};
  follow.declared = std::move(declared);
  add_follow(graph, follow);
  return topics;
}

NavigationTopics add_navigation(Graph& graph,
                                const FlightParts& parts,
                                const PerceptionTopics& perception) {
  NavigationTopics topics = add_topics(graph);
  topics.clearance = graph.topic<PathClearance>("clearance");
  const auto newest_map = [map = perception.map](JobContext& job) {
    const auto revision = job.latest(map);
    return revision ? revision->map : nullptr;
  };
  add_check(graph, parts, perception, topics);
  add_plan(graph, parts, perception, topics);
  add_smooth(graph, parts, topics, newest_map, perception.map.index);
  FollowNode follow{parts, perception.localization, topics};
  follow.map_hints = perception.map_hints;
  add_follow(graph, follow);
  return topics;
}

}  // namespace flyball
