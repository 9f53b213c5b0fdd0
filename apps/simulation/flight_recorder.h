// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What goes into the trace while a mission flies, and the statistics of its jobs.

#include "flyball/records/summary.h"

#include "simulation/closed_loop.h"
#include <map>
#include <string>
#include <vector>

namespace flyball {

class FlightRecorder {
 public:
  /// All arguments outlive the recorder.
  FlightRecorder(MissionLink& link, const Graph& graph, const ClosedLoop& loop);

  /// One row of channel `state`.
  void record_state();
  /// Statistics of every job; a row of channel `job` for all but the two most frequent nodes.
  void record_job(const JobRecord& job);
  [[nodiscard]] std::map<std::string, KernelStatistics> kernels() const;
  /// How far the vehicle was from its path [m], at each recorded state in cruise.
  [[nodiscard]] const std::vector<double>& off_path_m() const { return off_path_m_; }
  /// At how many of these states the governor's fallback let it hover.
  [[nodiscard]] std::size_t held() const { return held_; }
  /// By how much time it was ahead of its reference [s], where it flew faster than 2 m/s.
  [[nodiscard]] const std::vector<double>& brake_lag_s() const { return brake_lag_s_; }

 private:
  void record_tracking(const TrackingError& error);

  struct Calls {
    std::vector<double> mission_ms;
    double host_s{};
  };
  MissionLink& link_;
  const Graph& graph_;
  const ClosedLoop& loop_;
  std::map<std::string, Calls> calls_;
  std::vector<double> off_path_m_;
  std::vector<double> brake_lag_s_;
  std::size_t held_{};
};

}  // namespace flyball
