// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/round_trip.h"

#include "flyball/flight/perception/map_hints.h"
#include "flyball/runtime/assert.h"

#include <algorithm>

namespace flyball {

void RoundTrip::declare(NodeSpec& spec) const {
  spec.writes.push_back(perception_.map_hints.index);
  legs_.declare(spec);
  guidance_.declare(spec);
  declare_log(spec, mission_);
}

RoundTrip::Landed RoundTrip::step(JobContext& job, const PoseEstimate& pose) {
  switch (stage_) {
    case Stage::ready:
      take_off(job, pose);
      break;
    case Stage::climbing:
      if (legs_.are_done(job)) {
        depart(job);
      }
      break;
    case Stage::flying:
      if (has_arrived(job)) {
        land(job);
      }
      break;
    case Stage::landing:
      if (legs_.are_done(job)) {
        stage_ = Stage::landed;
        return leg_ == Leg::out ? Landed::at_goal : Landed::at_home;
      }
      break;
    case Stage::landed:
      break;
  }
  return Landed::no;
}

void RoundTrip::go_home() {
  FLYBALL_ASSERT(stage_ == Stage::landed && leg_ == Leg::out, "stage %d", static_cast<int>(stage_));
  leg_ = Leg::back;
  stage_ = Stage::ready;
}

double RoundTrip::nearer_m(const Vec3& p_W) {
  const double leg_m = (brief_->site.goal_W - brief_->site.start_W).norm();
  const double flown_m = leg_m - (above(end_W()) - p_W).norm();
  nearer_m_ = std::max(nearer_m_, flown_m + (leg_ == Leg::back ? leg_m : 0.0));
  return nearer_m_;
}

bool RoundTrip::has_arrived(JobContext& job) const {
  const auto navigator = guidance_.state(job);
  return navigator && navigator->has_arrived &&
         navigator->tracking_error.size_m < brief_->arrival_error_m();
}

Vec3 RoundTrip::above(const Vec3& ground_W) const {
  return ground_W + Vec3::UnitZ() * brief_->site.cruise_height_m;
}

/// Start and goal may be one place. There is no path between them, so none is asked for.
bool RoundTrip::is_at_goal() const {
  const double apart_m = (brief_->site.goal_W - brief_->site.start_W).norm();
  return apart_m < brief_->settings.mission.goal_tolerance_m;
}

const Vec3& RoundTrip::begin_W() const {
  return leg_ == Leg::out ? brief_->site.start_W : brief_->site.goal_W;
}

const Vec3& RoundTrip::end_W() const {
  return leg_ == Leg::out ? brief_->site.goal_W : brief_->site.start_W;
}

void RoundTrip::take_off(JobContext& job, const PoseEstimate& pose) {
  const Site& places = brief_->site;
  job.publish(perception_.map_hints,
              MapHint{clear_over(places.start_W, places.start_clear_m, places.clear_height_m)});
  job.publish(perception_.map_hints,
              MapHint{clear_over(places.goal_W, places.goal_clear_m, places.clear_height_m)});
  guidance_.hover_at(job, above(begin_W()), yaw_of(pose.X_WB.linear().col(0)));
  legs_.take_off(job, places.cruise_height_m);
  stage_ = Stage::climbing;
}

void RoundTrip::depart(JobContext& job) {
  if (is_at_goal()) {
    land(job);
    return;
  }
  guidance_.go_to(job, above(end_W()));
  legs_.enter(job, MissionPhase::cruise);
  stage_ = Stage::flying;
  log_event(job, mission_, leg_ == Leg::out ? "outbound" : "homebound");
}

void RoundTrip::land(JobContext& job) {
  guidance_.give_up_goal(job);
  legs_.land(job);
  stage_ = Stage::landing;
}

}  // namespace flyball
