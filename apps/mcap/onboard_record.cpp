// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/mcap/onboard_record.h"

#include "flyball/flight/navigation/guidance.h"
#include "flyball/flight/perception/perception_nodes.h"
#include "flyball/flight/perception/pose_history.h"
#include "flyball/mcap/flight_messages.h"

#include "mcap/map_changes.h"
#include <array>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace flyball {
namespace {

/// In the order of `channels`.
enum class Channel : std::uint8_t { pose, tf, path, map, knobs, decisions, jobs, power, log, rows };

std::vector<McapChannel> channels() {
  return {{"/pose", "foxglove.PoseInFrame"},  {"/tf", "foxglove.FrameTransform"},
          {"/path", "foxglove.PosesInFrame"}, {"/map", "foxglove.PointCloud"},
          {"/knobs", "flyball.Knobs"},        {"/decisions", "flyball.Decision"},
          {"/jobs", "flyball.Job"},           {"/power", "flyball.Power"},
          {"/log", "foxglove.Log"},           {"/rows", "flyball.Row"}};
}

// Frames whose map is not published yet. Chosen: a map that takes a second, at 30 Hz. Images of
// frames that nobody reads are not rendered for it.
constexpr std::size_t most_frames = 32;

/// Places on the path, at least so far apart; chosen: what a picture of it needs.
constexpr double path_step_m = 0.5;

std::vector<Vec3> places_on(const Path& path) {
  std::vector<Vec3> places_W;
  double next_m = 0.0;
  for (const Path::Sample& sample : path.samples()) {
    if (sample.s_m >= next_m || &sample == &path.samples().back()) {
      places_W.push_back(sample.p_W);
      next_m = sample.s_m + path_step_m;
    }
  }
  return places_W;
}

}  // namespace

struct OnboardRecord::Parts {
  std::shared_ptr<MapChanges> changes{std::make_shared<MapChanges>()};  // Owners: this and rows.
  std::unique_ptr<RecordThread> thread;
  std::optional<RecordedGraph> flight{};
  PoseHistory poses{};
  std::deque<PointCloudFrame> frames{};
  std::uint64_t path_number{};

  void add(Channel channel, const std::string& message) {
    thread->add(static_cast<std::size_t>(channel), flight->now(), message);
  }
  /// Calls the listener with what is published on the topic, if there is one.
  template <class T, class Listener>
  void listen(const char* topic, Listener listener) {
    if (const auto found = flight->graph.find<T>(topic)) {
      flight->executor.subscribe<T>(*found, listener);
    }
  }
  void listen_to_vehicle();
  void listen_to_map();
  void take_path(const NavigatorState& state);
  void take_row(const LogRow& row);
  void take_map(const MapRevision& revision);
};

void OnboardRecord::Parts::listen_to_vehicle() {
  listen<PoseEstimate>("pose", [this](const PoseEstimate& pose) {
    poses.add(pose);
    add(Channel::pose, pose_message(pose.stamp, pose.X_WB));
    add(Channel::tf, transform_message(pose.stamp, pose.X_WB));
  });
  listen<NavigatorState>("navigator", [this](const NavigatorState& state) { take_path(state); });
  listen<KnobsInForce>("knobs", [this](const KnobsInForce& knobs) {
    add(Channel::knobs, knobs_message(flight->now(), knobs));
  });
  listen<LogRow>("log", [this](const LogRow& row) { take_row(row); });
}

void OnboardRecord::Parts::listen_to_map() {
  listen<PointCloudFrame>("cloud", [this](const PointCloudFrame& frame) {
    frames.push_back(frame);
    if (frames.size() > most_frames) {
      frames.pop_front();
    }
  });
  listen<MapRevision>("map_revision", [this](const MapRevision& map) { take_map(map); });
}

void OnboardRecord::Parts::take_path(const NavigatorState& state) {
  if (state.path_number != path_number) {
    path_number = state.path_number;
    add(Channel::path, path_message(flight->now(), state.has_path() ? places_on(*state.path)
                                                                    : std::vector<Vec3>{}));
  }
}

void OnboardRecord::Parts::take_row(const LogRow& row) {
  if (row.channel == "event" && row.fields.size() == 1) {
    const auto* what = std::get_if<std::string>(&row.fields.front().value);
    add(Channel::log, log_message(row.at, what != nullptr ? *what : ""));
    return;
  }
  if (row.channel == "decision") {
    add(Channel::decisions, decision_message(row));
    return;
  }
  if (row.channel == "job") {
    return;  // Channel `jobs` has it already, and more of it.
  }
  if (row.channel == "state") {
    add(Channel::power, power_message(row));
  }
  add(Channel::rows, row_message(row));
}

/// What has changed is found out by the writing thread: it takes milliseconds.
void OnboardRecord::Parts::take_map(const MapRevision& revision) {
  while (!frames.empty() && frames.front().captured < revision.captured) {
    frames.pop_front();
  }
  const auto pose = poses.at(revision.captured);
  if (frames.empty() || frames.front().captured != revision.captured || !pose) {
    return;
  }
  const Pose X_WC = camera_pose(pose->X_WB, flight->camera);
  thread->add_later(static_cast<std::size_t>(Channel::map), flight->now(),
                    [all = changes, revision, frame = frames.front(), X_WC] {
                      const auto cells = all->since_last(revision, hits_of(frame, X_WC));
                      return cells_message(revision.captured, revision.resolution_m, cells);
                    });
  frames.pop_front();
}

Result<std::unique_ptr<OnboardRecord>> OnboardRecord::open(
    const std::string& path,
    WhenFull when_full,
    const std::map<std::string, std::map<std::string, std::string>>& metadata) {
  RecordThreadSettings settings;
  settings.file.schemas = flight_schemas();
  settings.file.channels = channels();
  settings.file.survives_power_loss = when_full == WhenFull::drop;
  settings.when_full = when_full;
  auto thread = RecordThread::open(path, settings, metadata);
  if (!thread) {
    return thread.error();
  }
  auto parts = std::make_unique<Parts>();
  parts->thread = std::move(*thread);
  return std::unique_ptr<OnboardRecord>{new OnboardRecord{std::move(parts)}};
}

OnboardRecord::OnboardRecord(std::unique_ptr<Parts> parts) : parts_{std::move(parts)} {}
OnboardRecord::~OnboardRecord() = default;

void OnboardRecord::connect(const RecordedGraph& flight) {
  parts_->flight.emplace(flight);
  parts_->listen_to_vehicle();
  parts_->listen_to_map();
  flight.executor.on_job([parts = parts_.get()](const JobRecord& job) {
    parts->add(Channel::jobs, job_message(job, parts->flight->graph));
  });
}

Status OnboardRecord::close() {
  return parts_->thread->close();
}

RecordCounts OnboardRecord::counts() const {
  return parts_->thread->counts();
}

}  // namespace flyball
