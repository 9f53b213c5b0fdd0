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
ObservationField field(const char* name, const char* unit, const char* description) {
  return {name, get<member>, set<member>, false, unit, description};
}

template <auto member>
ObservationField seconds(const char* name, const char* description) {
  return {name,
          [](const Observation& seen) { return to_seconds(seen.*member); },
          [](Observation& seen, double value) { seen.*member = nearest_duration(value); },
          false,
          "s",
          description};
}

/// Of a type that carries its unit.
template <auto member>
ObservationField scalar(const char* name, const char* unit, const char* description) {
  return {name,
          [](const Observation& seen) { return (seen.*member).value(); },
          [](Observation& seen, double value) {
            seen.*member = std::decay_t<decltype(seen.*member)>{value};
          },
          false,
          unit,
          description};
}

ObservationField optional(ObservationField one) {
  one.is_optional = true;
  return one;
}

template <Stage stage>
ObservationField job_s(const char* name) {
  return {
      name,
      [](const Observation& seen) { return to_seconds(seen.stage(stage).latency); },
      [](Observation& seen, double value) { seen.stage(stage).latency = nearest_duration(value); },
      true,
      "s",
      "From the trigger to the result of this stage's newest job"};
}

template <Stage stage>
ObservationField load(const char* name) {
  return {name,
          [](const Observation& seen) { return seen.stage(stage).load; },
          [](Observation& seen, double value) { seen.stage(stage).load = value; },
          true,
          "1",
          "Cores that the jobs of this stage kept busy which ended since the last decision"};
}

template <Stage stage>
ObservationField gigacycles(const char* name) {
  return {name,
          [](const Observation& seen) { return seen.stage(stage).gigacycles; },
          [](Observation& seen, double value) { seen.stage(stage).gigacycles = value; },
          true,
          "1e9",
          "Clock cycles that this stage's newest job took"};
}

ObservationField progress_unit_field() {
  return {"progress_unit",
          [](const Observation& seen) { return static_cast<double>(seen.progress_unit); },
          [](Observation& seen, double value) {
            seen.progress_unit = static_cast<ProgressUnit>(std::clamp(whole<int>(value), 0, 4));
          },
          true,
          "1",
          "Unit of the progress: 0 none is told, 1 m, 2 m^2, 3 m^3, 4 s"};
}

ObservationField phase_field() {
  return {"phase",
          [](const Observation& seen) { return static_cast<double>(seen.phase); },
          [](Observation& seen, double value) {
            seen.phase = static_cast<MissionPhase>(std::clamp(whole<int>(value), 0, 3));
          },
          false,
          "1",
          "What the vehicle does: 0 take-off, 1 cruise, 2 landing, 3 waiting"};
}

std::vector<ObservationField> flight_fields() {
  using O = Observation;
  return {
      phase_field(),
      field<&O::speed_m_s>("speed_m_s", "m/s", "Speed of the vehicle"),
      field<&O::known_free_m>(
          "known_free_m", "m",
          "Distance along the committed path that is known to be free; 0: there is no path"),
      field<&O::obstacle_density>(
          "obstacle_density", "1",
          "Share of .8 m columns around the vehicle that hold an obstacle, 0 to 1"),
      field<&O::density_ahead>("density_ahead", "1",
                               "The largest such density around the committed path, 4 to 12 m on"),
      field<&O::nearest_obstacle_m>(
          "nearest_obstacle_m", "m",
          "From the body's centre to the nearest obstacle in the map, at most 20"),
      field<&O::distance_to_goal_m>("distance_to_goal_m", "m",
                                    "From the vehicle to the goal, as the crow flies"),
      field<&O::tracking_error_m>("tracking_error_m", "m",
                                  "From the vehicle to where its reference is"),
      field<&O::speed_limit_m_s>("speed_limit_m_s", "m/s",
                                 "The mission's least speed limit, here and 20 m on"),
      field<&O::map_resolution_m>("map_resolution_m", "m",
                                  "Edge of the cells of the map that is flown by"),
      field<&O::map_revision>(
          "map_revision", "1",
          "Number of maps that were published; the latency is the newest one's"),
      seconds<&O::latency>("latency_s", "From sensor to published map, of the newest map"),
      seconds<&O::latency_bound>(
          "latency_bound_s",
          "Upper bound on a map's age (in the C library: a frame's latency) for the safe speed"),
      field<&O::deadline_misses>("deadline_misses", "1",
                                 "Deadlines missed since the last decision"),
      field<&O::queue_drops>("queue_drops", "1", "Messages dropped since the last decision"),
      field<&O::planner_failures>(
          "planner_failures", "1",
          "Searches without a path since one was found, and stalls since the vehicle last moved"),
      field<&O::cores>("cores", "1", "Cores that the computer grants"),
      scalar<&O::frequency>("frequency_hz", "Hz", "Clock that the computer grants"),
      field<&O::busy_cores>("busy_cores", "1", "Mean number of busy cores since the last decision"),
      field<&O::busiest_core_load>(
          "busiest_core_load", "1",
          "Share of the time since the last decision in which the busiest core was busy, 0 to 1"),
      scalar<&O::computer_power>("computer_power_w", "W", "Power that the computer draws"),
      scalar<&O::rotor_power>("rotor_power_w", "W", "Power that the rotors draw"),
      field<&O::battery_percent>("battery_percent", "%", "Charge of the battery"),
      field<&O::max_deceleration_m_s2>("max_deceleration_m_s2", "m/s^2",
                                       "Deceleration that the mission's safe speed counts on"),
      field<&O::narrowest_gap_m>("narrowest_gap_m", "m",
                                 "Least width ahead, on the way to the goal and along the path"),
      field<&O::gap_distance_m>("gap_distance_m", "m", "How far ahead that gap is"),
      field<&O::mean_gap_m>("mean_gap_m", "m", "Mean of the widest openings ahead"),
      optional(field<&O::temperature_c>(
          "temperature_c", "degC",
          "Temperature of the computer where its clocks' limit is measured")),
      optional(field<&O::trip_c>(
          "trip_c", "degC",
          "Lowest temperature at which the computer loses clocks; 0: nobody says")),
      seconds<&O::map_age>("map_age_s",
                           "Since the frame of the newest map was captured; 0: nobody says")};
}

