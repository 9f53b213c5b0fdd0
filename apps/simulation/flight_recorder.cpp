// SPDX-License-Identifier: BSD-3-Clause
// tested-in: mission
#include "simulation/flight_recorder.h"

#include "flyball/runtime/observation_fields.h"
#include "flyball/runtime/quantile.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace flyball {

FlightRecorder::FlightRecorder(MissionLink& link, const Graph& graph, const ClosedLoop& loop)
    : link_{link}, graph_{graph}, loop_{loop} {}

void FlightRecorder::record_state() {
  const VehicleState& state = loop_.vehicle().state();
  const Vec3& p = state.X_WB.translation();
  std::vector<Field> row{{"x_m", p.x()},
                         {"y_m", p.y()},
                         {"z_m", p.z()},
                         {"yaw_rad", yaw_of(state.X_WB.linear().col(0))},
                         {"speed_m_s", state.v_WB.norm()},
                         {"rotor_w", loop_.log().rotor_w},
                         {"computer_w", loop_.log().computer_w},
                         {"battery_percent", loop_.battery().percent()},
                         {"battery_v", loop_.battery().voltage_v()},
                         {"phase", std::string{to_string(link_.phase())}}};
  if (const auto& knobs = link_.knobs()) {
    row.push_back({"resolution_m", knobs->value("map.resolution_m")});
    row.push_back({"frequency_hz", knobs->value("cpu.frequency_hz")});
    held_ += knobs->restraint.must_hover && link_.phase() == MissionPhase::cruise ? 1 : 0;
  }
  if (const auto& navigator = link_.navigator()) {
    row.push_back({"set_speed_m_s", navigator->target_speed_m_s});
    row.push_back({"known_free_m", navigator->known_free_m});
    row.push_back({"latency_bound_s", to_seconds(navigator->latency_bound)});
    const TrackingError& error = navigator->tracking_error;
    row.push_back({"tracking_error_m", error.size_m});
    row.push_back({"across_error_m", error.across_m});
    row.push_back({"height_error_m", error.height_m});
    record_tracking(error);
  }
  link_.log("state", std::move(row));
}

/// A vehicle that lags behind a reference that brakes is ahead of it.
void FlightRecorder::record_tracking(const TrackingError& error) {
  if (link_.phase() != MissionPhase::cruise) {
    return;
  }
  off_path_m_.push_back(std::hypot(error.across_m, error.height_m));
  constexpr double fast_m_s = 2.0;  // Below it, the estimate's noise would look like a long time.
  const double speed_m_s = loop_.vehicle().state().v_WB.norm();
  if (speed_m_s > fast_m_s) {
    brake_lag_s_.push_back(error.ahead_m / speed_m_s);
  }
}

void FlightRecorder::record_job(const JobRecord& job) {
  const NodeSpec& node = graph_.nodes()[static_cast<std::size_t>(job.node)].spec;
  if (node.cost.empty() || (job.work.items().empty() && !job.killed)) {
    return;
  }
  const std::string& kernel = job.work.charged_as();
  auto& calls = calls_[kernel.empty() ? node.cost : kernel];
  calls.mission_ms.push_back(1e3 * to_seconds(job.ended - job.started));
  calls.host_s += job.host_s;
  // Two nodes run 100 and 50 times a second, and their rows would outnumber all others.
  if (node.name == "localize" || node.name == "follow") {
    return;
  }
  std::vector<Field> row{{"node", node.name},
                         {"released_s", to_seconds(job.released)},
                         {"started_s", to_seconds(job.started)},
                         {"busy_s", to_seconds(job.busy)},
                         {"missed", static_cast<std::int64_t>(job.missed)}};
  if (!kernel.empty()) {
    row.push_back({"kernel", kernel});
    row.push_back({"switches", job.work.count("switches")});
  }
  link_.log("job", std::move(row));
}

std::map<std::string, KernelStatistics> FlightRecorder::kernels() const {
  std::map<std::string, KernelStatistics> all;
  for (const auto& [name, calls] : calls_) {
    const auto n = static_cast<double>(calls.mission_ms.size());
    const double sum = std::accumulate(calls.mission_ms.begin(), calls.mission_ms.end(), 0.0);
    all[name] = {calls.mission_ms.size(), sum / n, quantile(calls.mission_ms, 0.95),
                 1e3 * calls.host_s / n};
  }
  return all;
}

}  // namespace flyball
