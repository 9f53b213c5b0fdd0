// SPDX-License-Identifier: BSD-3-Clause
//
// Package delivery, there and back: take off, fly to the goal, land, leave the payload, take off,
// fly home, land. Dataflow as in MAVBench (MICRO 2018), figure of package delivery.

#include "flyball/flight/legs.h"
#include "flyball/flight/navigation/navigation_nodes.h"
#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include <memory>
#include <optional>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

class PackageDelivery final : public Workload {
 public:
  void build(Graph& graph, const VehicleTopics& vehicle, MissionContext& context) override {
    context_ = &context;
    navigator_ = std::make_unique<Navigator>(context);
    perception_ = add_perception(graph, vehicle, context);
    add_navigation(graph, vehicle, perception_, context, *navigator_);
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    spec.reads = {perception_.pose.index};
    legs_.emplace(context, vehicle);
    legs_->declare(spec);
    graph.node(std::move(spec), [this](JobContext& job) { return step(job); });
  }

  [[nodiscard]] bool flies_to_goal() const override { return true; }
  [[nodiscard]] const Navigator* navigator() const override { return navigator_.get(); }

 private:
  enum class Leg : std::uint8_t { out, back };
  enum class Stage : std::uint8_t { ready, climbing, flying, landing };

  Work step(JobContext& job) {
    const auto pose = job.latest(perception_.pose);
    if (pose && !context_->is_over()) {
      advance(job, *pose);
    }
    return {};
  }

  void advance(JobContext& job, const PoseEstimate& pose) {
    switch (stage_) {
      case Stage::ready:
        take_off(job, pose);
        break;
      case Stage::climbing:
        if (legs_->are_done(job)) {
          depart(job);
        }
        break;
      case Stage::flying:
        if (navigator_->has_arrived() && navigator_->tracking_error().size_m < 0.1) {
          land(job);
        }
        break;
      case Stage::landing:
        if (legs_->are_done(job)) {
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

  void take_off(JobContext& job, const PoseEstimate& pose) {
    for (const Vec3& site_W : {context_->brief.start_W, context_->brief.goal_W}) {
      declare_clear_over(*context_->kernels.mapper, site_W);
    }
    navigator_->hover_at(above(site(leg_)), yaw_of(pose.X_WB.linear().col(0)));
    legs_->take_off(job, context_->brief.cruise_height_m);
    stage_ = Stage::climbing;
  }

  void depart(JobContext& job) {
    navigator_->set_goal(job.now(), above(site(leg_ == Leg::out ? Leg::back : Leg::out)));
    context_->phase = MissionPhase::cruise;
    stage_ = Stage::flying;
    context_->event(job.now(), leg_ == Leg::out ? "outbound" : "homebound");
  }

  void land(JobContext& job) {
    navigator_->clear_goal();
    legs_->land(job);
    stage_ = Stage::landing;
  }

  void touched_down(JobContext& job) {
    if (leg_ == Leg::back) {
      context_->finish(job.now(), MissionStatus::succeeded, MissionFailure::none);
      return;
    }
    legs_->release_payload(job);
    context_->event(job.now(), "delivered");
    leg_ = Leg::back;
    stage_ = Stage::ready;
  }

  MissionContext* context_{};
  std::unique_ptr<Navigator> navigator_;
  std::optional<Legs> legs_{};
  PerceptionTopics perception_{};
  Leg leg_{Leg::out};
  Stage stage_{Stage::ready};
};

}  // namespace

FLYBALL_PLUGIN(package_delivery) {
  registry.add<flyball::Workload>("package_delivery",
                                  [] { return std::make_unique<PackageDelivery>(); });
}
