// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/mission_topics.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace flyball {
namespace {

// Chosen: many more than one job writes; the node `record` runs before any other.
constexpr std::size_t most_rows = 4096;
constexpr std::size_t most_ends = 8;
// Recording takes no time on the modeled computer, so it runs before all else.
constexpr int record_priority = 100;
constexpr int finish_priority = 99;

std::string text_of(const MissionEnd& end) {
  std::string text = std::string{"end: "} + to_string(end.status);
  if (end.failure != MissionFailure::none) {
    text += std::string{" by "} + to_string(end.failure);
  }
  return text;
}

}  // namespace

double KnobsInForce::speed_limit_m_s(const Site& site, const Vec3& p_W, double within_m) const {
  double limit = value("mission.max_speed_m_s");
  for (const auto& zone : site.zones) {
    if (zone.box_W.distance_m(p_W) <= within_m) {
      limit = std::min(limit, zone.max_speed_m_s);
    }
  }
  return limit;
}

KnobsInForce knobs_at_start(const KnobSettings& defaults) {
  KnobsInForce start;
  start.knobs = defaults;
  start.computer = {static_cast<int>(defaults.value("cpu.cores")),
                    Hertz{defaults.value("cpu.frequency_hz")}};
  return start;
}

MissionTopics add_mission_topics(Graph& graph) {
  MissionTopics topics;
  topics.knobs = graph.topic<KnobsInForce>("knobs");
  topics.state = graph.topic<MissionState>("mission_state");
  topics.progress = graph.topic<MissionProgress>("progress");
  topics.end = graph.topic<MissionEnd>("end", most_ends);
  topics.outcome = graph.topic<MissionEnd>("outcome");
  topics.log = graph.topic<LogRow>("log", most_rows);
  return topics;
}

void add_finish(Graph& graph, const MissionTopics& topics) {
  NodeSpec spec;
  spec.name = "finish";
  spec.trigger = OnMessage{topics.end.index};
  spec.priority = finish_priority;
  spec.writes = {topics.outcome.index};
  declare_log(spec, topics);
  auto is_over = std::make_shared<bool>(false);  // Owner: this node alone.
  graph.node(std::move(spec), [topics, is_over](JobContext& job) {
    const auto end = job.take(topics.end);
    if (end && !*is_over) {
      *is_over = true;
      log_event(job, topics, text_of(*end));
      job.publish(topics.outcome, *end);
    }
    return Work{};
  });
}

int add_record(Graph& graph, const MissionTopics& topics, Recorder& recorder) {
  NodeSpec spec;
  spec.name = "record";
  spec.trigger = OnMessage{topics.log.index};
  spec.priority = record_priority;
  graph.node(std::move(spec), [topics, &recorder](JobContext& job) {
    while (const auto row = job.take(topics.log)) {
      recorder.record(row->at, row->channel, row->fields);
    }
    return Work{};
  });
  return static_cast<int>(graph.nodes().size()) - 1;
}

void declare_log(NodeSpec& spec, const MissionTopics& topics) {
  if (std::find(spec.writes.begin(), spec.writes.end(), topics.log.index) == spec.writes.end()) {
    spec.writes.push_back(topics.log.index);
  }
}

void log(JobContext& job,
         const MissionTopics& topics,
         std::string_view channel,
         std::vector<Field> fields) {
  job.publish(topics.log, LogRow{job.now(), channel, std::move(fields)});
}

void log_event(JobContext& job, const MissionTopics& topics, const std::string& what) {
  log(job, topics, "event", {{"what", what}});
}

void tell_progress(JobContext& job,
                   const MissionTopics& topics,
                   ProgressUnit unit,
                   double value,
                   Duration map_within) {
  job.publish(topics.progress, MissionProgress{unit, value, map_within});
}

void end_mission(JobContext& job,
                 const MissionTopics& topics,
                 MissionStatus status,
                 MissionFailure failure) {
  job.publish(topics.end, MissionEnd{job.now(), status, failure});
}

void turn_knobs(JobContext& job, const MissionTopics& topics, Kernel& kernel) {
  if (const auto knobs = job.latest(topics.knobs)) {
    kernel.apply(knobs->knobs);
  }
}

bool is_in(JobContext& job, const MissionTopics& topics, MissionPhase phase) {
  const auto state = job.latest(topics.state);
  return (state ? state->phase : MissionPhase::wait) == phase;
}

}  // namespace flyball
