// SPDX-License-Identifier: BSD-3-Clause
//
// Package delivery, there and back: the vehicle takes off, flies to the goal, lands, leaves the
// payload, takes off, flies home and lands. The dataflow is that of MAVBench (MICRO 2018), figure
// of package delivery.

#include "flyball/flight/navigation/round_trip.h"
#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include <memory>
#include <optional>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

class PackageDelivery final : public Workload {
 public:
  void build(Graph& graph, const FlightParts& parts) override {
    mission_ = parts.mission;
    const PerceptionTopics perception = add_perception(graph, parts);
    const Guidance guidance{add_navigation(graph, parts, perception).guidance};
    trip_.emplace(parts, perception, guidance);
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    spec.reads = {perception.localization.pose.index};
    spec.writes = {mission_.progress.index, mission_.end.index};
    trip_->declare(spec);
    graph.node(std::move(spec), [this, pose = perception.localization.pose](JobContext& job) {
      if (const auto newest = job.latest(pose)) {
        advance(job, *newest);
      }
      return Work{};
    });
  }

  [[nodiscard]] bool flies_to_goal() const override { return true; }

 private:
  void advance(JobContext& job, const PoseEstimate& pose) {
    if (trip_->is_flying()) {
      tell_progress(job, mission_, ProgressUnit::metre, trip_->nearer_m(pose.X_WB.translation()));
    }
    switch (trip_->step(job, pose)) {
      case RoundTrip::Landed::no:
        break;
      case RoundTrip::Landed::at_goal:
        trip_->legs().release_payload(job);
        log_event(job, mission_, "delivered");
        trip_->go_home();
        break;
      case RoundTrip::Landed::at_home:
        end_mission(job, mission_, MissionStatus::succeeded, MissionFailure::none);
        break;
    }
  }

  MissionTopics mission_{};
  std::optional<RoundTrip> trip_{};
};

}  // namespace

FLYBALL_PLUGIN(package_delivery) {
  registry.add<flyball::Workload>("package_delivery",
                                  [] { return std::make_unique<PackageDelivery>(); });
}
