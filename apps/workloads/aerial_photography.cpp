// SPDX-License-Identifier: BSD-3-Clause
//
// Aerial photography: take off, find a person, follow until the person is lost. Dataflow as in
// MAVBench (MICRO 2018), figure of aerial photography: detector, buffered and real-time tracker,
// PID. It flies without a map: the scenario declares the space above the park clear.

#include "flyball/flight/legs.h"
#include "flyball/flight/people/target_follower.h"
#include "flyball/flight/people/target_nodes.h"
#include "flyball/flight/people/tracked_time.h"
#include "flyball/flight/perception/perception_nodes.h"
#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include <memory>
#include <optional>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

constexpr auto control_period = 20ms;  // 50 Hz: the most that PX4 wants of off-board set-points.

class AerialPhotography final : public Workload {
 public:
  [[nodiscard]] bool looks_for_people() const override { return true; }

  void build(Graph& graph, const VehicleTopics& vehicle, MissionContext& context) override {
    context_ = &context;
    context.maps_obstacles = false;
    vehicle_ = vehicle;
    legs_.emplace(context, vehicle);
    const PhotographySettings& wanted = context.settings.photography;
    FollowSettings follow;
    follow.distance_m = wanted.distance_m;
    follow.person_height_m = wanted.person_height_m;
    follow.height_m = context.brief.cruise_height_m;
    follow.ground_z_m = context.brief.ground_z_m;
    follow.coast_s = wanted.coast_s;
    follow.search_rate_rad_s = wanted.search_rate_rad_s;
    follow.max_speed_m_s = context.knobs.value("mission.max_speed_m_s");
    follow.max_acceleration_m_s2 = 0.5 * context.settings.mission.max_acceleration_m_s2;
    follower_ = std::make_unique<TargetFollower>(follow);
    pose_ = add_localization(graph, vehicle, context);
    target_ = add_target(graph, vehicle, pose_, context, log_);
    add_history(graph);
    add_control(graph);
    add_mission(graph);
  }

  [[nodiscard]] const Navigator* navigator() const override { return nullptr; }

  [[nodiscard]] std::map<std::string, double> quality() const override {
    return {{"detections", log_.detections},
            {"looks", static_cast<double>(log_.looks)},
            {"buffered_frames", static_cast<double>(log_.buffered_frames)},
            {"tracked_believed_s", tracked_.seconds()},
            {"is_censored", is_censored_ ? 1.0 : 0.0}};
  }

 private:
  enum class Stage : std::uint8_t { ready, climbing, following };

  void add_history(Graph& graph) {
    NodeSpec spec;
    spec.name = "pose_history";
    spec.trigger = OnMessage{pose_.index};
    spec.priority = 30;
    graph.node(std::move(spec), [this](JobContext& job) {
      if (const auto pose = job.latest(pose_)) {
        history_.add(*pose);
      }
      return Work{};
    });
  }

  void add_control(Graph& graph) {
    NodeSpec spec;
    spec.name = "control";
    spec.cost = "track";
    spec.trigger = OnPeriod{control_period, control_period};
    spec.priority = 40;
    spec.deadline = control_period;
    spec.on_miss = OnMiss::brake;
    spec.reads = {target_.target.index, target_.sighting.index};
    spec.writes = {vehicle_.setpoint.index, vehicle_.gimbal.index};
    graph.node(std::move(spec), [this](JobContext& job) { return control(job); });
  }

  Work control(JobContext& job) {
    Work work;
    work.add("ticks", 1.0);
    // Older than what a tracker says, but all there is when none could hold whom the detector saw:
    // somebody who turns round, or a view that swings.
    if (const auto sighting = job.take(target_.sighting)) {
      if (const auto pose = history_.at(sighting->frame.captured)) {
        follower_->sight(*sighting, *pose);
      }
    }
    if (const auto target = job.take(target_.target)) {
      if (const auto pose = history_.at(target->frame.captured)) {
        follower_->see(*target, *pose);
      }
      if (target->box && stage_ == Stage::following) {
        tracked_.on_target(target->frame.captured);
      }
    }
    if (stage_ == Stage::following) {
      job.publish(vehicle_.setpoint, follower_->tick(job.now(), control_period));
    }
    job.publish(vehicle_.gimbal, follower_->gimbal());
    return work;
  }

  void add_mission(Graph& graph) {
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    spec.reads = {pose_.index};
    legs_->declare(spec);
    graph.node(std::move(spec), [this](JobContext& job) {
      const auto pose = job.latest(pose_);
      if (pose && !context_->is_over()) {
        advance(job, *pose);
      }
      return Work{};
    });
  }

  void advance(JobContext& job, const PoseEstimate& pose) {
    switch (stage_) {
      case Stage::ready:
        legs_->take_off(job, context_->brief.cruise_height_m);
        stage_ = Stage::climbing;
        break;
      case Stage::climbing:
        if (legs_->are_done(job)) {
          follower_->start(pose);
          context_->phase = MissionPhase::cruise;
          stage_ = Stage::following;
          context_->event(job.now(), "looks for a person");
        }
        break;
      case Stage::following:
        end_if_due(job.now());
        break;
    }
  }

  void end_if_due(MissionTime now) {
    const PhotographySettings& wanted = context_->settings.photography;
    is_censored_ = tracked_.seconds() >= wanted.limit_s;
    if (!is_censored_ && log_.missed_in_row < wanted.lost_after_detections) {
      return;
    }
    const bool enough = tracked_.seconds() >= wanted.success_s;
    context_->finish(now, enough ? MissionStatus::succeeded : MissionStatus::failed,
                     enough ? MissionFailure::none : MissionFailure::target_lost);
  }

  MissionContext* context_{};
  VehicleTopics vehicle_{};
  std::optional<Legs> legs_{};
  Topic<PoseEstimate> pose_{};
  TargetTopics target_{};
  TargetLog log_{};
  PoseHistory history_{};
  std::unique_ptr<TargetFollower> follower_;
  TrackedTime tracked_{};
  Stage stage_{Stage::ready};
  bool is_censored_{};
};

}  // namespace

FLYBALL_PLUGIN(aerial_photography) {
  registry.add<flyball::Workload>("aerial_photography",
                                  [] { return std::make_unique<AerialPhotography>(); });
}
