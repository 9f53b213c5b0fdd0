// SPDX-License-Identifier: BSD-3-Clause
// tested-in: mission
#include "flyball/flight/navigation/navigation_nodes.h"

#include "flyball/flight/navigation/plan_with_tubes.h"

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto tick_period = 20ms;  // 50 Hz: the most that PX4 wants of off-board set-points.

void add_check(Graph& graph,
               const PerceptionTopics& perception,
               MissionContext& context,
               Navigator& navigator) {
  NodeSpec spec;
  spec.name = "check";
  spec.cost = context.settings.kernels.collision_check;
  spec.trigger = OnMessage{perception.map.index};
  spec.priority = 25;
  graph.node(std::move(spec), [perception, &context, &navigator](JobContext& job) {
    Work work;
    const auto revision = job.latest(perception.map);
    if (!revision) {
      return work;
    }
    navigator.map_published(job.now(), *revision);
    const PathFollower& follower = navigator.follower();
    if (!follower.has_path()) {
      return work;
    }
    const PathSpan span{&follower.path(), follower.s_m(), context.knobs.value("map.range_m")};
    const PathCheck check =
        context.kernels.collision_check->check(context.map(), span, context.narrow_body(), work);
    job.at_end([&navigator, check, number = navigator.path_number()](MissionTime now) {
      navigator.path_checked(now, check, number);
    });
    return work;
  });
}

void add_plan(Graph& graph, const NavigationTopics& topics, MissionContext& context) {
  NodeSpec spec;
  spec.name = "plan";
  spec.cost = context.settings.kernels.planner;
  spec.trigger = OnMessage{topics.plan.request.index};
  spec.priority = 15;
  spec.deadline = 10s;
  spec.writes = {topics.plan.response.index};
  graph.node(std::move(spec), [topics, &context](JobContext& job) {
    const auto query = job.take(topics.plan.request);
    if (!query) {
      return Work{};
    }
    PlanAnswer answer;
    answer.id = query->id;
    answer.start_direction_W = query->start_direction_W;
    answer.lead_in_W = query->lead_in_W;
    if (query->known) {
      answer.body = query->known->body;
      answer.waypoints_W = joined_to(query->start_W, *query->known, context.map());
      job.publish(topics.plan.response, std::move(answer));
      return Work{};
    }
    Plan plan = plan_with_tubes(context, *query, answer.body);
    answer.failure = plan.failure;
    answer.iterations = plan.work.count("iterations");
    answer.waypoints_W = std::move(plan.waypoints_W);
    job.publish(topics.plan.response, std::move(answer));
    return plan.work;
  });
}

/// The plan as a trajectory, or why there is none.
PlannedPath smoothed(const PlanAnswer& answer, const MissionContext& context, Work& work) {
  PlannedPath planned;
  planned.id = answer.id;
  planned.failure = answer.failure;
  planned.way = {answer.waypoints_W, answer.body};
  planned.iterations = answer.iterations;
  if (!planned.failure.empty()) {
    return planned;
  }
  SmoothRequest request;
  request.waypoints_W = answer.waypoints_W;
  if (answer.lead_in_W) {
    request.waypoints_W.insert(request.waypoints_W.begin(), *answer.lead_in_W);
  }
  request.start_velocity_W = answer.start_direction_W;
  request.max_speed_m_s = context.knobs.value("mission.max_speed_m_s");
  request.max_acceleration_m_s2 = 0.5 * context.settings.mission.max_acceleration_m_s2;
  request.body = answer.body;
  auto smooth = context.kernels.smoother->smooth(request, context.map());
  if (smooth) {
    planned.trajectory = std::move(smooth->trajectory);
    work = smooth->work;
  } else {
    planned.failure = smooth.error().message;
    planned.map_moved_on = true;
  }
  return planned;
}

void add_smooth(Graph& graph, const NavigationTopics& topics, MissionContext& context) {
  NodeSpec spec;
  spec.name = "smooth";
  spec.cost = context.settings.kernels.smoother;
  spec.trigger = OnMessage{topics.plan.response.index};
  spec.priority = 15;
  spec.writes = {topics.path.index};
  graph.node(std::move(spec), [topics, &context](JobContext& job) {
    const auto answer = job.take(topics.plan.response);
    if (!answer) {
      return Work{};
    }
    Work work;
    PlannedPath planned = smoothed(*answer, context, work);
    context.recorder.record(job.now(), "plan",
                            {{"ok", static_cast<std::int64_t>(planned.failure.empty())},
                             {"waypoints", static_cast<std::int64_t>(answer->waypoints_W.size())},
                             {"iterations", answer->iterations},
                             {"radius_m", answer->body.radius_m},
                             {"failure", planned.failure}});
    job.publish(topics.path, std::move(planned));
    return work;
  });
}

void add_follow(Graph& graph,
                const VehicleTopics& vehicle,
                Topic<PoseEstimate> pose_topic,
                const NavigationTopics& topics,
                Navigator& navigator) {
  NodeSpec spec;
  spec.name = "follow";
  spec.cost = "track";
  spec.trigger = OnPeriod{tick_period, tick_period};
  spec.priority = 40;
  spec.deadline = tick_period;
  spec.on_miss = OnMiss::brake;
  spec.reads = {pose_topic.index, topics.path.index};
  spec.writes = {vehicle.setpoint.index, topics.plan.request.index};
  graph.node(std::move(spec), [=, &navigator](JobContext& job) {
    Work work;
    work.add("ticks", 1.0);
    const auto pose = job.latest(pose_topic);
    if (const auto planned = job.take(topics.path)) {
      navigator.path_planned(job.now(), *planned);
    }
    if (pose) {
      job.publish(vehicle.setpoint, navigator.tick(job.now(), tick_period, *pose));
    }
    if (auto query = navigator.next_query(job.now())) {
      job.publish(topics.plan.request, *query);
    }
    return work;
  });
}

NavigationTopics add_topics(Graph& graph) {
  NavigationTopics topics;
  topics.plan = graph.service<PlanQuery, PlanAnswer>("plan");
  topics.path = graph.topic<PlannedPath>("path");
  return topics;
}

}  // namespace

NavigationTopics add_path_following(Graph& graph,
                                    const VehicleTopics& vehicle,
                                    Topic<PoseEstimate> pose,
                                    MissionContext& context,
                                    Navigator& navigator) {
  const NavigationTopics topics = add_topics(graph);
  add_smooth(graph, topics, context);
  add_follow(graph, vehicle, pose, topics, navigator);
  return topics;
}

NavigationTopics add_navigation(Graph& graph,
                                const VehicleTopics& vehicle,
                                const PerceptionTopics& perception,
                                MissionContext& context,
                                Navigator& navigator) {
  const NavigationTopics topics = add_topics(graph);
  add_check(graph, perception, context, navigator);
  add_plan(graph, topics, context);
  add_smooth(graph, topics, context);
  add_follow(graph, vehicle, perception.pose, topics, navigator);
  return topics;
}

}  // namespace flyball
