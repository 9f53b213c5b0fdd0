// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/closed_loop.h"

#include "flyball/flight/perception/perception_nodes.h"

#include "scenario/scenario_edge.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto energy_period = 10ms;      // Power changes with rotor lag (tens of ms).
constexpr auto navigation_period = 10ms;  // 100 Hz: what an autopilot streams.
constexpr double navigation_hz = 100.0;
constexpr double hover_below_m_s = 0.1;

Vec3 start_position(const World& world, const Airframe& airframe) {
  return world.start_W + Vec3::UnitZ() * (0.5 * airframe.body_height_m);
}

WindSpec wind_spec(const VehicleSettings& settings) {
  return {{settings.wind_east_m_s, settings.wind_north_m_s, 0.0}, settings.gust_wind_m_s};
}

/// A colour camera hangs on one.
std::optional<GimbalSpec> gimbal_of(const ColourCameras& cameras) {
  return cameras.gimbal ? std::optional{GimbalSpec{}} : std::nullopt;
}

std::unique_ptr<Pilot> make_pilot(Vehicle& vehicle,
                                  const SimulatedThings& things,
                                  double max_acceleration_m_s2,
                                  const EventQueue& queue,
                                  AutopilotLink* autopilot) {
  const double ground_z_m = things.world.ground_z_m;
  return autopilot != nullptr
             ? make_offboard_pilot(vehicle, things.airframe,
                                   {Vec3::Zero(), ground_z_m, max_acceleration_m_s2}, queue,
                                   *autopilot)
             : make_simulated_pilot(vehicle, things.airframe, ground_z_m, queue);
}

/// Whether a navigation sample brings a fix: the first one does, and then as many as fall due, each
/// with the next sample. A product and a quotient of whole numbers round nothing.
bool brings_fix(std::uint64_t sample, double rate_hz) {
  const auto due = [rate_hz](std::uint64_t samples) {
    return std::floor(static_cast<double>(samples) * rate_hz / navigation_hz);
  };
  return sample == 0 || due(sample) > due(sample - 1);
}

ImuSpec imu_spec(const Airframe& airframe, const Vehicle& vehicle) {
  ImuSpec spec;
  spec.hover_rev_s = airframe.hover_rev_s(vehicle.carried_kg());
  return spec;
}

double start_yaw(const World& world) {
  return yaw_of(world.goal_W - world.start_W);
}

}  // namespace

ClosedLoop::ClosedLoop(MissionLink& link,
                       const Scenario& scenario,
                       const SimulatedThings& things,
                       Executor& executor,
                       EventQueue& queue,
                       const VehicleTopics& topics,
                       std::shared_ptr<Localizer> localizer,
                       AutopilotLink* autopilot)
    : link_{link},
      scenario_{scenario},
      airframe_{things.airframe},
      executor_{executor},
      queue_{queue},
      topics_{topics},
      localizer_{std::move(localizer)},
      vehicle_{things.airframe,
               scenario.vehicle.payload_kg,
               {start_position(things.world, things.airframe), start_yaw(things.world),
                things.world.ground_z_m},
               gimbal_of(things.cameras)},
      pilot_{
          make_pilot(vehicle_, things, scenario.mission.max_acceleration_m_s2, queue, autopilot)},
      regression_{things.airframe},
      battery_{things.airframe.battery_cells, things.airframe.battery_ah,
               scenario.vehicle.battery_charge},
      cameras_{scenario, things, executor, queue, topics},
      gps_{scenario.gps, things.origin, scenario.seed},
      barometer_{scenario.barometer, things.origin.height_m, scenario.seed},
      imu_{imu_spec(things.airframe, vehicle_), scenario.seed},
      wind_{wind_spec(scenario.vehicle), scenario.seed} {}

void ClosedLoop::hear_localizer(Topic<PoseEstimate> pose,
                                std::optional<Topic<LocalizationStatus>> status) {
  frame_.emplace();
  if (status) {
    executor_.subscribe<LocalizationStatus>(
        *status, [this](const LocalizationStatus& seen) { is_lost_ = seen.is_lost; });
  }
  executor_.subscribe<PoseEstimate>(pose, [this](const PoseEstimate& where) {
    if (!is_lost_) {
      frame_->localized(where, !is_airborne());
    }
  });
}

void ClosedLoop::start() {
  executor_.subscribe<FlightCommand>(topics_.command,
                                     [this](const FlightCommand& command) { obey(command); });
  executor_.subscribe<Setpoint>(topics_.setpoint, [this](const Setpoint& setpoint) {
    if (link_.phase() == MissionPhase::cruise) {
      pilot_->follow(frame_ ? frame_->in_odometry(setpoint) : setpoint);
    }
  });
  const Duration step = from_seconds(scenario_.vehicle.physics_step_s);
  queue_.every(MissionTime{step}, step, EventOrder::physics, [this] { physics_step(); });
  queue_.every(MissionTime{energy_period}, energy_period, EventOrder::sensor,
               [this] { energy_step(); });
  queue_.every(MissionTime{navigation_period}, navigation_period, EventOrder::sensor,
               [this] { publish_navigation(); });
  cameras_.start(vehicle_);
  if (cameras_.has_gimbal()) {
    executor_.subscribe<GimbalAngles>(topics_.gimbal,
                                      [this](const GimbalAngles& angles) { vehicle_.aim(angles); });
  }
  start_localizer();
}

