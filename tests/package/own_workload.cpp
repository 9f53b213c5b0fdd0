// SPDX-License-Identifier: BSD-3-Clause
// A workload of somebody else's, against installed headers: takes off, waits five seconds, lands.

#include <cstdio>
#include <optional>

#include <flyball/flight/legs.h>
#include <flyball/flight/navigation/navigation_nodes.h>
#include <flyball/flight/workload.h>
#include <flyball/simulation/mission.h>

using namespace flyball;
using namespace std::chrono_literals;
class LookAround final : public Workload {
 public:
  void build(Graph& graph, const FlightParts& parts) override {
    guidance_.emplace(add_navigation(graph, parts, add_perception(graph, parts)).guidance);
    legs_.emplace(parts.vehicle, parts.mission);
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.writes = {parts.mission.end.index};
    legs_->declare(spec);
    guidance_->declare(spec);
    graph.node(std::move(spec), [this, parts](JobContext& job) {
      if (stage_ == 0) {
        guidance_->hover_at(job, parts.brief->site.start_W + Vec3{0.0, 0.0, 2.0}, 0.0);
        legs_->take_off(job, 2.0);
        stage_ = 1;
      } else if (stage_ == 1 && legs_->are_done(job)) {
        legs_->enter(job, MissionPhase::cruise);
        land_at_ = job.now() + 5s;
        stage_ = 2;
      } else if (stage_ == 2 && job.now() >= land_at_) {
        legs_->land(job);
        stage_ = 3;
      } else if (stage_ == 3 && legs_->are_done(job)) {
        end_mission(job, parts.mission, MissionStatus::succeeded, MissionFailure::none);
      }
      return Work{};
    });
  }

 private:
  std::optional<Guidance> guidance_;
  std::optional<Legs> legs_;
  int stage_{};
  MissionTime land_at_{};
};
int main() {
  Scenario scenario;
  scenario.plugins = Plugins{}.with([](Registry& registry) {
    registry.add<Workload>("look_around", [] { return std::make_unique<LookAround>(); });
  });
  scenario.mission.workload = "look_around";
  const auto record = fly(scenario, {});
  std::puts(record ? to_string(record->summary.status) : record.error().message.c_str());
  return record && record->summary.status == MissionStatus::succeeded ? 0 : 1;
}
