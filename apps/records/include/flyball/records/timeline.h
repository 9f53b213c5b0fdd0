// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// When each job ran, for a person who wants to see it: a trace for Perfetto (ui.perfetto.dev).

#include "flyball/runtime/executor.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace flyball {

/// One track for each node on each core; on a modeled computer, which gives jobs shares of cores,
/// one for each node. A slice `waits` goes from a job's release to its start, and one with the
/// node's name from there to its end; a job that was killed says so. Missed deadlines are instants,
/// and the granted clock is a counter in GHz. Times are mission time.
///
/// The format is Perfetto's: protobuf messages Trace, TracePacket, TrackDescriptor and TrackEvent
/// (protos/perfetto/trace in its repository).
class Timeline {
 public:
  /// Whose jobs come: names and deadlines.
  void begin(const Graph& graph);
  /// Jobs in the order of their ends: for `Executor::on_job`. @pre `begin` was called.
  void note(const JobRecord& job);
  /// What a file of it holds.
  [[nodiscard]] std::string bytes() const;

 private:
  struct NodeName {
    std::string name{};
    Duration deadline{};
  };
  /// Of each track, by core and node: its packets, and where its last slice ends.
  struct Track {
    std::string packets{};
    MissionTime until{};
  };
  std::string graph_{};
  std::vector<NodeName> nodes_{};
  std::map<std::pair<int, int>, Track> tracks_{};
  std::string clock_packets_{};
  Hertz clock_{};
};

}  // namespace flyball