/// It is told where the vehicle stands.
void ClosedLoop::start_localizer() {
  localizer_->set_initial_pose(vehicle_.state().X_WB);
  if (topics_.imu) {
    const Duration interval = from_seconds(1.0 / ImuSpec{}.rate_hz);
    queue_.every(MissionTime{interval}, interval, EventOrder::sensor, [this] {
      executor_.publish(*topics_.imu, imu_.sample(vehicle_.state(), queue_.now()));
    });
  }
}

Watts ClosedLoop::computer_power(double busy_cores) const {
  const Watts measured = computer_meter_ ? computer_meter_() : Watts{};
  return measured.value() > 0.0
             ? measured
             : link_.brief().platform->power(executor_.operating_point(), busy_cores);
}

Watts ClosedLoop::device_power(double dt_s) {
  const DeviceUse use = executor_.device_use();
  const double computes = (use.gpu_s - last_use_.gpu_s) / dt_s;
  const double sends = (use.sending_s - last_use_.sending_s) / dt_s;
  const double receives = (use.receiving_s - last_use_.receiving_s) / dt_s;
  last_use_ = use;
  const Watts gpu{computes * link_.brief().platform->gpu_power().value()};
  if (!has_edge(scenario_)) {
    return gpu;
  }
  const EdgeSettings& radio = scenario_.edge;
  return gpu + Watts{radio.radio_idle_w + sends * (radio.radio_send_w - radio.radio_idle_w) +
                     receives * (radio.radio_receive_w - radio.radio_idle_w)};
}

void ClosedLoop::physics_step() {
  pilot_->step(scenario_.vehicle.physics_step_s, wind_.velocity_W());
  if (frame_) {
    frame_->note(queue_.now(), vehicle_.state().X_WB);
  }
  watch_pilot();
}

void ClosedLoop::watch_pilot() {
  const std::string failure = pilot_->failure();
  if (!failure.empty() && !pilot_has_failed_) {
    pilot_has_failed_ = true;
    link_.event(failure);
    link_.finish(MissionStatus::failed, MissionFailure::autopilot);
  }
}

double ClosedLoop::rotor_power_w(const std::optional<ReportedBattery>& battery, double dt_s) {
  if (battery) {
    log_.reported_battery = battery;
    return std::max(0.0, battery->power.value() - log_.computer_w);
  }
  return scenario_.vehicle.rotor_power == "thrust"
             ? thrust_power_w(vehicle_, scenario_.vehicle.drive_efficiency)
             : regression_.update(vehicle_.state(), vehicle_.carried_kg(), wind_.velocity_W(),
                                  dt_s);
}

void ClosedLoop::energy_step() {
  const double dt_s = to_seconds(Duration{energy_period});
  const VehicleState& state = vehicle_.state();
  // As often as power: the shortest gusts are 3 m long, .2 s at 15 m/s.
  wind_.advance(dt_s, state.X_WB.translation().z() - link_.brief().site.ground_z_m, state.v_WB);
  const double busy_core_s = executor_.busy_core_s();
  const double busy = (busy_core_s - last_busy_core_s_) / dt_s;
  last_busy_core_s_ = busy_core_s;
  log_.computer_w = (computer_power(busy) + device_power(dt_s)).value();
  const auto measured = pilot_->battery();
  log_.rotor_w = rotor_power_w(measured, dt_s);
  log_.energy_rotor_j += log_.rotor_w * dt_s;
  log_.energy_computer_j += log_.computer_w * dt_s;
  battery_.draw(log_.rotor_w + log_.computer_w, dt_s);
  const double speed = state.v_WB.norm();
  log_.distance_m += speed * dt_s;
  if (link_.phase() != MissionPhase::take_off && link_.phase() != MissionPhase::land) {
    log_.max_speed_m_s = std::max(log_.max_speed_m_s, speed);
  }
  if (is_airborne()) {
    log_.airborne_s += dt_s;
    log_.hover_time_s += speed < hover_below_m_s ? dt_s : 0.0;
    log_.measured_s += measured ? dt_s : 0.0;
  }
  if (on_energy_) {
    on_energy_(dt_s);
  }
}

void ClosedLoop::publish_navigation() {
  // Poses of a vehicle whose place nobody knows must stop coming: what flies brakes then.
  if (pilot_->knows_pose()) {
    publish_pose();
  }
  executor_.publish(topics_.status, pilot_->status());
}

void ClosedLoop::publish_pose() {
  const bool with_fix = brings_fix(navigation_count_++, scenario_.gps.rate_hz);
  NavigationSample sample = gps_.sample(vehicle_.state(), queue_.now(), with_fix);
  sample.pressure_pa = barometer_.sample(vehicle_.state().X_WB.translation().z(), queue_.now());
  const TruePose truth{queue_.now(), vehicle_.state().X_WB, vehicle_.state().v_WB};
  if (on_navigation_) {
    on_navigation_(truth);
  }
  if (topics_.true_pose) {
    executor_.publish(*topics_.true_pose, truth);
  }
  executor_.publish(topics_.navigation, sample);
}

void ClosedLoop::obey(const FlightCommand& command) {
  if (command.kind == FlightCommand::Kind::release_payload) {
    vehicle_.set_payload(0.0);
    imu_.set_hover(airframe_.hover_rev_s(vehicle_.carried_kg()));
  }
  pilot_->obey(command);
}

}  // namespace flyball
