// SPDX-License-Identifier: BSD-3-Clause
// tested-in: scenario

#include "scenario/scenario_fields.h"

#include "scenario/kernel_choice.h"
#include "scenario/scenario_edge.h"

namespace flyball {
namespace {

using Fields = std::vector<ScenarioField>;

template <auto value>
auto* at_top(Scenario& scenario) {
  return &(scenario.*value);
}

// The limits are where a value stops making sense for a vehicle of this kind, or where the knob of
// the same name ends.

Fields mission_fields() {
  constexpr auto in = &Scenario::mission;
  using M = MissionSettings;
  return {
      {"mission.workload", &at<in, &M::workload>, 0, 0, "what is flown"},
      {"mission.time_limit_s", &at<in, &M::time_limit_s>, 1, 86400,
       "longer ends the mission as failed"},
      {"mission.plan_time_limit_s", &at<in, &M::plan_time_limit_s>, 1, 86400,
       "standing without a path for longer ends it too"},
      {"mission.max_speed_m_s", &at<in, &M::max_speed_m_s>, 0.5, 20,
       "upper limit; the safe speed below it is computed"},
      {"mission.max_acceleration_m_s2", &at<in, &M::max_acceleration_m_s2>, 0.5, 20,
       "the braking that the speed limit counts on"},
      {"mission.goal_tolerance_m", &at<in, &M::goal_tolerance_m>, 0.1, 100,
       "a path that ends this near to the goal has reached it; from others a plan is made"},
  };
}

Fields vehicle_fields() {
  constexpr auto in = &Scenario::vehicle;
  using V = VehicleSettings;
  return {
      {"vehicle.airframe", &at<in, &V::airframe>, 0, 0, "a shipped airframe or a .toml file"},
      {"vehicle.payload_kg", &at<in, &V::payload_kg>, 0, 20, "mass that is carried to the goal"},
      {"vehicle.tracking_error_m", &at<in, &V::tracking_error_m>, 0, 5,
       "how far it may be from its reference at rest; paths keep so much more room"},
      {"vehicle.brake_lag_s", &at<in, &V::brake_lag_s>, 0, 2,
       "how much later than its reference it brakes; stops are begun so much earlier"},
      {"vehicle.physics_step_s", &at<in, &V::physics_step_s>, 1e-4, 1e-2, "of the multibody model"},
      {"vehicle.comparison_step_s", &at<in, &V::comparison_step_s>, 0, 1e-2,
       "physics_step_s where several missions are flown and it is not given; 0: the same"},
      {"vehicle.battery_charge", &at<in, &V::battery_charge>, 0.01, 1,
       "share of the full charge at the start"},
      {"vehicle.rotor_power",
       &at<in, &V::rotor_power>,
       0,
       0,
       "model that drains the battery",
       {"regression", "thrust"}},
      {"vehicle.drive_efficiency", &at<in, &V::drive_efficiency>, 0.05, 1,
       "shaft over electrical power, thrust model"},
      {"vehicle.wind_east_m_s", &at<in, &V::wind_east_m_s>, -30, 30, "mean wind towards the east"},
      {"vehicle.wind_north_m_s", &at<in, &V::wind_north_m_s>, -30, 30,
       "mean wind towards the north"},
      {"vehicle.gust_wind_m_s", &at<in, &V::gust_wind_m_s>, 0, 30,
       "gusts are those of this wind at 6 m: 7.7 light, 15.4 moderate, 23.2 severe"},
  };
}

Fields camera_fields() {
  constexpr auto in = &Scenario::camera;
  using C = DepthCameraSpec;
  return {
      {"camera.width_px", &at<in, &C::width_px>, 8, 4096, "columns of the depth image"},
      {"camera.height_px", &at<in, &C::height_px>, 8, 4096, "rows of the depth image"},
      {"camera.horizontal_field_rad", &at<in, &C::horizontal_field_rad>, 0.1, 3, "field of view"},
      {"camera.rate_hz", &at<in, &C::rate_hz>, 0.1, 240, "frames a second"},
      {"camera.max_range_m", &at<in, &C::max_range_m>, 0.5, 200, "beyond it nothing is seen"},
      {"camera.rgbd_noise", &at<in, &C::rgbd_noise>, 0, 0,
       "noise of an RGB-D camera, growing with depth"},
      {"camera.extra_noise_m", &at<in, &C::extra_noise_m>, 0, 10,
       "standard deviation added at every depth"},
      {"camera.count", &at<in, &C::count>, 1, 12,
       "cameras around one place, evenly; the first one looks ahead"},
      {"camera.forward_m", &at<in, &C::forward_m>, -2, 2, "of that place, from the body's centre"},
      {"camera.up_m", &at<in, &C::up_m>, -2, 2, "as forward_m"},
      {"camera.pitch_down_rad", &at<in, &C::pitch_down_rad>, -1.5, 1.5,
       "of each camera, from level"},
      {"camera.delay_s", &at<in, &C::delay_s>, 0, 1,
       "from the moment that an image shows to its message"},
  };
}

Fields colour_camera_fields() {
  constexpr auto in = &Scenario::colour_camera;
  using C = ColourCameraSpec;
  return {
      {"colour_camera.width_px", &at<in, &C::width_px>, 8, 4096, "columns of the colour image"},
      {"colour_camera.height_px", &at<in, &C::height_px>, 8, 4096, "rows of the colour image"},
      {"colour_camera.horizontal_field_rad", &at<in, &C::horizontal_field_rad>, 0.1, 3,
       "field of view"},
      {"colour_camera.rate_hz", &at<in, &C::rate_hz>, 0.1, 240, "frames a second"},
      {"colour_camera.delay_s", &at<in, &C::delay_s>, 0, 1,
       "from the moment that a picture shows to its message"},
      {"colour_camera.sun_azimuth_rad", &at<in, &C::sun_azimuth_rad>, -7, 7,
       "where the sun stands, from east towards north"},
      {"colour_camera.sun_elevation_rad", &at<in, &C::sun_elevation_rad>, 0.05, 1.57,
       "above the horizon"},
      {"colour_camera.people_folder", &at<in, &C::people_folder>, 0, 0,
       "of the people's meshes: package morse-simulator-data"},
  };
}

Fields detector_fields() {
  constexpr auto in = &Scenario::detector;
  using D = DetectorSettings;
  return {
      {"detector.scale", &at<in, &D::scale>, 0.25, 4, "image size until a policy sets it"},
      {"detector.cost_of", &at<in, &D::cost_of>, 0, 0,
       "whose price a detection has: own, or a kernel of the platform"},
      {"detector.models_folder", &at<in, &D::models_folder>, 0, 0,
       "looked in first for weights; shipped: only where flyball models looks"},
  };
}

Fields photography_fields() {
  constexpr auto in = &Scenario::photography;
  using P = PhotographySettings;
  return {
      {"photography.distance_m", &at<in, &P::distance_m>, 2, 50,
       "kept to the person, along the ground"},
      {"photography.person_height_m", &at<in, &P::person_height_m>, 0.5, 2.5,
       "from which the distance is told"},
      {"photography.coast_s", &at<in, &P::coast_s>, 0, 60,
       "somebody unseen is followed on, straight ahead, for so long"},
      {"photography.search_rate_rad_s", &at<in, &P::search_rate_rad_s>, 0, 1.57,
       "then the vehicle turns round for them; 0: it stands"},
      {"photography.lost_after_detections", &at<in, &P::lost_after_detections>, 1, 1000,
       "detections in a row without the person end the mission"},
      {"photography.success_s", &at<in, &P::success_s>, 1, 3600, "tracked for less is a failure"},
      {"photography.limit_s", &at<in, &P::limit_s>, 1, 3600,
       "tracked for so long ends the mission, with success"},
  };
}

Fields watch_fields() {
  constexpr auto in = &Scenario::watch;
  using W = WatchSettings;
  return {
      {"watch.time_s", &at<in, &W::time_s>, 1, 86400, "watched for so long"},
      {"watch.height_m", &at<in, &W::height_m>, 0, 120,
       "of the hover, above the ground; 0: standing there with the rotors off"},
      {"watch.at_goal", &at<in, &W::at_goal>, 0, 0,
       "true: the vehicle flies to the goal, stands there with its rotors off, and flies home"},
      {"watch.longest_s", &at<in, &W::longest_s>, 0.01, 3600,
       "longer between two maps is a failure"},
  };
}

Fields barometer_fields() {
  constexpr auto in = &Scenario::barometer;
  using B = BarometerSpec;
  return {
      {"barometer.white_noise_pa", &at<in, &B::white_noise_pa>, 0, 1000,
       "standard deviation of one sample; 1.2 Pa are a decimetre"},
      {"barometer.wander_pa", &at<in, &B::wander_pa>, 0, 10000, "standard deviation of the bias"},
      {"barometer.wander_time_s", &at<in, &B::wander_time_s>, 0.1, 1e6,
       "correlation time of the bias"},
  };
}

Fields gps_fields() {
  constexpr auto in = &Scenario::gps;
  using G = GpsSpec;
  return {
      {"gps.rate_hz", &at<in, &G::rate_hz>, 0.1, 100, "fixes a second"},
      {"gps.white_noise_m", &at<in, &G::white_noise_m>, 0, 100, "standard deviation of one fix"},
      {"gps.wander_m", &at<in, &G::wander_m>, 0, 100, "standard deviation of the bias"},
      {"gps.wander_time_s", &at<in, &G::wander_time_s>, 0.1, 1e6, "correlation time of the bias"},
      {"gps.velocity_noise_m_s", &at<in, &G::velocity_noise_m_s>, 0, 10,
       "standard deviation of the Doppler velocity"},
  };
}

Fields kernel_fields() {
  Fields fields;
  for (const FamilyChoice& family : family_choices()) {
    fields.push_back({"kernels." + family.name, family.place, 0, 0, family.description});
  }
  fields.push_back({"kernels.slam_load", &at<&Scenario::kernels, &KernelSettings::slam_load>, 0, 0,
                    "charge the SLAM time per frame beside a localizer that needs none"});
  return fields;
}

Fields knob_fields() {
  constexpr auto in = &Scenario::knobs;
  using K = KnobChoices;
  return {
      {"knobs.planner_kinds", &at<in, &K::planner_kinds>, 0, 0,
       "planners that planner.kind may switch to in flight, with commas; none: no such knob"},
      {"knobs.detector_kinds", &at<in, &K::detector_kinds>, 0, 0,
       "detectors that detector.kind may switch to in flight, with commas; none: no such knob"},
      {"knobs.camera_rate", &at<in, &K::camera_rate>, 0, 0,
       "whether camera.rate_hz may be turned down in flight"},
      {"knobs.localizer_rate", &at<in, &K::localizer_rate>, 0, 0,
       "whether localizer.rate_hz may be turned down in flight"},
  };
}

Fields scan_fields() {
  constexpr auto in = &Scenario::scan;
  using S = ScanSettings;
  return {
      {"scan.length_m", &at<in, &S::length_m>, 5, 5000, "of the surveyed area, along the lanes"},
      {"scan.width_m", &at<in, &S::width_m>, 5, 5000, "across the lanes"},
      {"scan.lanes", &at<in, &S::lanes>, 1, 1000, "flown to and fro"},
      {"scan.height_m", &at<in, &S::height_m>, 2, 120, "of flight, above the ground"},
      {"scan.picture_rate_hz", &at<in, &S::picture_rate_hz>, 0.1, 60,
       "of the camera that looks down"},
      {"scan.coverage_percent", &at<in, &S::coverage_percent>, 0, 100,
       "less of the area in pictures is a failure"},
  };
}

Fields search_fields() {
  constexpr auto in = &Scenario::search;
  using S = SearchSettings;
  return {
      {"search.sightings", &at<in, &S::sightings>, 1, 100,
       "that agree before somebody counts as found"},
      {"search.within_m", &at<in, &S::within_m>, 0.1, 10, "of each other, along the ground"},
      {"search.apart_m", &at<in, &S::apart_m>, 0, 20, "between the places they were made from"},
  };
}

Fields explore_fields() {
  constexpr auto in = &Scenario::explore;
  using E = ExploreSettings;
  return {
      {"explore.coverage_percent", &at<in, &E::coverage_percent>, 1, 100,
       "of the volume that can be seen; a mapping flies home when it believes so"},
      {"explore.gain_range_m", &at<in, &E::gain_range_m>, 1, 25, "how far a view counts"},
      {"explore.extension_m", &at<in, &E::extension_m>, 0.5, 25, "longest edge of the tree"},
      {"explore.iterations", &at<in, &E::iterations>, 1, 10000,
       "nodes of the tree until a policy sets it"},
      {"explore.most_iterations", &at<in, &E::most_iterations>, 1, 10000,
       "nodes while none of them shows anything new"},
      {"explore.discount_1_m", &at<in, &E::discount_1_m>, 0, 10,
       "how fast a gain falls with the length of the path to it"},
      {"explore.threads", &at<in, &E::threads>, 1, 16,
       "so many look at views at once, each on a core if one is idle; the next view is the same"},
  };
}

Fields computer_fields() {
  return {
      {"map.resolution_m", &at<&Scenario::map, &MapSettings::resolution_m>, 0.05, 2,
       "cell size until a policy sets it"},
      {"map.range_m", &at<&Scenario::map, &MapSettings::range_m>, 2, 25,
       "how far depth is integrated"},
      {"map.rate_hz", &at<&Scenario::map, &MapSettings::rate_hz>, 0.5, 60,
       "frames integrated a second, at most"},
      {"planner.budget", &at<&Scenario::planner, &PlannerSettings::budget>, 100, 1e6,
       "iterations that one search for a path may take"},
      {"planner.horizon_m", &at<&Scenario::planner, &PlannerSettings::horizon_m>, 0, 10000,
       "a farther goal is approached through intermediate places; 0: planned to at once"},
      {"platform.name", &at<&Scenario::platform, &PlatformSettings::name>, 0, 0,
       "the companion computer"},
      {"platform.cores", &at<&Scenario::platform, &PlatformSettings::cores>, 1, 256,
       "cores that may run jobs"},
      {"platform.frequency_hz", &at<&Scenario::platform, &PlatformSettings::frequency_hz>, 1e6,
       1e10, "clock of all cores"},
      {"platform.start_temperature_c",
       &at<&Scenario::platform, &PlatformSettings::start_temperature_c>, 0, 120,
       "at take-off; 0: as warm as it is after it has idled for long"},
      {"faults.detector",
       &at<&Scenario::faults, &FaultSettings::detector>,
       0,
       0,
       "refuses messages whose numbers, or their changes, no vehicle can mean",
       {"none", "range", "rate", "both"}},
      {"governor.policy", &at<&Scenario::governor, &GovernorSettings::policy>, 0, 0,
       "turns the knobs in flight"},
      {"governor.period_s", &at<&Scenario::governor, &GovernorSettings::period_s>, 0.01, 10,
       "time between decisions"},
  };
}

void append(Fields& all, Fields more) {
  for (ScenarioField& field : more) {
    all.push_back(std::move(field));
  }
}

}  // namespace

std::vector<ScenarioField> scenario_fields() {
  Fields all{
      {"name", &at_top<&Scenario::name>, 0, 0, "in tables, and of the folder that flights go to"},
      {"seed", &at_top<&Scenario::seed>, 0, 0, "of the world, the sensors and the planner"},
      {"world.generator", &at<&Scenario::world, &WorldSettings::generator>, 0, 0,
       "makes the world"},
  };
  append(all, mission_fields());
  append(all, vehicle_fields());
  append(all, camera_fields());
  append(all, colour_camera_fields());
  append(all, gps_fields());
  append(all, barometer_fields());
  append(all, kernel_fields());
  append(all, knob_fields());
  append(all, scan_fields());
  append(all, explore_fields());
  append(all, detector_fields());
  append(all, photography_fields());
  append(all, search_fields());
  append(all, watch_fields());
  append(all, computer_fields());
  append(all, edge_fields());
  return all;
}

}  // namespace flyball
