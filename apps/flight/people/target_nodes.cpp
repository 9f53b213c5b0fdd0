// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/people/target_nodes.h"

#include "flyball/flight/people/person_range.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

namespace flyball {
namespace {

using namespace std::chrono_literals;

// Chosen: a box that jumps by more than this share of the image's width shows somebody else.
constexpr double reach_share = 0.3;
constexpr int give_up_after = 20;  // Chosen: a second of frames without the person.
// Chosen: a detector that finds nine of ten people in view misses one so often in a row by chance
// once in a million.
constexpr int unconfirmed_most = 6;

double between_px(const ImageBox& a, const ImageBox& b) {
  const double x = a.centre_x_px() - b.centre_x_px();
  const double y = a.centre_y_px() - b.centre_y_px();
  return std::sqrt(x * x + y * y);
}

/// Shows the tracker only the part of the frame that it reads, so that the rest need not be
/// rendered.
Status begin_tracking(Tracker& tracker, const ColourFrame& frame, const ImageBox& box, Work& work) {
  return tracker.begin(frame.image.part(tracker.learns_from(box, frame.camera)), box, work);
}

Result<std::optional<ImageBox>> track(Tracker& tracker, const ColourFrame& frame, Work& work) {
  return tracker.update(frame.image.part(tracker.looks_at(frame.camera)), work);
}

void add_detect(Graph& graph, const FlightParts& parts, const TargetTopics& topics) {
  NodeSpec spec;
  spec.name = "detect";
  spec.cost = detector_cost(parts.brief->settings);
  spec.trigger = OnMessage{parts.vehicle.colour.index};
  spec.priority = 10;
  spec.reads = {parts.mission.knobs.index, parts.mission.state.index};
  spec.writes = {topics.detections.index};
  declare_log(spec, parts.mission);
  graph.node(std::move(spec), [topics, colour = parts.vehicle.colour, mission = parts.mission,
                               detector = parts.kernels.detector](JobContext& job) {
    Work work;
    const auto frame = job.latest(colour);
    const auto knobs = job.latest(mission.knobs);
    if (!frame || !knobs || !is_in(job, mission, MissionPhase::cruise)) {
      return work;
    }
    detector->apply(knobs->knobs);
    auto people = detector->detect(frame->image.value(), knobs->value("detector.scale"), work);
    if (!people) {
      log_event(job, mission, "not looked at: " + people.error().message);
      return work;
    }
    job.publish(topics.detections, Detections{*frame, std::move(*people)});
    return work;
  });
}

/// Takes a detection through the frames that arrived while the detector ran, to the newest of them.
class BufferedTracking {
 public:
  BufferedTracking(const FlightParts& parts, const TargetTopics& topics)
      : parts_{parts}, topics_{topics} {}

  Work operator()(JobContext& job) {
    Work work;
    const auto seen = job.latest(topics_.detections);
    if (!seen) {
      return work;
    }
    turn_knobs(job, parts_.mission, *parts_.kernels.buffered_tracker);
    CaughtUp caught_up{seen->frame, chosen(job, *seen), 0, {}};
    if (caught_up.box) {
      job.publish(topics_.sighting, Target{seen->frame, caught_up.box});
      begin(job, caught_up, work);
    }
    // The buffer is emptied in any case, because the next detection begins with a later frame.
    while (const auto frame = job.take(parts_.vehicle.colour_buffer)) {
      if (frame->sequence > seen->frame.sequence) {
        catch_up(job, *frame, caught_up, work);
      }
    }
    log_.buffered_frames += caught_up.frames_between;
    caught_up.log = log_;
    job.publish(topics_.caught_up, std::move(caught_up));
    return work;
  }

 private:
  std::optional<ImageBox> chosen(JobContext& job, const Detections& seen) {
    const auto target = job.latest(topics_.target);
    const auto last = target ? target->box : std::nullopt;
    const auto person = pick(plausible(seen, job.latest(topics_.pose).get(), *parts_.brief), last,
                             reach_share * seen.frame.camera.width_px);
    ++log_.looks;
    log_.detections += person ? 1 : 0;
    log_.missed_in_row = person ? 0 : log_.missed_in_row + 1;
    log(job, parts_.mission, "detection",
        {{"frame", static_cast<std::int64_t>(seen.frame.sequence)},
         {"people", static_cast<std::int64_t>(seen.people.size())},
         {"score", person ? person->score : 0.0},
         {"chosen", static_cast<std::int64_t>(person.has_value())}});
    return person ? std::optional{person->box} : std::nullopt;
  }

  void begin(JobContext& job, CaughtUp& caught_up, Work& work) {
    const Status begun =
        begin_tracking(*parts_.kernels.buffered_tracker, caught_up.frame, *caught_up.box, work);
    if (!begun) {
      log_event(job, parts_.mission, "not tracked: " + begun.error().message);
      caught_up.box = std::nullopt;
    }
  }

  void catch_up(JobContext& job, const ColourFrame& frame, CaughtUp& caught_up, Work& work) {
    ++caught_up.frames_between;
    if (!caught_up.box) {
      return;
    }
    auto box = track(*parts_.kernels.buffered_tracker, frame, work);
    if (!box) {
      log_event(job, parts_.mission, "not tracked: " + box.error().message);
    }
    caught_up.box = box ? *box : std::nullopt;
    caught_up.frame = frame;
  }

