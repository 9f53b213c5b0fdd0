// SPDX-License-Identifier: BSD-3-Clause

#include "studies/sweep/flight_figures.h"

#include <algorithm>
#include <cmath>

namespace flyball {

std::vector<std::pair<std::string, double>> figures_of(const Summary& s) {
  const auto share = [](std::uint64_t part, std::uint64_t all) {
    return 100.0 * static_cast<double>(part) / static_cast<double>(all);
  };
  std::vector<std::pair<std::string, double>> figures{
      {"mission_time_s", s.mission_time_s},
      {"energy_total_kj", 1e-3 * s.energy_total_j()},
      {"energy_computer_kj", 1e-3 * s.energy_computer_j},
      {"battery_used_percent", s.battery_used_percent()},
      {"mean_speed_m_s", s.mean_speed_m_s},
      {"max_speed_m_s", s.max_speed_m_s},
      {"distance_m", s.distance_m},
      {"hover_time_s", s.hover_time_s},
      {"replans", static_cast<double>(s.replans)},
      {"deadline_misses", static_cast<double>(s.deadline_misses)},
      {"knob_changes", static_cast<double>(s.knob_changes)},
      {"throttle_events", static_cast<double>(s.throttle_events)},
      {"min_clearance_m", s.min_clearance_m},
      {"policy_faults", static_cast<double>(s.policy_faults)}};
  if (s.maps > 0) {  // A flight without any map has no latency from sensor to command.
    figures.emplace_back("latency_p50_s", s.latency_p50_s);
    figures.emplace_back("latency_p95_s", s.latency_p95_s);
    figures.emplace_back("late_maps_percent", share(s.bound_overruns, s.maps));
  }
  for (const auto& [name, kernel] : s.kernels) {
    figures.emplace_back("kernel." + name + ".calls", static_cast<double>(kernel.calls));
    figures.emplace_back("kernel." + name + ".mean_ms", kernel.mission_ms_mean);
    figures.emplace_back("kernel." + name + ".p95_ms", kernel.mission_ms_p95);
  }
  for (const auto& [name, value] : s.quality) {
    figures.emplace_back("quality." + name, value);
  }
  figures.erase(std::remove_if(figures.begin(), figures.end(),
                               [](const auto& figure) { return !std::isfinite(figure.second); }),
                figures.end());
  return figures;
}

std::vector<std::string> figure_names(const std::vector<const Summary*>& flights) {
  std::vector<std::string> of_flight;
  std::vector<std::string> of_kernels;
  std::vector<std::string> of_quality;
  for (const Summary* flight : flights) {
    for (const auto& [name, value] : figures_of(*flight)) {
      auto& names = name.rfind("kernel.", 0) == 0    ? of_kernels
                    : name.rfind("quality.", 0) == 0 ? of_quality
                                                     : of_flight;
      if (std::find(names.begin(), names.end(), name) == names.end()) {
        names.push_back(name);
      }
    }
  }
  std::sort(of_kernels.begin(), of_kernels.end());
  std::sort(of_quality.begin(), of_quality.end());
  of_flight.insert(of_flight.end(), of_quality.begin(), of_quality.end());
  of_flight.insert(of_flight.end(), of_kernels.begin(), of_kernels.end());
  return of_flight;
}

}  // namespace flyball
