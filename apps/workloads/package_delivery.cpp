// SPDX-License-Identifier: BSD-3-Clause
//
// Package delivery, there and back: take off, fly to the goal, land, leave the payload, take off,
// fly home, land. Dataflow as in MAVBench (MICRO 2018), figure of package delivery.

#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include "flight/navigation/navigation_nodes.h"
#include <memory>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

constexpr double clear_radius_m = 1.0;  // Of the cylinders at start and goal that the scenario
constexpr double clear_height_m = 2.5;  // declares free.

class PackageDelivery final : public Workload {
 public:
  void build(Graph& graph, const VehicleTopics& vehicle, MissionContext& context) override {
    context_ = &context;
    navigator_ = std::make_unique<Navigator>(context);
    vehicle_ = vehicle;
    perception_ = add_perception(graph, vehicle, context);
    add_navigation(graph, vehicle, perception_, context, *navigator_);
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    spec.reads = {perception_.pose.index, vehicle.status.index};
    spec.writes = {vehicle.command.index};
    graph.node(std::move(spec), [this](JobContext& job) { return step(job); });
  }

  [[nodiscard]] bool flies_to_goal() const override { return true; }
  [[nodiscard]] const Navigator* navigator() const override { return navigator_.get(); }

 private:
  enum class Leg : std::uint8_t { out, back };
  enum class Stage : std::uint8_t { ready, climbing, flying, landing };

  Work step(JobContext& job) {
    const auto pose = job.latest(perception_.pose);
    const auto status = job.latest(vehicle_.status);
    if (pose && status && !context_->is_over()) {
      advance(job, *pose, *status);
    }
    return {};
  }

  void advance(JobContext& job, const PoseEstimate& pose, const FlightStatus& status) {
    switch (stage_) {
      case Stage::ready:
        take_off(job, pose);
        break;
      case Stage::climbing:
        if (status.manoeuvre_done) {
          depart(job);
        }
        break;
      case Stage::flying:
        if (navigator_->has_arrived() && navigator_->tracking_error().size_m < 0.1) {
          land(job);
        }
        break;
      case Stage::landing:
        if (status.manoeuvre_done) {
          touched_down(job);
        }
        break;
    }
  }

  [[nodiscard]] Vec3 above(const Vec3& ground_W) const {
    return ground_W + Vec3::UnitZ() * context_->brief.cruise_height_m;
  }

  /// Where the leg begins.
  [[nodiscard]] const Vec3& site(Leg leg) const {
    return leg == Leg::out ? context_->brief.start_W : context_->brief.goal_W;
  }

  void declare_clear() {
    for (const Vec3& site_W : {context_->brief.start_W, context_->brief.goal_W}) {
      const Vec3 centre_W = site_W + Vec3::UnitZ() * (0.5 * clear_height_m);
      context_->kernels.mapper->declare_clear(centre_W, {clear_radius_m, 0.5 * clear_height_m});
    }
  }

  void take_off(JobContext& job, const PoseEstimate& pose) {
    declare_clear();
    navigator_->hover_at(above(site(leg_)), yaw_of(pose.X_WB.linear().col(0)));
    context_->phase = MissionPhase::take_off;
    job.publish(vehicle_.command,
                FlightCommand{FlightCommand::Kind::take_off, context_->brief.cruise_height_m});
    stage_ = Stage::climbing;
    settle_ = job.now() + 500ms;  // The status on its way now is from before the command.
  }

  void depart(JobContext& job) {
    if (job.now() < settle_) {
      return;
    }
    navigator_->set_goal(job.now(), above(site(leg_ == Leg::out ? Leg::back : Leg::out)));
    context_->phase = MissionPhase::cruise;
    stage_ = Stage::flying;
    context_->event(job.now(), leg_ == Leg::out ? "outbound" : "homebound");
  }

  void land(JobContext& job) {
    navigator_->clear_goal();
    context_->phase = MissionPhase::land;
    job.publish(vehicle_.command, FlightCommand{FlightCommand::Kind::land, 0.0});
    stage_ = Stage::landing;
    settle_ = job.now() + 500ms;
  }

  void touched_down(JobContext& job) {
    if (job.now() < settle_) {
      return;
    }
    if (leg_ == Leg::back) {
      context_->finish(job.now(), MissionStatus::succeeded, MissionFailure::none);
      return;
    }
    job.publish(vehicle_.command, FlightCommand{FlightCommand::Kind::release_payload, 0.0});
    context_->event(job.now(), "delivered");
    leg_ = Leg::back;
    stage_ = Stage::ready;
  }

  MissionContext* context_{};
  std::unique_ptr<Navigator> navigator_;
  VehicleTopics vehicle_{};
  PerceptionTopics perception_{};
  Leg leg_{Leg::out};
  Stage stage_{Stage::ready};
  MissionTime settle_{};
};

}  // namespace

FLYBALL_PLUGIN(package_delivery) {
  registry.add<flyball::Workload>("package_delivery",
                                  [] { return std::make_unique<PackageDelivery>(); });
}
