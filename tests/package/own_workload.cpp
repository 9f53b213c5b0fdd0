// SPDX-License-Identifier: BSD-3-Clause
//
// A workload of somebody else's, against installed headers: takes off, waits five seconds, lands.

#include <cstdio>
#include <optional>

#include <flyball/flight/legs.h>
#include <flyball/flight/navigation/navigation_nodes.h>
#include <flyball/flight/workload.h>
#include <flyball/scenario/plugins.h>
#include <flyball/simulation/mission.h>

using namespace flyball;
using namespace std::chrono_literals;
class LookAround final : public Workload {
 public:
  void build(Graph& graph, const VehicleTopics& vehicle, MissionContext& context) override {
    navigator_.emplace(context);
    legs_.emplace(context, vehicle);
    const PerceptionTopics perception = add_perception(graph, vehicle, context);
    add_navigation(graph, vehicle, perception, context, *navigator_);
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    legs_->declare(spec);
    graph.node(std::move(spec), [this, &context](JobContext& job) {
      if (context.phase == MissionPhase::wait) {
        navigator_->hover_at(context.brief.start_W + Vec3{0.0, 0.0, 2.0}, 0.0);
        legs_->take_off(job, 2.0);
      } else if (context.phase == MissionPhase::take_off && legs_->are_done(job)) {
        context.phase = MissionPhase::cruise;
        up_ = job.now();
      } else if (context.phase == MissionPhase::cruise && job.now() > up_ + 5s) {
        legs_->land(job);
      } else if (context.phase == MissionPhase::land && legs_->are_done(job)) {
        context.finish(job.now(), MissionStatus::succeeded, MissionFailure::none);
      }
      return Work{};
    });
  }
  const Navigator* navigator() const override { return &*navigator_; }

 private:
  std::optional<Navigator> navigator_;
  std::optional<Legs> legs_;
  MissionTime up_{};
};

int main() {
  add_plugins([](Registry& registry) {
    registry.add<Workload>("look_around", [] { return std::make_unique<LookAround>(); });
  });
  Scenario scenario;
  scenario.mission.workload = "look_around";
  const auto record = fly(scenario, {});
  std::puts(record ? to_string(record->summary.status) : record.error().message.c_str());
  return record && record->summary.status == MissionStatus::succeeded ? 0 : 1;
}