std::vector<ObservationField> progress_and_power_fields() {
  using O = Observation;
  return {
      optional(field<&O::headroom_m>(
          "headroom_m", "m", "From the top of the body up to an obstacle in the map, at most 5")),
      progress_unit_field(),
      optional(field<&O::progress>(
          "progress", "1", "What the mission has achieved since take-off, in progress_unit")),
      optional(scalar<&O::cpu_power>("cpu_power_w", "W", "Power of the processors' rail")),
      optional(scalar<&O::gpu_power>("gpu_power_w", "W", "Power of the graphics processor's rail")),
      optional(scalar<&O::memory_power>("memory_power_w", "W", "Power of the memory's rail")),
      optional(scalar<&O::soc_power>("soc_power_w", "W", "Power of the rest of the chip")),
      optional(seconds<&O::map_within>(
          "map_within_s",
          "While waiting: how soon after a map the mission needs the next; 0: nobody says")),
      optional(field<&O::slower_zone_m>(
          "slower_zone_m", "m",
          "To the nearest zone with a lower speed limit than here, at most 40; 0: nobody says")),
      optional(field<&O::map_range_m>(
          "map_range_m", "m", "Range of the newest frame in the newest map; 0: nobody says"))};
}

std::vector<ObservationField> stage_fields() {
  return {job_s<Stage::map>("map_job_s"),
          load<Stage::map>("map_load"),
          gigacycles<Stage::map>("map_gigacycles"),
          job_s<Stage::plan>("plan_job_s"),
          load<Stage::plan>("plan_load"),
          gigacycles<Stage::plan>("plan_gigacycles"),
          job_s<Stage::detect>("detect_job_s"),
          load<Stage::detect>("detect_load"),
          gigacycles<Stage::detect>("detect_gigacycles"),
          job_s<Stage::track>("track_job_s"),
          load<Stage::track>("track_load"),
          gigacycles<Stage::track>("track_gigacycles"),
          job_s<Stage::localize>("localize_job_s"),
          load<Stage::localize>("localize_load"),
          gigacycles<Stage::localize>("localize_gigacycles"),
          job_s<Stage::explore>("explore_job_s"),
          load<Stage::explore>("explore_load"),
          gigacycles<Stage::explore>("explore_gigacycles")};
}

}  // namespace

// A member that is missing above is neither recorded nor replayed: whoever adds one is told here.
static_assert(sizeof(Observation) == 456, "a new member belongs into observation_fields() too");

const std::vector<ObservationField>& observation_fields() {
  static const std::vector<ObservationField> all = [] {
    std::vector<ObservationField> fields = flight_fields();
    for (const auto& part : {progress_and_power_fields(), stage_fields()}) {
      fields.insert(fields.end(), part.begin(), part.end());
    }
    return fields;
  }();
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
