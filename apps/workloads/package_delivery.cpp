// SPDX-License-Identifier: BSD-3-Clause
//
// Package delivery, there and back: the vehicle takes off, flies to the goal, lands, leaves the
// payload, takes off, flies home and lands. The dataflow is that of MAVBench (MICRO 2018), figure
// of package delivery.

#include "flyball/flight/flight_parts.h"
#include "flyball/flight/legs.h"
#include "flyball/flight/navigation/navigation_nodes.h"
#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

class PackageDelivery final : public Workload {
 public:
  void build(Graph& graph, const FlightParts& parts) override {
    brief_ = parts.brief;
    mission_ = parts.mission;
    perception_ = add_perception(graph, parts);
    guidance_.emplace(add_navigation(graph, parts, perception_).guidance);
    legs_.emplace(parts.vehicle, parts.mission);
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    spec.reads = {perception_.localization.pose.index};
    spec.writes = {perception_.clear.index, mission_.progress.index, mission_.end.index};
    legs_->declare(spec);
    guidance_->declare(spec);
    declare_log(spec, mission_);
    graph.node(std::move(spec), [this](JobContext& job) { return step(job); });
  }

  [[nodiscard]] bool flies_to_goal() const override { return true; }

 private:
  enum class Leg : std::uint8_t { out, back };
  enum class Stage : std::uint8_t { ready, climbing, flying, landing, done };

  Work step(JobContext& job) {
    if (const auto pose = job.latest(perception_.localization.pose)) {
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
        tell_metres(job, pose);
        if (has_arrived(job)) {
          land(job);
        }
        break;
      case Stage::landing:
        if (legs_->are_done(job)) {
          touched_down(job);
        }
        break;
      case Stage::done:
        break;
    }
  }

  [[nodiscard]] bool has_arrived(JobContext& job) const {
    const auto navigator = guidance_->state(job);
    return navigator && navigator->has_arrived && navigator->tracking_error.size_m < 0.1;
  }

  /// As the crow flies. A detour is no progress, and neither is the way back from one a loss.
  void tell_metres(JobContext& job, const PoseEstimate& pose) {
    const Vec3 goal_W = above(site(leg_ == Leg::out ? Leg::back : Leg::out));
    const double leg_m = (brief_->site.goal_W - brief_->site.start_W).norm();
    const double flown_m = leg_m - (goal_W - pose.X_WB.translation()).norm();
    nearer_m_ = std::max(nearer_m_, flown_m + (leg_ == Leg::back ? leg_m : 0.0));
    tell_progress(job, mission_, ProgressUnit::metre, nearer_m_);
  }

  [[nodiscard]] Vec3 above(const Vec3& ground_W) const {
    return ground_W + Vec3::UnitZ() * brief_->site.cruise_height_m;
  }

  /// Start and goal may be one place. There is no path between them, so none is asked for.
  [[nodiscard]] bool is_at_goal() const {
    const double apart_m = (brief_->site.goal_W - brief_->site.start_W).norm();
    return apart_m < brief_->settings.mission.goal_tolerance_m;
  }

  /// Where the leg begins.
  [[nodiscard]] const Vec3& site(Leg leg) const {
    return leg == Leg::out ? brief_->site.start_W : brief_->site.goal_W;
  }

  void take_off(JobContext& job, const PoseEstimate& pose) {
    const Site& places = brief_->site;
    job.publish(perception_.clear, clear_over(places.start_W, places.start_clear_m));
    job.publish(perception_.clear, clear_over(places.goal_W, places.goal_clear_m));
    guidance_->hover_at(job, above(site(leg_)), yaw_of(pose.X_WB.linear().col(0)));
    legs_->take_off(job, brief_->site.cruise_height_m);
    stage_ = Stage::climbing;
  }

  void depart(JobContext& job) {
    if (is_at_goal()) {
      land(job);
      return;
    }
    guidance_->go_to(job, above(site(leg_ == Leg::out ? Leg::back : Leg::out)));
    legs_->enter(job, MissionPhase::cruise);
    stage_ = Stage::flying;
    log_event(job, mission_, leg_ == Leg::out ? "outbound" : "homebound");
  }

  void land(JobContext& job) {
    guidance_->give_up_goal(job);
    legs_->land(job);
    stage_ = Stage::landing;
  }

  void touched_down(JobContext& job) {
    if (leg_ == Leg::back) {
      end_mission(job, mission_, MissionStatus::succeeded, MissionFailure::none);
      stage_ = Stage::done;
      return;
    }
    legs_->release_payload(job);
    log_event(job, mission_, "delivered");
    leg_ = Leg::back;
    stage_ = Stage::ready;
  }

  std::shared_ptr<const Brief> brief_{};  ///< Owners: all nodes.
  MissionTopics mission_{};
  PerceptionTopics perception_{};
  std::optional<Guidance> guidance_{};
  std::optional<Legs> legs_{};
  Leg leg_{Leg::out};
  Stage stage_{Stage::ready};
  double nearer_m_{};  ///< To the goals of both legs together.
};

}  // namespace

FLYBALL_PLUGIN(package_delivery) {
  registry.add<flyball::Workload>("package_delivery",
                                  [] { return std::make_unique<PackageDelivery>(); });
}
