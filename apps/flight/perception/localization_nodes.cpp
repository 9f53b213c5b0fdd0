// SPDX-License-Identifier: BSD-3-Clause
// tested-in: perception_nodes
#include "flyball/flight/perception/localization_nodes.h"

#include "flyball/flight/perception/localization_watch.h"
#include "flyball/flight/perception/pose_history.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace flyball {
namespace {

using namespace std::chrono_literals;

// Poses, for ten seconds: no frame takes longer to map.
constexpr std::size_t pose_queue_length = 1000;

using Fixes = std::optional<Topic<VisualFix>>;

/// Fixes of the camera, if there are any, correct what the navigation samples say.
class Localize {
 public:
  Localize(const FlightParts& parts, const LocalizationTopics& topics, Fixes fixes)
      : vehicle_{parts.vehicle},
        mission_{parts.mission},
        topics_{topics},
        fixes_{fixes},
        localizer_{parts.kernels.localizer} {}

  Work operator()(JobContext& job) {
    Work work;
    if (fixes_) {
      correct(job, *fixes_);
    }
    if (const auto sample = job.latest(vehicle_.navigation)) {
      estimate(job, *sample, work);
    }
    return work;
  }

 private:
  void correct(JobContext& job, Topic<VisualFix> fixes) {
    const bool was_lost = watch_.is_lost();
    while (const auto fix = job.take(fixes)) {
      watch_.fixed(job.now(), *fix);
      localizer_->correct(*fix);
    }
    watch_.waited(job.now());
    if (was_lost != watch_.is_lost()) {
      log_event(job, mission_, was_lost ? "localized again" : "localization lost");
    }
    if (watch_.has_given_up(job.now())) {
      end_mission(job, mission_, MissionStatus::failed, MissionFailure::localization_lost);
    }
  }

  void estimate(JobContext& job, const NavigationSample& sample, Work& work) {
    if (!fixes_) {  // Else the node `see` does, whose jobs are the long ones.
      turn_knobs(job, mission_, *localizer_);
    }
    if (const auto truth = vehicle_.true_pose ? job.latest(*vehicle_.true_pose) : nullptr) {
      localizer_->set_true_pose(*truth);
    }
    const auto pose = localizer_->estimate(sample, work);
    const bool is_known = pose && !is_lost_on_ground(job);
    tell_of_first(job, is_known);
    if (!is_known) {
      return;  // Without a pose no mission takes off, and nothing is mapped.
    }
    if (!watch_.is_lost()) {
      watch_.passed(*pose);
    }
    if (fixes_) {
      job.publish(topics_.status, watch_.status(job.now(), pose->X_WB.translation().z(),
                                                is_in(job, mission_, MissionPhase::cruise)));
    }
    job.publish(topics_.pose, *pose);
    job.publish(topics_.poses, *pose);
  }

  /// Before the first take-off. In flight the mission goes on by what dead reckoning says.
  bool is_lost_on_ground(JobContext& job) {
    has_flown_ = has_flown_ || (fixes_ && !is_in(job, mission_, MissionPhase::wait));
    return watch_.is_lost() && !has_flown_;
  }

  /// Who waits for a vehicle that does not take off wants to know what it waits for.
  void tell_of_first(JobContext& job, bool is_known) {
    if (is_known_ != is_known) {
      if (!is_known) {
        log_event(job, mission_, "waiting for a first position");
      } else if (is_known_) {
        log_event(job, mission_, "position known");
      }
      is_known_ = is_known;
    }
  }

  VehicleTopics vehicle_;
  MissionTopics mission_;
  LocalizationTopics topics_;
  Fixes fixes_;
  std::shared_ptr<Localizer> localizer_;  ///< See MissionKernels.
  LocalizationWatch watch_{};
  bool has_flown_{};
  std::optional<bool> is_known_{};  ///< Whether the newest estimate was a pose to take off with.
};

void add_localize(Graph& graph,
                  const FlightParts& parts,
                  const LocalizationTopics& topics,
                  Fixes fixes) {
  NodeSpec spec;
  spec.name = "localize";
  spec.cost = "localizer";
  spec.trigger = OnMessage{parts.vehicle.navigation.index};
  spec.priority = 30;
  spec.deadline = 10ms;
  spec.writes = {topics.pose.index, topics.poses.index};
  if (parts.vehicle.true_pose) {
    spec.reads.push_back(parts.vehicle.true_pose->index);
  }
  if (!fixes) {
    spec.reads.push_back(parts.mission.knobs.index);
  } else {
    spec.reads.insert(spec.reads.end(), {fixes->index, parts.mission.state.index});
    spec.writes.insert(spec.writes.end(), {topics.status.index, parts.mission.end.index});
  }
  declare_log(spec, parts.mission);
  auto localize = std::make_shared<Localize>(parts, topics, fixes);  // Owner: this node alone.
  graph.node(std::move(spec), [localize](JobContext& job) { return (*localize)(job); });
}

/// Hands frames to the localizer, with the samples of the IMU and the pose by dead reckoning.
class See {
 public:
  See(const FlightParts& parts, Topic<PoseEstimate> poses, Topic<VisualFix> fix)
      : vehicle_{parts.vehicle},
        mission_{parts.mission},
        poses_topic_{poses},
        fix_{fix},
        localizer_{parts.kernels.localizer} {}

