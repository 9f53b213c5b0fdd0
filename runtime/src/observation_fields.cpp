// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/observation_fields.h"

#include <algorithm>
#include <limits>

namespace flyball {
namespace {

/// 0 for what is no whole number in T's range: a record may be damaged.
template <class T>
T whole(double value) {
  const auto least = static_cast<double>(std::numeric_limits<T>::min());
  const auto most = static_cast<double>(std::numeric_limits<T>::max());
  return value >= least && value < most ? static_cast<T>(value)
         : value == most                ? std::numeric_limits<T>::max()
                                        : T{};
}

template <auto member>
double get(const Observation& seen) {
  return static_cast<double>(seen.*member);
}

template <auto member>
void set(Observation& seen, double value) {
  using Member = std::decay_t<decltype(seen.*member)>;
  if constexpr (std::is_same_v<Member, double>) {
    seen.*member = value;
  } else {
    seen.*member = whole<Member>(value);
  }
}

template <auto member>
ObservationField field(const char* name) {
  return {name, get<member>, set<member>};
}

template <auto member>
ObservationField seconds(const char* name) {
  return {name, [](const Observation& seen) { return to_seconds(seen.*member); },
          [](Observation& seen, double value) { seen.*member = nearest_duration(value); }};
}

/// Of a type that carries its unit.
template <auto member>
ObservationField scalar(const char* name) {
  return {name, [](const Observation& seen) { return (seen.*member).value(); },
          [](Observation& seen, double value) {
            seen.*member = std::decay_t<decltype(seen.*member)>{value};
          }};
}

ObservationField optional(ObservationField one) {
  one.is_optional = true;
  return one;
}

ObservationField phase_field() {
  return {"phase", [](const Observation& seen) { return static_cast<double>(seen.phase); },
          [](Observation& seen, double value) {
            seen.phase = static_cast<MissionPhase>(std::min(whole<int>(value), 3));
          }};
}

}  // namespace

// A member that is missing below is neither recorded nor replayed: whoever adds one is told here.
static_assert(sizeof(Observation) == 232, "a new member belongs into observation_fields() too");

const std::vector<ObservationField>& observation_fields() {
  using O = Observation;
  static const std::vector<ObservationField> all{
      phase_field(),
      field<&O::speed_m_s>("speed_m_s"),
      field<&O::known_free_m>("known_free_m"),
      field<&O::obstacle_density>("obstacle_density"),
      field<&O::density_ahead>("density_ahead"),
      field<&O::nearest_obstacle_m>("nearest_obstacle_m"),
      field<&O::distance_to_goal_m>("distance_to_goal_m"),
      field<&O::tracking_error_m>("tracking_error_m"),
      field<&O::speed_limit_m_s>("speed_limit_m_s"),
      field<&O::map_resolution_m>("map_resolution_m"),
      field<&O::map_revision>("map_revision"),
      seconds<&O::latency>("latency_s"),
      seconds<&O::latency_bound>("latency_bound_s"),
      field<&O::deadline_misses>("deadline_misses"),
      field<&O::queue_drops>("queue_drops"),
      field<&O::planner_failures>("planner_failures"),
      field<&O::cores>("cores"),
      scalar<&O::frequency>("frequency_hz"),
      field<&O::busy_cores>("busy_cores"),
      field<&O::busiest_core_load>("busiest_core_load"),
      scalar<&O::computer_power>("computer_power_w"),
      scalar<&O::rotor_power>("rotor_power_w"),
      field<&O::battery_percent>("battery_percent"),
      field<&O::max_deceleration_m_s2>("max_deceleration_m_s2"),
      field<&O::narrowest_gap_m>("narrowest_gap_m"),
      field<&O::gap_distance_m>("gap_distance_m"),
      field<&O::mean_gap_m>("mean_gap_m"),
      optional(field<&O::temperature_c>("temperature_c")),
      optional(field<&O::trip_c>("trip_c")),
      seconds<&O::map_age>("map_age_s"),
  };
  return all;
}

const char* to_string(MissionPhase phase) {
  switch (phase) {
    case MissionPhase::take_off:
      return "take_off";
    case MissionPhase::cruise:
      return "cruise";
    case MissionPhase::land:
      return "land";
    case MissionPhase::wait:
      return "wait";
    case MissionPhase::unset:
      return "unset";
  }
  return "unknown";
}

}  // namespace flyball
