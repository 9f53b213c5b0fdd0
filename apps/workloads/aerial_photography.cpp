// SPDX-License-Identifier: BSD-3-Clause
//
// Aerial photography: take off, find a person, follow until the person is lost. Dataflow as in
// MAVBench (MICRO 2018), figure of aerial photography: detector, buffered and real-time tracker,
// PID. It flies without a map: the scenario declares the space above the park clear.

#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include "flight/people/target_follower.h"
#include "flight/people/target_nodes.h"
#include "flight/perception/perception_nodes.h"
#include "simulation/tracking_score.h"
#include <memory>

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
    score_ = std::make_unique<TrackingScore>(context);
    pose_ = add_localization(graph, vehicle, context);
    target_ = add_target(graph, vehicle, pose_, context, log_);
    add_history(graph);
    add_control(graph);
    add_score(graph);
    add_mission(graph);
  }

  [[nodiscard]] const Navigator* navigator() const override { return nullptr; }

  [[nodiscard]] std::map<std::string, double> quality() const override {
    auto figures = score_->figures();
    figures["detections"] = log_.detections;
    figures["looks"] = static_cast<double>(log_.looks);
    figures["buffered_frames"] = static_cast<double>(log_.buffered_frames);
    figures["is_censored"] = is_censored_ ? 1.0 : 0.0;
    return figures;
  }

  [[nodiscard]] std::vector<MissionFrame> frames() const override { return score_->frames(); }

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
    }
    if (stage_ == Stage::following) {
      job.publish(vehicle_.setpoint, follower_->tick(job.now(), control_period));
    }
    job.publish(vehicle_.gimbal, follower_->gimbal());
    return work;
  }

  /// Free of charge: it is the referee's, not the vehicle's.
  void add_score(Graph& graph) {
    NodeSpec spec;
    spec.name = "referee";
    spec.trigger = OnMessage{target_.target.index};
    spec.priority = 45;
    graph.node(std::move(spec), [this](JobContext& job) {
      const auto target = job.latest(target_.target);
      if (target && stage_ == Stage::following) {
        score_->count(job.now(), *target);
      }
      return Work{};
    });
  }

  void add_mission(Graph& graph) {
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    spec.reads = {pose_.index, vehicle_.status.index};
    spec.writes = {vehicle_.command.index};
    graph.node(std::move(spec), [this](JobContext& job) {
      const auto pose = job.latest(pose_);
      const auto status = job.latest(vehicle_.status);
      if (pose && status && !context_->is_over()) {
        advance(job, *pose, *status);
      }
      return Work{};
    });
  }

  void advance(JobContext& job, const PoseEstimate& pose, const FlightStatus& status) {
    switch (stage_) {
      case Stage::ready:
        context_->phase = MissionPhase::take_off;
        job.publish(vehicle_.command,
                    FlightCommand{FlightCommand::Kind::take_off, context_->brief.cruise_height_m});
        settle_ = job.now() + 500ms;  // The status on its way now is from before the command.
        stage_ = Stage::climbing;
        break;
      case Stage::climbing:
        if (status.manoeuvre_done && job.now() >= settle_) {
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
    is_censored_ = score_->tracked_s() >= wanted.limit_s;
    if (!is_censored_ && log_.missed_in_row < wanted.lost_after_detections) {
      return;
    }
    const bool enough = score_->tracked_s() >= wanted.success_s;
    context_->finish(now, enough ? MissionStatus::succeeded : MissionStatus::failed,
                     enough ? MissionFailure::none : MissionFailure::target_lost);
  }

  MissionContext* context_{};
  VehicleTopics vehicle_{};
  Topic<PoseEstimate> pose_{};
  TargetTopics target_{};
  TargetLog log_{};
  PoseHistory history_{};
  std::unique_ptr<TargetFollower> follower_;
  std::unique_ptr<TrackingScore> score_;
  Stage stage_{Stage::ready};
  MissionTime settle_{};
  bool is_censored_{};
};

}  // namespace

FLYBALL_PLUGIN(aerial_photography) {
  registry.add<flyball::Workload>("aerial_photography",
                                  [] { return std::make_unique<AerialPhotography>(); });
}
