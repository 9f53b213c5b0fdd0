// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/pilot.h"
#include <cmath>

namespace flyball {
namespace {

/// An autopilot on the other end of a line. The simulated vehicle is put where it reports the real
/// one, so that cameras, sensors, power and the referee go by that.
class OffboardPilot final : public Pilot {
 public:
  OffboardPilot(Vehicle& vehicle,
                const Airframe& airframe,
                const FlightStart& start,
                const EventQueue& queue,
                AutopilotLink& autopilot)
      : vehicle_{vehicle},
        airframe_{airframe},
        start_{start},
        queue_{queue},
        autopilot_{autopilot} {}

  Status prepare(const std::function<bool()>& stop) override {
    start_.p_WB = vehicle_.state().X_WB.translation();
    if (Status connected = autopilot_.connect(start_, stop); !connected) {
      return connected;
    }
    place(0.0);
    return Done{};
  }

  void step(double dt_s, const Vec3& /*wind_W*/) override {
    autopilot_.step(queue_.now());
    place(dt_s);
  }

  void obey(const FlightCommand& command) override { autopilot_.obey(command); }
  void follow(const Setpoint& setpoint) override { autopilot_.follow(setpoint); }
  [[nodiscard]] FlightStatus status() const override { return autopilot_.status(); }
  [[nodiscard]] bool may_touch_ground() const override { return autopilot_.may_touch_ground(); }
  [[nodiscard]] bool knows_pose() const override { return autopilot_.motion().is_fresh; }
  [[nodiscard]] std::optional<ReportedBattery> battery() const override {
    return autopilot_.battery();
  }
  [[nodiscard]] std::string failure() const override { return autopilot_.failure(); }
  void begin_landing() override { autopilot_.begin_landing(); }
  void await_landing(const std::function<bool()>& turned) override {
    autopilot_.await_landing(turned);
  }

 private:
  void place(double dt_s) {
    const ReportedMotion seen = autopilot_.motion();
    vehicle_.place(dt_s, {seen.X_WB, seen.v_WB, seen.w_WB_B, seen.a_WB, rotors_for(seen)});
  }

  /// Models of power ask for the rotors' speeds, which nobody reports: those whose thrust carries
  /// the vehicle and gives it its acceleration. Drag, and wind with it, are left out.
  [[nodiscard]] RotorSpeeds rotors_for(const ReportedMotion& seen) const {
    if (!seen.rotors_turn) {
      return {};
    }
    const Vec3 lifted = seen.a_WB + gravity_m_s2 * Vec3::UnitZ();
    const double thrust_n = vehicle_.mass_kg() * lifted.norm();
    const double each = std::sqrt(thrust_n / (4.0 * airframe_.thrust_per_n2()));
    return {each, each, each, each};
  }

  Vehicle& vehicle_;
  const Airframe& airframe_;
  FlightStart start_;
  const EventQueue& queue_;
  AutopilotLink& autopilot_;
};

}  // namespace

std::unique_ptr<Pilot> make_offboard_pilot(Vehicle& vehicle,
                                           const Airframe& airframe,
                                           const FlightStart& start,
                                           const EventQueue& queue,
                                           AutopilotLink& autopilot) {
  return std::make_unique<OffboardPilot>(vehicle, airframe, start, queue, autopilot);
}

}  // namespace flyball