  Work operator()(JobContext& job) {
    Work work;
    const auto seen = job.latest(*vehicle_.view);
    while (const auto sample = vehicle_.imu ? job.take(*vehicle_.imu) : nullptr) {
      localizer_->add_imu_sample(*sample);
    }
    poses_.take_from(job, poses_topic_);
    if (!seen || !is_localizers_turn(job, mission_, limit_, seen->depth.captured)) {
      return work;
    }
    turn_knobs(job, mission_, *localizer_);
    VisualFrame frame = visual_frame(*seen);
    frame.X_WB_reckoned = reckoned(job, frame.captured);
    const auto found = localizer_->track_frame(frame, work);
    if (found) {
      job.publish(fix_, *found);
    } else {
      log_event(job, mission_, "frame not localized: " + found.error().message);
    }
    return work;
  }

 private:
  /// Only a barometer tells the height of a vehicle whose images do not tell where it is.
  [[nodiscard]] std::optional<Pose> reckoned(JobContext& job, MissionTime captured) const {
    const auto sample = job.latest(vehicle_.navigation);
    const auto pose = poses_.at(captured);
    if (!pose || !sample || sample->pressure_pa <= 0.0) {
      return std::nullopt;
    }
    Pose X_WB = pose->X_WB;  // The newest one is some milliseconds older than the frame.
    X_WB.translation() += std::max(0.0, to_seconds(captured - pose->stamp)) * pose->v_WB;
    return X_WB;
  }

  VehicleTopics vehicle_;
  MissionTopics mission_;
  Topic<PoseEstimate> poses_topic_;
  Topic<VisualFix> fix_;
  std::shared_ptr<Localizer> localizer_;  ///< See MissionKernels.
  PoseHistory poses_{};
  RateLimit limit_{};
};

void add_see(Graph& graph,
             const FlightParts& parts,
             Topic<PoseEstimate> poses,
             Topic<VisualFix> fix) {
  NodeSpec spec;
  spec.name = "see";
  spec.cost = frame_cost(parts.brief->settings.kernels.localizer);
  spec.trigger = OnMessage{parts.vehicle.view->index};
  // It runs before `points` and `map`, because a map is worth nothing without a pose.
  spec.priority = 28;
  spec.reads = {parts.mission.knobs.index, poses.index, parts.vehicle.navigation.index};
  spec.writes = {fix.index};
  if (parts.vehicle.imu) {
    spec.reads.push_back(parts.vehicle.imu->index);
  }
  declare_log(spec, parts.mission);
  auto see = std::make_shared<See>(parts, poses, fix);  // Owner: this node alone.
  graph.node(std::move(spec), [see](JobContext& job) { return (*see)(job); });
}

}  // namespace

bool is_localizers_turn(JobContext& job,
                        const MissionTopics& mission,
                        RateLimit& limit,
                        MissionTime captured) {
  constexpr const char* knob = "localizer.rate_hz";
  const auto knobs = job.latest(mission.knobs);
  // Without such a knob, and before the governor has spoken, every frame is looked at.
  return !knobs || knobs->knobs.spec(knob) == nullptr || limit.passes(captured, knobs->value(knob));
}

LocalizationTopics add_localization(Graph& graph, const FlightParts& parts) {
  LocalizationTopics topics;
  topics.pose = graph.topic<PoseEstimate>("pose");
  topics.poses = graph.topic<PoseEstimate>("poses", pose_queue_length);
  topics.status = graph.topic<LocalizationStatus>("localization");
  Fixes fixes;
  if (parts.vehicle.view) {
    fixes = graph.topic<VisualFix>("fix", 8);
    add_see(graph, parts, topics.poses, *fixes);
  }
  add_localize(graph, parts, topics, fixes);
  return topics;
}

}  // namespace flyball
