// SPDX-License-Identifier: BSD-3-Clause
// tested-in: mission
#include "flyball/flight/navigation/follow_node.h"

#include "flyball/flight/navigation/navigator.h"

#include <utility>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto tick_period = 20ms;  // 50 Hz: the most that PX4 wants of off-board set-points.

class Follow {
 public:
  explicit Follow(const FollowNode& node)
      : node_{node}, navigator_{node.parts.brief, node.parts.kernels.path_tracker} {
    if (node.declared) {
      navigator_.set_declared_map(node.declared);
    }
  }

  Work operator()(JobContext& job) {
    Work work;
    const auto knobs = job.latest(mission().knobs);
    if (knobs) {
      navigator_.set_knobs(job.now(), knobs);
      hear(job);
      work = speak(job);
    }
    work.add("ticks", 1.0);
    return work;
  }

 private:
  [[nodiscard]] const MissionTopics& mission() const { return node_.parts.mission; }

  void hear(JobContext& job) {
    while (const auto command = job.take(node_.topics.guidance.command)) {
      navigator_.obey(job.now(), *command);
    }
    const auto& checked = node_.topics.clearance;
    if (const auto clearance = checked ? job.take(*checked) : nullptr) {
      navigator_.path_checked(job.now(), *clearance);
    }
    if (const auto planned = job.take(node_.topics.path)) {
      navigator_.path_planned(job.now(), *planned);
    }
  }

  /// The localizer is lost: what it asks for, instead of the path.
  [[nodiscard]] std::optional<Setpoint> search(JobContext& job) const {
    const auto where = job.latest(node_.localization.status);
    const bool counts = where && is_in(job, mission(), MissionPhase::cruise);
    return counts ? where->search : std::nullopt;
  }

  /// @return What was asked of the map.
  Work speak(JobContext& job) {
    if (const auto pose = job.latest(node_.localization.pose)) {
      job.publish(node_.parts.vehicle.setpoint,
                  navigator_.tick(job.now(), tick_period, *pose, search(job)));
    }
    if (auto query = navigator_.next_query(job.now())) {
      job.publish(node_.topics.plan.request, std::move(*query));
    }
    const NavigatorNews news = navigator_.news();
    tell(job, news);
    job.publish(node_.topics.guidance.state, navigator_.state());
    return news.asked;
  }

  void tell(JobContext& job, const NavigatorNews& news) {
    for (const std::string& event : news.events) {
      log_event(job, mission(), event);
    }
    for (const MapHint& hint : node_.map_hints ? news.map_hints : std::vector<MapHint>{}) {
      job.publish(*node_.map_hints, hint);
    }
    if (news.map_use) {
      job.publish(node_.topics.map_use, *news.map_use);
    }
    if (news.gives_up) {
      end_mission(job, mission(), MissionStatus::failed, MissionFailure::no_plan);
    }
  }

  FollowNode node_;
  Navigator navigator_;
};

}  // namespace

void add_follow(Graph& graph, const FollowNode& node) {
  const NavigationTopics& topics = node.topics;
  const MissionTopics& mission = node.parts.mission;
  NodeSpec spec;
  spec.name = "follow";
  spec.cost = "track";
  spec.trigger = OnPeriod{tick_period, tick_period};
  spec.priority = 40;
  spec.deadline = tick_period;
  spec.on_miss = OnMiss::brake;
  spec.reads = {node.localization.pose.index,  node.localization.status.index,
                topics.guidance.command.index, topics.path.index,
                mission.knobs.index,           mission.state.index};
  spec.writes = {node.parts.vehicle.setpoint.index, topics.plan.request.index,
                 topics.guidance.state.index, topics.map_use.index, mission.end.index};
  if (topics.clearance) {
    spec.reads.push_back(topics.clearance->index);
  }
  if (node.map_hints) {
    spec.writes.push_back(node.map_hints->index);
  }
  declare_log(spec, mission);
  auto follow = std::make_shared<Follow>(node);  // Owner: this node alone.
  graph.node(std::move(spec), [follow](JobContext& job) { return (*follow)(job); });
}

}  // namespace flyball
