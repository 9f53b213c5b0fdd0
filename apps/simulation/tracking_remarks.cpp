// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/simulation/tracking_remarks.h"

#include "flyball/records/text_table.h"

#include <algorithm>

namespace flyball {

std::vector<std::string> tracking_remarks(const Summary& summary, const Scenario& scenario) {
  std::vector<std::string> remarks;
  const auto compare = [&](const char* measured, const char* what, const char* key, double declared,
                           const char* unit) {
    const auto found = summary.quality.find(measured);
    if (found != summary.quality.end() && found->second > declared) {
      remarks.push_back(std::string{what} + " " + rounded(found->second, 2) + " " + unit +
                        ", and " + key + " says " + rounded(declared, 2) + " " + unit +
                        ": set it to so much, or tune the autopilot");
    }
  };
  compare("off_path_m_p95", "5 % of the time the autopilot was farther off its path than",
          "vehicle.tracking_error_m", scenario.vehicle.tracking_error_m, "m");
  compare("brake_lag_s_p99",
          "1 % of the time the autopilot was ahead of its reference by more than",
          "vehicle.brake_lag_s", scenario.vehicle.brake_lag_s, "s");
  constexpr double often_percent = 10.0;
  const auto held = summary.quality.find("held_percent");
  if (held != summary.quality.end() && held->second > often_percent) {
    remarks.push_back(
        "the governor let the vehicle hover for " + rounded(held->second, 0) +
        " % of its way, because this computer missed deadlines again and again; give "
        "it less to do beside the flight, or the flight less (map.rate_hz, map.range_m)");
  }
  return remarks;
}

std::vector<std::string> make_careful(Scenario& scenario, const std::vector<std::string>& kept) {
  constexpr double most_m_s = 5.0;
  constexpr double most_m_s2 = 3.0;
  constexpr double least_error_m = 0.2;
  constexpr double least_lag_s = 0.3;
  std::vector<std::string> changed;
  const auto set = [&](const char* key, double& setting, double careful, bool is_looser) {
    if (is_looser && std::find(kept.begin(), kept.end(), key) == kept.end()) {
      setting = careful;
      changed.push_back(std::string{key} + "=" + rounded(careful, 1));
    }
  };
  const auto at_most = [&set](const char* key, double& setting, double most) {
    set(key, setting, most, setting > most);
  };
  const auto at_least = [&set](const char* key, double& setting, double least) {
    set(key, setting, least, setting < least);
  };
  at_most("mission.max_speed_m_s", scenario.mission.max_speed_m_s, most_m_s);
  at_most("mission.max_acceleration_m_s2", scenario.mission.max_acceleration_m_s2, most_m_s2);
  at_least("vehicle.tracking_error_m", scenario.vehicle.tracking_error_m, least_error_m);
  at_least("vehicle.brake_lag_s", scenario.vehicle.brake_lag_s, least_lag_s);
  return changed;
}

}  // namespace flyball
