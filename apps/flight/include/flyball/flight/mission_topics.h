// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The topics that nodes of every mission share: knobs, phase, end, and the log.

#include "flyball/flight/brief.h"
#include "flyball/flight/mission_end.h"
#include "flyball/runtime/graph.h"
#include "flyball/runtime/kernel.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/observation.h"
#include "flyball/runtime/platform.h"
#include "flyball/runtime/recorder.h"

#include <string>
#include <string_view>
#include <vector>

namespace flyball {

/// What the governor's fallback demands of the path follower.
struct FlightRestraint {
  double bound_factor{1.0};  ///< Of the bound on latency.
  bool must_hover{};
  friend bool operator!=(const FlightRestraint& a, const FlightRestraint& b) {
    return a.bound_factor != b.bound_factor || a.must_hover != b.must_hover;
  }
};

/// All knobs as they are in force. The governor publishes a new snapshot whenever one of them, or
/// the clock that the computer grants, has changed.
struct KnobsInForce {
  std::uint64_t version{};
  KnobSettings knobs{};
  OperatingPoint computer{};  ///< Clock and cores, of which a hot board grants less than was asked.
  FlightRestraint restraint{};

  [[nodiscard]] double value(std::string_view knob) const { return knobs.value(knob); }
  /// At a place: that of the slowest zone that is no farther from `p_W` than `within_m`, at most
  /// the knob's limit.
  [[nodiscard]] double speed_limit_m_s(const Site& site,
                                       const Vec3& p_W,
                                       double within_m = 0.0) const;
};

/// The knobs' defaults, at the clock and with the cores that the defaults say.
[[nodiscard]] KnobsInForce knobs_at_start(const KnobSettings& defaults);

/// Which part of the mission is flown; the mission's node says so.
struct MissionState {
  MissionPhase phase{MissionPhase::wait};
};

/// What the mission has achieved since take-off, as far as the vehicle itself can tell: metres
/// nearer to its goals, ground photographed or searched, volume known, time that somebody was
/// tracked. It never falls by turning back. A policy may ask what a unit of it costs.
struct MissionProgress {
  ProgressUnit unit{};
  double value{};
  Duration map_within{};  ///< As in `Observation`.
};

/// A node, or the referee, says that the mission is over. The first message counts.
struct MissionEnd {
  MissionTime at{};
  MissionStatus status{MissionStatus::interrupted};
  MissionFailure failure{MissionFailure::none};
};

/// One row of the record.
struct LogRow {
  MissionTime at{};
  std::string_view channel{};  ///< A literal.
  std::vector<Field> fields{};
};

struct MissionTopics {
  Topic<KnobsInForce> knobs;
  Topic<MissionState> state;
  Topic<MissionProgress> progress;
  Topic<MissionEnd> end;      ///< A queue: several nodes may say so.
  Topic<MissionEnd> outcome;  ///< The end that counts.
  Topic<LogRow> log;          ///< A queue that the node `record` reads.
};

[[nodiscard]] MissionTopics add_mission_topics(Graph& graph);

/// Adds the node `finish`, from `end` to `outcome`.
void add_finish(Graph& graph, const MissionTopics& topics);
/// Adds the node `record`, from `log` to `recorder`, which outlives the graph's jobs. Returns its
/// number: see `Executor::run_last`.
int add_record(Graph& graph, const MissionTopics& topics, Recorder& recorder);

/// Declares that a node writes rows of the log.
void declare_log(NodeSpec& spec, const MissionTopics& topics);
void log(JobContext& job,
         const MissionTopics& topics,
         std::string_view channel,
         std::vector<Field> fields);
/// A row of channel `event`.
void log_event(JobContext& job, const MissionTopics& topics, const std::string& what);
/// @pre The node declares that it writes `progress`.
void tell_progress(JobContext& job,
                   const MissionTopics& topics,
                   ProgressUnit unit,
                   double value,
                   Duration map_within = {});
/// @pre The node declares that it writes `end`.
void end_mission(JobContext& job,
                 const MissionTopics& topics,
                 MissionStatus status,
                 MissionFailure failure);
/// Tells a kernel the knobs in force, before its job.
/// @pre The node declares that it reads `knobs`.
void turn_knobs(JobContext& job, const MissionTopics& topics, Kernel& kernel);
/// Whether the mission is in this phase; `wait` until its node says otherwise.
[[nodiscard]] bool is_in(JobContext& job, const MissionTopics& topics, MissionPhase phase);

}  // namespace flyball
