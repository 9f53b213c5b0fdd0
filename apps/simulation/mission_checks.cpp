// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/mission_checks.h"

#include "flyball/records/report.h"
#include "flyball/records/text_table.h"
#include "flyball/runtime/text/listed.h"
#include "flyball/runtime/text/number_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace flyball {

Status check_map_name(const std::string& path) {
  const std::string ending = std::filesystem::path{path}.extension().string();
  if (!path.empty() && ending != ".bt" && ending != ".ot") {
    return Error{ErrorCode::invalid_input, "map file \"" + path +
                                               "\" must end in .bt (free or occupied) or .ot "
                                               "(log-odds)"};
  }
  return path.empty() ? Status{Done{}} : check_place(path);
}

Status check_start_map(const std::string& path, const MissionEquipment& equipment) {
  const std::vector<double> cells_m = equipment.kernels.mapper->resolutions_m();
  const auto has = [&cells_m](double wanted_m) {
    return std::any_of(cells_m.begin(), cells_m.end(), [wanted_m](double cell_m) {
      return std::abs(cell_m - wanted_m) < 1e-9;  // As the mapper compares them.
    });
  };
  const KnobSpec* knob = equipment.knobs.spec("map.resolution_m");
  if (cells_m.empty() || knob == nullptr ||
      (has(knob->fallback) && std::all_of(knob->legal.begin(), knob->legal.end(), has))) {
    return Done{};
  }
  const std::vector<double> wanted_m =
      knob->legal.empty() ? std::vector<double>{knob->fallback} : knob->legal;
  return Error{ErrorCode::invalid_input,
               "start map \"" + path + "\" has cells of " + listed(cells_m, number_text) +
                   " m, and the mission maps at " + listed(wanted_m, number_text) +
                   " m; set kernels.mapper_parameters.finest_m to " + number_text(cells_m.front()) +
                   " and map.resolution_m to one of the map's cells, or make the map with cells "
                   "of " +
                   number_text(wanted_m.front()) + " m"};
}

Status check_executor(const Scenario& scenario, const MissionHooks& hooks) {
  if (!hooks.executor) {
    return Done{};
  }
  std::string key;
  if (scenario.edge.platform != "none") {
    key = "edge.platform = \"" + scenario.edge.platform + "\"";
  } else if (scenario.faults.detector != "none") {
    key = "faults.detector = \"" + scenario.faults.detector + "\"";
  } else if (!scenario.events.empty()) {
    key = "events.1.kind = \"" + scenario.events.front().kind + "\"";
  }
  return key.empty() ? Status{Done{}}
                     : Status{Error{ErrorCode::invalid_input,
                                    key + " needs the modeled computer; leave it out, or fly " +
                                        "without --executor realtime"}};
}

Status check_depth_camera(const Scenario& scenario,
                          const MissionSetup& setup,
                          const MissionHooks& hooks) {
  if (hooks.depth_camera == nullptr) {
    return Done{};
  }
  std::string why;
  if (hooks.autopilot == nullptr) {
    why = "no simulated vehicle carries it; add --autopilot";
  } else if (scenario.camera.count != 1) {
    why = "camera.count = " + std::to_string(scenario.camera.count) + "; set it to 1";
  } else if (setup.things.cameras.forward) {
    why = "kernels.localizer = \"" + scenario.kernels.localizer +
          "\" takes images in colour, too; set it to truth, which is the autopilot's pose then";
  } else if (setup.things.cameras.gimbal) {
    why = "mission.workload = \"" + scenario.mission.workload +
          "\" looks for people in colour; fly another workload";
  }
  return why.empty() ? Status{Done{}}
                     : Status{Error{ErrorCode::invalid_input,
                                    "a real depth camera cannot be flown with: " + why}};
}

Status check_room(const SimulatedThings& things, bool lands_at_goal) {
  const World& world = things.world;
  const Cylinder body = things.airframe.body();
  const double high_m = world.cruise_height_m + body.half_height_m;
  const Cylinder column{body.radius_m, 0.5 * high_m};
  const Clearance clearance{world};
  for (const bool is_goal : {false, true}) {
    const Vec3& place_W = is_goal ? world.goal_W : world.start_W;
    const Vec3 middle_W = place_W + 0.5 * high_m * Vec3::UnitZ();
    if ((is_goal && !lands_at_goal) || clearance.distance_m(middle_W, column, 1.0, true) > 0.0) {
      continue;
    }
    return Error{ErrorCode::invalid_input,
                 std::string{is_goal ? "goal (" : "start ("} + rounded(place_W.x(), 2) + ", " +
                     rounded(place_W.y(), 2) + ") m has no room for a vehicle that is " +
                     rounded(2.0 * body.radius_m, 2) + " m wide, between the ground and " +
                     rounded(high_m, 2) + " m above it; choose another place in [world], or a " +
                     "smaller vehicle.airframe"};
  }
  return Done{};
}

Status check_start(const Brief& brief) {
  const bool is_held_closely = brief.tube.at_rest_m <= TrackingTube{}.at_rest_m;
  if (!brief.maps_obstacles || is_held_closely) {
    return Done{};
  }
  const DepthCameraSpec& camera = brief.settings.camera;
  const Intrinsics image = camera.intrinsics();
  const double half_field_rad = std::atan(0.5 * image.height_px / image.focal_px);
  const double above = std::tan(half_field_rad - camera.pitch_down_rad);
  const double below = std::tan(half_field_rad + camera.pitch_down_rad);
  const Cylinder body = brief.narrow_body();
  const bool looks_ahead = std::abs(camera.pitch_down_rad) < half_field_rad;
  const double seen_from_m =
      looks_ahead ? camera.forward_m + std::max((body.half_height_m - camera.up_m) / above,
                                                (body.half_height_m + camera.up_m) / below)
                  : 0.0;
  const double radius_m = std::max(body.radius_m, seen_from_m);
  const Site& site = brief.site;
  const double top_m =
      std::min(site.cruise_height_m + body.half_height_m, site.bounds_W.max.z() - site.ground_z_m);
  if (radius_m <= site.start_clear_m && top_m <= site.clear_height_m) {
    return Done{};
  }
  return Error{ErrorCode::invalid_input,
               "the vehicle cannot leave its start, which is declared clear to " +
                   rounded(site.start_clear_m, 2) + " m around it and to " +
                   rounded(site.clear_height_m, 2) + " m above the ground: with " +
                   "vehicle.tracking_error_m = " + number_text(brief.tube.at_rest_m) +
                   " and its camera's field it needs " + rounded(radius_m, 2) + " m and " +
                   rounded(top_m, 2) + " m; choose a smaller error, a larger field, or a world " +
                   "that declares more"};
}

}  // namespace flyball