  FlightParts parts_;
  TargetTopics topics_;
  TargetLog log_{};
};

void add_buffered(Graph& graph, const FlightParts& parts, const TargetTopics& topics) {
  NodeSpec spec;
  spec.name = "track_buffered";
  spec.cost = parts.brief->settings.kernels.tracker + "_buffered";
  spec.trigger = OnMessage{topics.detections.index};
  spec.priority = 20;
  spec.reads = {parts.vehicle.colour_buffer.index, topics.target.index, topics.pose.index,
                parts.mission.knobs.index};
  spec.writes = {topics.sighting.index, topics.caught_up.index};
  declare_log(spec, parts.mission);
  auto tracking = std::make_shared<BufferedTracking>(parts, topics);  // Owner: this node alone.
  graph.node(std::move(spec), [tracking](JobContext& job) { return (*tracking)(job); });
}

/// Follows the person from frame to frame. A newer detection, once the buffered tracker has caught
/// up with it, replaces the person that is followed. A person who was not seen for a while is given
/// up, because the camera looks elsewhere by then. So is one whom the detector no longer confirms,
/// because a tracker holds on to the tree behind which somebody went.
class RealTimeTracking {
 public:
  RealTimeTracking(const FlightParts& parts, const TargetTopics& topics)
      : parts_{parts}, topics_{topics} {}

  Work operator()(JobContext& job) {
    Work work;
    const auto frame = job.latest(parts_.vehicle.colour);
    if (!frame) {
      return work;
    }
    Target target{*frame, std::nullopt};
    turn_knobs(job, parts_.mission, tracker());
    const auto caught_up = job.take(topics_.caught_up);
    missed_in_row_ = caught_up ? caught_up->log.missed_in_row : missed_in_row_;
    if (caught_up && caught_up->box) {
      is_following_ = begin_tracking(tracker(), caught_up->frame, *caught_up->box, work).ok();
      unseen_in_row_ = 0;
      target.box = is_following_ ? caught_up->box : std::nullopt;
    }
    is_following_ = is_following_ && missed_in_row_ < unconfirmed_most;
    const bool is_newer = !caught_up || frame->sequence != caught_up->frame.sequence;
    if (is_following_ && is_newer) {
      const auto box = track(tracker(), *frame, work);
      target.box = box ? *box : std::nullopt;
      unseen_in_row_ = target.box ? 0 : unseen_in_row_ + 1;
      is_following_ = unseen_in_row_ < give_up_after;
    }
    job.publish(topics_.target, target);
    return work;
  }

 private:
  [[nodiscard]] Tracker& tracker() const { return *parts_.kernels.real_time_tracker; }

  FlightParts parts_;
  TargetTopics topics_;
  bool is_following_{};
  int missed_in_row_{};  ///< As the newest detection says.
  int unseen_in_row_{};
};

void add_real_time(Graph& graph, const FlightParts& parts, const TargetTopics& topics) {
  NodeSpec spec;
  spec.name = "track_real_time";
  spec.cost = parts.brief->settings.kernels.tracker + "_real_time";
  spec.trigger = OnMessage{parts.vehicle.colour.index};
  spec.priority = 30;
  spec.reads = {topics.caught_up.index, parts.mission.knobs.index};
  spec.writes = {topics.target.index};
  auto tracking = std::make_shared<RealTimeTracking>(parts, topics);  // Owner: this node alone.
  graph.node(std::move(spec), [tracking](JobContext& job) { return (*tracking)(job); });
}

}  // namespace

std::optional<Detection> pick(const std::vector<Detection>& people,
                              const std::optional<ImageBox>& last,
                              double reach_px) {
  std::optional<Detection> best;
  for (const Detection& person : people) {  // The highest score comes first.
    if (!last) {
      return person;
    }
    const double away_px = between_px(person.box, *last);
    if (away_px <= reach_px && (!best || away_px < between_px(best->box, *last))) {
      best = person;
    }
  }
  return best;
}

std::vector<Detection> plausible(const Detections& seen,
                                 const PoseEstimate* pose,
                                 const Brief& brief) {
  if (pose == nullptr) {
    return seen.people;
  }
  const PersonGeometry geometry{brief.settings.photography.person_height_m,
                                pose->X_WB.translation().z() - brief.site.ground_z_m};
  std::vector<Detection> people;
  std::copy_if(seen.people.begin(), seen.people.end(), std::back_inserter(people),
               [&](const Detection& person) {
                 return is_plausible(person_range(person.box, seen.frame, geometry));
               });
  return people;
}

TargetTopics add_target(Graph& graph,
                        const FlightParts& parts,
                        const LocalizationTopics& localization) {
  TargetTopics topics;
  topics.pose = localization.pose;
  topics.detections = graph.topic<Detections>("detections");
  topics.sighting = graph.topic<Target>("sighting");
  topics.caught_up = graph.topic<CaughtUp>("caught_up");
  topics.target = graph.topic<Target>("target");
  add_detect(graph, parts, topics);
  add_buffered(graph, parts, topics);
  add_real_time(graph, parts, topics);
  return topics;
}

}  // namespace flyball
