// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/studies/energy_bound.h"

#include "flyball/runtime/guard.h"
#include "flyball/sim/rotor_power.h"

#include "simulation/mission_setup.h"
#include "studies/path_cells.h"
#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

// A vehicle has arrived within .3 m of the goal and .1 m of the reference. This holds at both ends
// of a leg.
constexpr double off_the_ends_m = 1.0;

/// In steady level flight; a lower limit of the mean over any flight at this speed.
class LeastPower {
 public:
  LeastPower(const Scenario& scenario, const Airframe& airframe, const Platform& platform)
      : settings_{scenario.vehicle},
        airframe_{airframe},
        computer_w_{platform.power({1, platform.frequencies().front()}, 0.0).value()} {}

  [[nodiscard]] double watts(double speed_m_s, double payload_kg) const {
    return computer_w_ +
           (settings_.rotor_power == "thrust" ? hover_w(payload_kg) : eq1_w(speed_m_s, payload_kg));
  }

 private:
  [[nodiscard]] double eq1_w(double speed_m_s, double payload_kg) const {
    RegressionPower power{airframe_};
    VehicleState state;
    state.v_WB = {speed_m_s, 0.0, 0.0};
    state.rotor_rev_s = {100.0, 100.0, 100.0, 100.0};
    // b8 counts the wind along the path; the bound takes the cheaper direction.
    const double wind_m_s = std::hypot(settings_.wind_east_m_s, settings_.wind_north_m_s);
    return std::min(power.update(state, payload_kg, {wind_m_s, 0.0, 0.0}, 1.0),
                    power.update(state, payload_kg, {-wind_m_s, 0.0, 0.0}, 1.0));
  }
  [[nodiscard]] double hover_w(double payload_kg) const {
    const double thrust_n = 0.25 * (airframe_.mass_kg + payload_kg) * gravity_m_s2;
    const double rev_s = std::sqrt(thrust_n / airframe_.thrust_per_n2());
    return 4.0 * airframe_.power_per_n3() * std::pow(rev_s, 3) / settings_.drive_efficiency;
  }

  VehicleSettings settings_;
  Airframe airframe_;
  double computer_w_;
};

/// Eq. 2 with the longest range free and the least latency.
double fastest_m_s(const Scenario& scenario, const MissionSetup& setup) {
  Work pixels;
  const DepthCameraSpec& camera = scenario.camera;
  pixels.add("pixels", static_cast<double>(camera.count) * camera.width_px * camera.height_px);
  const GuardSettings guard = guard_settings(flight_settings(scenario));
  const Duration least =
      Guard{guard}.reaction_time() + setup.platform->job_time(scenario.kernels.point_cloud, pixels,
                                                              setup.platform->frequencies().back());
  const KnobSpec* range = setup.equipment.knobs.spec("map.range_m");
  return std::min(scenario.mission.max_speed_m_s,
                  safe_speed(scenario.mission.max_acceleration_m_s2, to_seconds(least),
                             range->max - setup.equipment.body.radius_m));
}

/// The least of the zones that hold all of a cell, from its floor to its ceiling.
double zone_limit_m_s(const World& world, const Aabb& cell_W, double limit_m_s) {
  // A vehicle compares its speed with the limit once in each step, so it may be late by one step.
  constexpr double border_m = 0.25;
  const Vec3 border{border_m, border_m, 0.0};
  const Vec3 low_W = (cell_W.min - border).cwiseMax(world.bounds_W.min);
  const Vec3 high_W = (cell_W.max + border).cwiseMin(world.bounds_W.max);
  for (const SpeedZone& zone : world.zones) {
    if (zone.box_W.contains(low_W) && zone.box_W.contains(high_W)) {
      limit_m_s = std::min(limit_m_s, zone.max_speed_m_s);
    }
  }
  return limit_m_s;
}

double slowest_m_s(const World& world, double limit_m_s) {
  for (const SpeedZone& zone : world.zones) {
    limit_m_s = std::min(limit_m_s, zone.max_speed_m_s);
  }
  return limit_m_s;
}

/// @param end_j  The most energy that a flight saves by coming only near to the ends of the leg.
Result<BoundedLeg> bound_leg(const std::optional<CheapestPath>& path, double end_j) {
  if (!path) {
    return Error{ErrorCode::failed, "no path leads from start to goal in this world"};
  }
  return BoundedLeg{std::max(0.0, path->cost - end_j),
                    std::max(0.0, path->length_m - off_the_ends_m)};
}

}  // namespace

double EnergyBound::energy_j() const {
  double sum = 0.0;
  for (const BoundedLeg& leg : legs) {
    sum += leg.energy_j;
  }
  return sum;
}

namespace {

/// The search holds 17 bytes for each of its cells of .25 m: 1.7 GB at most.
Status check_size(const World& world) {
  constexpr double most_km2 = 6.25;
  const Vec3 size_m = world.bounds_W.max - world.bounds_W.min;
  const double km2 = size_m.x() * size_m.y() * 1e-6;
  if (km2 > most_km2) {
    return Error{ErrorCode::invalid_input,
                 "a bound is known for worlds of at most 6.25 km2, and this one has " +
                     std::to_string(km2) + "; make it smaller, or crop its file"};
  }
  return Done{};
}

}  // namespace

Result<EnergyBound> bound_energy(const Scenario& scenario) {
  if (scenario.mission.workload != "package_delivery") {
    return Error{ErrorCode::invalid_input,
                 "a bound is known for workload package_delivery only, and \"" + scenario.name +
                     "\" has " + scenario.mission.workload};
  }
  if (scenario.vehicle.gust_wind_m_s > 0.0) {
    return Error{ErrorCode::invalid_input,
                 "a bound is known without gusts only: set vehicle.gust_wind_m_s to 0"};
  }
  const auto setup = set_up_without_governor(scenario);
  if (!setup) {
    return setup.error();
  }
  const World& world = setup->things.world;
  if (const Status small = check_size(world); !small) {
    return small.error();
  }
  const Airframe& airframe = setup->things.airframe;
  const LeastPower power{scenario, airframe, *setup->platform};
  const double fastest = fastest_m_s(scenario, *setup);
  const PathCells cells{world, airframe.body()};
  EnergyBound bound;
  for (const bool is_out : {true, false}) {
    const double payload_kg = is_out ? scenario.vehicle.payload_kg : 0.0;
    const auto joules_per_m = [&](double v_m_s) { return power.watts(v_m_s, payload_kg) / v_m_s; };
    const PathPrice price{
        [&](const Aabb& cell_W) { return joules_per_m(zone_limit_m_s(world, cell_W, fastest)); },
        joules_per_m(fastest)};
    const auto leg = bound_leg(cells.path(is_out ? world.start_W : world.goal_W,
                                          is_out ? world.goal_W : world.start_W, price),
                               off_the_ends_m * joules_per_m(slowest_m_s(world, fastest)));
    if (!leg) {
      return leg.error();
    }
    bound.legs.push_back(*leg);
  }
  return bound;
}

std::string to_json(const EnergyBound& bound, const Scenario& scenario) {
  nlohmann::ordered_json legs = nlohmann::ordered_json::array();
  for (const BoundedLeg& leg : bound.legs) {
    legs.push_back({{"energy_j", leg.energy_j}, {"length_m", leg.length_m}});
  }
  const nlohmann::ordered_json json{{"scenario", scenario.name},
                                    {"seed", scenario.seed},
                                    {"energy_j", bound.energy_j()},
                                    {"legs", legs}};
  return json.dump(2);
}

}  // namespace flyball
