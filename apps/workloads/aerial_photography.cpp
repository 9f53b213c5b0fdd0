// SPDX-License-Identifier: BSD-3-Clause
//
// Aerial photography: the vehicle takes off, finds a person, and follows until the person is lost.
// The dataflow is that of MAVBench (MICRO 2018), figure of aerial photography: detector, buffered
// and real-time tracker, PID. It flies without a map, because the scenario declares the space above
// the park clear.

#include "flyball/flight/flight_parts.h"
#include "flyball/flight/legs.h"
#include "flyball/flight/people/target_follower.h"
#include "flyball/flight/people/target_nodes.h"
#include "flyball/flight/people/tracked_time.h"
#include "flyball/flight/perception/camera_rate.h"
#include "flyball/flight/perception/localization_nodes.h"
#include "flyball/flight/perception/pose_history.h"
#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include <cstdio>
#include <limits>
#include <memory>
#include <optional>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

constexpr auto control_period = 20ms;  // 50 Hz: the most that PX4 wants of off-board set-points.

class AerialPhotography final : public Workload {
 public:
  [[nodiscard]] bool looks_for_people() const override { return true; }

  void adapt(Brief& brief) const override { brief.maps_obstacles = false; }

  [[nodiscard]] Status check(const FlightSettings& settings, const Site&) const override {
    const PhotographySettings& wanted = settings.photography;
    if (wanted.limit_s >= wanted.success_s) {
      return Done{};
    }
    char text[160];
    std::snprintf(text, sizeof text,
                  "photography.limit_s = %g s would end the mission before photography.success_s = "
                  "%g s; make it that long at least",
                  wanted.limit_s, wanted.success_s);
    return Error{ErrorCode::invalid_input, text};
  }

  void build(Graph& graph, const FlightParts& parts) override {
    brief_ = parts.brief;
    vehicle_ = parts.vehicle;
    mission_ = parts.mission;
    localization_ = add_localization(graph, with_camera_rate(graph, parts));
    target_ = add_target(graph, parts, localization_);
    tracked_topic_ = graph.topic<TrackedTime>("tracked_time");
    add_control(graph);
    add_mission(graph);
  }

  [[nodiscard]] std::map<std::string, double> quality() const override {
    return {{"detections", log_.detections},
            {"looks", static_cast<double>(log_.looks)},
            {"buffered_frames", static_cast<double>(log_.buffered_frames)},
            {"tracked_believed_s", tracked_s_},
            {"is_censored", is_censored_ ? 1.0 : 0.0}};
  }

 private:
  enum class Stage : std::uint8_t { ready, climbing, following, done };

  /// The node `control`, which shares nothing with others but messages.
  class Control {
   public:
    Control(const AerialPhotography& mission, const FollowSettings& settings)
        : vehicle_{mission.vehicle_},
          mission_{mission.mission_},
          localization_{mission.localization_},
          target_{mission.target_},
          tracked_topic_{mission.tracked_topic_},
          follower_{settings} {}

    Work operator()(JobContext& job) {
      Work work;
      work.add("ticks", 1.0);
      poses_.take_from(job, localization_.poses);
      const bool follows = is_in(job, mission_, MissionPhase::cruise);
      const auto pose = job.latest(localization_.pose);
      if (follows && !has_started_ && pose) {
        follower_.start(*pose);
        has_started_ = true;
      }
      look(job);
      if (has_started_ && pose) {
        job.publish(vehicle_.setpoint,
                    follower_.tick(job.now(), control_period, limit_m_s(job, *pose)));
      }
      job.publish(vehicle_.gimbal, follower_.gimbal());
      return work;
    }

   private:
    /// A vehicle whose governor wants it to stand, or that does not know where it is, brakes.
    [[nodiscard]] double limit_m_s(JobContext& job, const PoseEstimate& pose) const {
      const auto knobs = job.latest(mission_.knobs);
      const auto place = job.latest(localization_.status);
      const bool must_stand = (knobs && knobs->restraint.must_hover) || (place && place->is_lost) ||
                              job.now() - pose.stamp > longest_pose_age;
      constexpr double none = std::numeric_limits<double>::max();
      return must_stand ? 0.0 : knobs ? knobs->value("mission.max_speed_m_s") : none;
    }

    void look(JobContext& job) {
      // A detection is older than what a tracker says, but it is all there is when no tracker could
      // hold the person, because they turned round or the view swung.
      if (const auto sighting = job.take(target_.sighting)) {
        if (const auto pose = poses_.at(sighting->frame.captured)) {
          follower_.detected(*sighting, *pose);
        }
      }
      const auto target = job.take(target_.target);
      if (!target) {
        return;
      }
      if (const auto pose = poses_.at(target->frame.captured)) {
        follower_.tracked(*target, *pose);
      }
      if (target->box && has_started_) {
        tracked_.on_target(target->frame.captured);
        job.publish(tracked_topic_, tracked_);
      }
    }

