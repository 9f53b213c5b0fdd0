// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/legs.h"

namespace flyball {
namespace {

using namespace std::chrono_literals;

// Chosen: by then the flight controller has heard the command, and its status is newer than that.
constexpr auto settling = 500ms;

}  // namespace

void Legs::declare(NodeSpec& spec) const {
  spec.reads.push_back(vehicle_.status.index);
  spec.writes.push_back(vehicle_.command.index);
  spec.writes.push_back(mission_.state.index);
}

void Legs::command(JobContext& job, MissionPhase phase, const FlightCommand& command) {
  enter(job, phase);
  job.publish(vehicle_.command, command);
  settled_ = job.now() + settling;
}

void Legs::take_off(JobContext& job, double height_m) {
  command(job, MissionPhase::take_off, {FlightCommand::Kind::take_off, height_m});
}

void Legs::land(JobContext& job) {
  command(job, MissionPhase::land, {FlightCommand::Kind::land, 0.0});
}

void Legs::release_payload(JobContext& job) const {
  job.publish(vehicle_.command, FlightCommand{FlightCommand::Kind::release_payload, 0.0});
}

bool Legs::are_done(JobContext& job) const {
  const auto status = job.latest(vehicle_.status);
  return status && status->manoeuvre_done && job.now() >= settled_;
}

}  // namespace flyball
