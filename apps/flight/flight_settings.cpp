// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/flight_settings.h"

namespace flyball {

GuardSettings guard_settings(const FlightSettings& settings) {
  GuardSettings guard;
  guard.max_deceleration_m_s2 = settings.mission.max_acceleration_m_s2;
  guard.brake_lag = settings.brake_lag;
  return guard;
}

std::string mapper_cost(const KernelSettings& kernels) {
  const auto named = kernels.mapper_parameters.find("cost_of");
  const auto* kernel =
      named == kernels.mapper_parameters.end() ? nullptr : std::get_if<std::string>(&named->second);
  return kernel == nullptr ? kernels.mapper : *kernel;
}

std::string detector_cost(const FlightSettings& settings) {
  return settings.detector.cost_of == "own" ? settings.kernels.detector : settings.detector.cost_of;
}

std::string frame_cost(const std::string& localizer) {
  return localizer + "_frames";
}

}  // namespace flyball