    VehicleTopics vehicle_;
    MissionTopics mission_;
    LocalizationTopics localization_;
    TargetTopics target_;
    Topic<TrackedTime> tracked_topic_;
    TargetFollower follower_;
    PoseHistory poses_{};
    TrackedTime tracked_{};
    bool has_started_{};
  };

  [[nodiscard]] FollowSettings follow_settings() const {
    const PhotographySettings& wanted = brief_->settings.photography;
    FollowSettings follow;
    follow.distance_m = wanted.distance_m;
    follow.person_height_m = wanted.person_height_m;
    follow.height_m = brief_->site.cruise_height_m;
    follow.ground_z_m = brief_->site.ground_z_m;
    follow.coast_s = wanted.coast_s;
    follow.search_rate_rad_s = wanted.search_rate_rad_s;
    follow.max_speed_m_s = brief_->settings.mission.max_speed_m_s;
    follow.max_acceleration_m_s2 = 0.5 * brief_->settings.mission.max_acceleration_m_s2;
    return follow;
  }

  void add_control(Graph& graph) {
    NodeSpec spec;
    spec.name = "control";
    spec.cost = "track";
    spec.trigger = OnPeriod{control_period, control_period};
    spec.priority = 40;
    spec.deadline = control_period;
    spec.on_miss = OnMiss::brake;
    spec.reads = {target_.target.index,      target_.sighting.index,     localization_.pose.index,
                  localization_.poses.index, localization_.status.index, mission_.state.index,
                  mission_.knobs.index};
    spec.writes = {vehicle_.setpoint.index, vehicle_.gimbal.index, tracked_topic_.index};
    auto control = std::make_shared<Control>(*this, follow_settings());  // Owner: this node alone.
    graph.node(std::move(spec), [control](JobContext& job) { return (*control)(job); });
  }

  void add_mission(Graph& graph) {
    legs_.emplace(vehicle_, mission_);
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    spec.reads = {localization_.pose.index, target_.caught_up.index, tracked_topic_.index};
    spec.writes = {mission_.progress.index, mission_.end.index};
    legs_->declare(spec);
    declare_log(spec, mission_);
    graph.node(std::move(spec), [this](JobContext& job) {
      if (job.latest(localization_.pose)) {
        advance(job);
      }
      return Work{};
    });
  }

  void advance(JobContext& job) {
    switch (stage_) {
      case Stage::ready:
        legs_->take_off(job, brief_->site.cruise_height_m);
        stage_ = Stage::climbing;
        break;
      case Stage::climbing:
        if (legs_->are_done(job)) {
          legs_->enter(job, MissionPhase::cruise);
          stage_ = Stage::following;
          log_event(job, mission_, "looks for a person");
        }
        break;
      case Stage::following:
        end_if_due(job);
        break;
      case Stage::done:
        break;
    }
  }

  void end_if_due(JobContext& job) {
    const PhotographySettings& wanted = brief_->settings.photography;
    if (const auto newest = job.latest(target_.caught_up)) {
      log_ = newest->log;
    }
    if (const auto tracked = job.latest(tracked_topic_)) {
      tracked_s_ = tracked->seconds();
      tell_progress(job, mission_, ProgressUnit::second, tracked_s_);
    }
    is_censored_ = tracked_s_ >= wanted.limit_s;
    if (!is_censored_ && log_.missed_in_row < wanted.lost_after_detections) {
      return;
    }
    const bool enough = tracked_s_ >= wanted.success_s;
    end_mission(job, mission_, enough ? MissionStatus::succeeded : MissionStatus::failed,
                enough ? MissionFailure::none : MissionFailure::target_lost);
    stage_ = Stage::done;
  }

  // Constant once the graph is built.
  std::shared_ptr<const Brief> brief_{};  ///< Owners: all nodes.
  VehicleTopics vehicle_{};
  MissionTopics mission_{};
  LocalizationTopics localization_{};
  TargetTopics target_{};
  Topic<TrackedTime> tracked_topic_{};

  // The node `mission` alone uses these.
  std::optional<Legs> legs_{};
  TargetLog log_{};
  double tracked_s_{};
  Stage stage_{Stage::ready};
  bool is_censored_{};
};

}  // namespace

FLYBALL_PLUGIN(aerial_photography) {
  registry.add<flyball::Workload>("aerial_photography",
                                  [] { return std::make_unique<AerialPhotography>(); });
}
