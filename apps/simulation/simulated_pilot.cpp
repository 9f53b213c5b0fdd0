// SPDX-License-Identifier: BSD-3-Clause
// tested-in: closed_loop
#include "flyball/sim/flight_controller.h"

#include "simulation/pilot.h"

namespace flyball {
namespace {

/// The simulator's flight controller, and physics.
class SimulatedPilot final : public Pilot {
 public:
  SimulatedPilot(Vehicle& vehicle,
                 const Airframe& airframe,
                 double ground_z_m,
                 const EventQueue& queue)
      : vehicle_{vehicle}, queue_{queue}, controller_{airframe, ground_z_m} {}

  Status prepare(const std::function<bool()>& /*stop*/) override { return Done{}; }

  void step(double dt_s, const Vec3& wind_W) override {
    const RotorSpeeds command =
        controller_.update(vehicle_.state(), vehicle_.mass_kg(), queue_.now(), dt_s);
    vehicle_.step(dt_s, command, wind_W);
  }

  void obey(const FlightCommand& command) override {
    switch (command.kind) {
      case FlightCommand::Kind::take_off:
        controller_.take_off(vehicle_.state(), command.height_m);
        break;
      case FlightCommand::Kind::land:
        controller_.land(vehicle_.state());
        break;
      case FlightCommand::Kind::hold:
        controller_.hold(vehicle_.state());
        break;
      case FlightCommand::Kind::release_payload:
        break;
    }
  }

  void follow(const Setpoint& setpoint) override { controller_.follow(setpoint); }

  [[nodiscard]] FlightStatus status() const override {
    return {controller_.mode() != FlightMode::idle, controller_.is_done(vehicle_.state())};
  }

  [[nodiscard]] bool may_touch_ground() const override {
    return controller_.mode() == FlightMode::take_off || controller_.mode() == FlightMode::land ||
           controller_.mode() == FlightMode::idle;
  }

  [[nodiscard]] bool knows_pose() const override { return true; }
  [[nodiscard]] std::optional<ReportedBattery> battery() const override { return std::nullopt; }
  [[nodiscard]] std::string failure() const override { return {}; }
  void begin_landing() override {}
  void await_landing(const std::function<bool()>& /*turned*/) override {}

 private:
  Vehicle& vehicle_;
  const EventQueue& queue_;
  FlightController controller_;
};

}  // namespace

std::unique_ptr<Pilot> make_simulated_pilot(Vehicle& vehicle,
                                            const Airframe& airframe,
                                            double ground_z_m,
                                            const EventQueue& queue) {
  return std::make_unique<SimulatedPilot>(vehicle, airframe, ground_z_m, queue);
}

}  // namespace flyball
