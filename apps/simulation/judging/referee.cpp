// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/judging/referee.h"

#include "flyball/flight/exploration/exploration_flight.h"
#include "flyball/records/summary.h"

#include "simulation/judging/delivery_judge.h"
#include "simulation/judging/map_judge.h"
#include "simulation/judging/picture_judge.h"
#include "simulation/judging/sighting_judge.h"
#include <algorithm>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto check_period = 10ms;  // At 15 m/s, the vehicle flies 15 cm between two checks.
constexpr auto look_period = 1s;
constexpr auto first_look = 100ms;  // A map that is being made is looked at a little later.

}  // namespace

Referee::Referee(MissionLink& link, const RefereedFlight& flight)
    : link_{link},
      scenario_{flight.scenario},
      things_{flight.things},
      queue_{flight.queue},
      loop_{flight.loop},
      clearance_{flight.things.world},
      min_clearance_m_{farthest_clearance_m} {
  appoint(flight.graph, flight.executor, flight.mapper);
}

void Referee::appoint(const Graph& graph, Executor& executor, const Mapper& mapper) {
  if (const auto pose = graph.find<PoseEstimate>("pose")) {
    auto judge = std::make_unique<LocalizationJudge>(executor, *pose);
    loop_.on_navigation([judge = judge.get()](const TruePose& truth) { judge->note(truth); });
    judges_.push_back(std::move(judge));
  }
  if (const auto command = graph.find<FlightCommand>("flight_command")) {
    judges_.push_back(std::make_unique<DeliveryJudge>(
        executor, *command, link_.brief().site.goal_W,
        [this]() -> Vec3 { return loop_.vehicle().state().X_WB.translation(); }));
  }
  const auto sightings = graph.find<Sightings>("sightings");
  const auto finding = graph.find<Finding>("finding");
  if (sightings && finding) {
    judges_.push_back(std::make_unique<SightingJudge>(link_, things_.world.people, executor,
                                                      SearchTopics{*sightings, *finding}));
  }
  if (graph.find<ExploreQuery>("explore.request")) {
    const double least_percent = sightings ? 0.0 : link_.brief().settings.explore.coverage_percent;
    judges_.push_back(std::make_unique<MapJudge>(link_, mapper, things_.world, least_percent));
  }
  if (const auto target = graph.find<Target>("target")) {
    auto score = std::make_unique<TrackingScore>(link_, things_.world.people);
    loop_.cameras().on_picture([score = score.get()](std::uint64_t sequence, const Pose& X_WC) {
      score->note(sequence, X_WC);
    });
    executor.subscribe<Target>(*target, [this, score = score.get()](const Target& seen) {
      if (link_.phase() == MissionPhase::cruise) {
        score->count(seen);
      }
    });
    judges_.push_back(std::move(score));
  }
  if (const auto pictures = graph.find<GroundPicture>("picture")) {
    judges_.push_back(std::make_unique<PictureJudge>(
        link_, executor, *pictures, [this] { return loop_.vehicle().state().X_WB; }));
  }
}

void Referee::start() {
  for (const auto& judge : judges_) {
    judge->prepare();
  }
  queue_.every(MissionTime{check_period}, check_period, EventOrder::sensor, [this] { check(); });
  queue_.every(MissionTime{first_look}, look_period, EventOrder::observer, [this] {
    for (const auto& judge : judges_) {
      judge->look(queue_.now());
    }
  });
}

void Referee::check() {
  const MissionTime now = queue_.now();
  const Vec3& p_WB = loop_.vehicle().state().X_WB.translation();
  const Cylinder body = things_.airframe.body();
  const double still_m =
      clearance_.distance_m(p_WB, body, farthest_clearance_m, loop_.may_touch_ground());
  const double moving_m = clearance_m(things_.world.movers, now, p_WB, body, still_m);
  const double distance_m = distance_to_people_m(things_.world.people, now, p_WB, body, moving_m);
  if (loop_.is_airborne()) {
    min_clearance_m_ = std::min(min_clearance_m_, distance_m);
  }
  if (distance_m <= 0.0) {
    link_.finish(MissionStatus::failed, MissionFailure::collision);
  }
  if (loop_.battery().is_empty()) {
    link_.finish(MissionStatus::failed, MissionFailure::battery_empty);
  }
  if (to_seconds(now) > scenario_.mission.time_limit_s) {
    link_.finish(MissionStatus::failed, MissionFailure::time_limit);
  }
}

FlightVerdict Referee::verdict() const {
  const MissionEnd end = link_.outcome().value_or(MissionEnd{});
  if (end.status != MissionStatus::succeeded) {
    return {end.status, end.failure};
  }
  for (const auto& judge : judges_) {
    if (const MissionFailure why = judge->objection(); why != MissionFailure::none) {
      return {MissionStatus::failed, why};
    }
  }
  return {MissionStatus::succeeded, MissionFailure::none};
}

std::map<std::string, double> Referee::figures() const {
  std::map<std::string, double> all;
  for (const auto& judge : judges_) {
    all.merge(judge->figures());
  }
  return all;
}

std::vector<MissionFrame> Referee::frames() const {
  std::vector<MissionFrame> all;
  for (const auto& judge : judges_) {
    for (MissionFrame& frame : judge->frames()) {
      all.push_back(std::move(frame));
    }
  }
  return all;
}

}  // namespace flyball
