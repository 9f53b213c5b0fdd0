// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/exploration/exploration_flight.h"

#include "flyball/runtime/random.h"

#include <cmath>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr double facing_rad = 0.05;
constexpr int most_failures = 3;     // Plans in a row: the view cannot be got to.
constexpr double patience_s = 40.0;  // Standing on the way to a view, for whatever reason.

}  // namespace

ExploreRequest explore_request(const MissionContext& context, const Viewpoint& from) {
  const Intrinsics camera = context.settings.camera.intrinsics();
  ExploreRequest request;
  request.from = from;
  request.volume_W = context.brief.volume_W;
  request.bounds_W = context.brief.bounds_W;
  request.body = context.narrow_body();
  request.settings = context.settings.explore;
  request.field.horizontal_rad = 2.0 * std::atan(0.5 * camera.width_px / camera.focal_px);
  request.field.vertical_rad = 2.0 * std::atan(0.5 * camera.height_px / camera.focal_px);
  request.field.range_m = request.settings.gain_range_m;
  return request;
}

Status check_volume(const MissionBrief& brief) {
  if ((brief.volume_W.max - brief.volume_W.min).minCoeff() <= 0.0) {
    return Error{ErrorCode::invalid_input,
                 "world \"" + brief.place +
                     "\" has no volume to explore; set world.generator to \"office\""};
  }
  return Done{};
}

ExplorationFlight::ExplorationFlight(MissionContext& context, Navigator& navigator)
    : context_{context}, navigator_{navigator} {}

void ExplorationFlight::add_nodes(Graph& graph,
                                  const VehicleTopics& vehicle,
                                  const PerceptionTopics& perception) {
  legs_.emplace(context_, vehicle);
  perception_ = perception;
  explore_ = graph.service<ExploreQuery, ExploreAnswer>("explore");
  NodeSpec spec;
  spec.name = "explore";
  spec.cost = context_.settings.kernels.explorer;
  spec.trigger = OnMessage{explore_.request.index};
  spec.priority = 15;
  spec.deadline = 30s;
  spec.writes = {explore_.response.index};
  graph.node(std::move(spec), [this](JobContext& job) {
    const auto query = job.take(explore_.request);
    if (!query) {
      return Work{};
    }
    ExploreStep step = context_.kernels.explorer->explore(query->request, context_.map());
    Work work = step.work;
    job.publish(explore_.response, ExploreAnswer{query->id, std::move(step)});
    return work;
  });
}

void ExplorationFlight::declare(NodeSpec& spec) const {
  for (const int topic : {perception_.pose.index, perception_.map.index, explore_.response.index}) {
    spec.reads.push_back(topic);
  }
  legs_->declare(spec);
  spec.writes.push_back(explore_.request.index);
}

void ExplorationFlight::step(JobContext& job) {
  const auto pose = job.latest(perception_.pose);
  if (pose && !context_.is_over()) {
    advance(job, *pose);
  }
}

void ExplorationFlight::advance(JobContext& job, const PoseEstimate& pose) {
  switch (stage_) {
    case Stage::ready:
      take_off(job, pose);
      break;
    case Stage::climbing:
      if (legs_->are_done(job)) {
        context_.phase = MissionPhase::cruise;
        await_map(job.now());
      }
      break;
    case Stage::mapping:
      think(job);
      break;
    case Stage::thinking:
      take_answer(job);
      break;
    case Stage::flying:
      watch_flight(job);
      break;
    case Stage::turning:
      watch_turn(job.now());
      break;
    case Stage::landing:
      state_ = legs_->are_done(job) ? State::landed : state_;
      break;
  }
}

void ExplorationFlight::take_off(JobContext& job, const PoseEstimate& pose) {
  declare_clear_over(*context_.kernels.mapper, context_.brief.start_W);
  const double height_m = context_.brief.cruise_height_m;
  navigator_.hover_at(context_.brief.start_W + Vec3::UnitZ() * height_m,
                      yaw_of(pose.X_WB.linear().col(0)));
  legs_->take_off(job, height_m);
  stage_ = Stage::climbing;
  since_ = job.now();
}

void ExplorationFlight::await_map(MissionTime now) {
  stage_ = Stage::mapping;
  since_ = now;
}

/// Asks for the next view as soon as a frame that was taken at rest is in the map.
void ExplorationFlight::think(JobContext& job) {
  const auto revision = job.latest(perception_.map);
  if (!revision || revision->captured < since_) {
    return;
  }
  const PathFollower& follower = navigator_.follower();
  ExploreQuery query;
  query.id = ++asked_;
  query.request = explore_request(context_, {follower.position_W(), follower.yaw_rad()});
  query.request.taken = taken_;
  query.request.unreachable_W = unreachable_W_;
  query.request.seed = RandomStream{context_.settings.seed, "explorer", query.id}.next();
  job.publish(explore_.request, std::move(query));
  stage_ = Stage::thinking;
  since_ = job.now();
}

void ExplorationFlight::take_answer(JobContext& job) {
  const auto answer = job.take(explore_.response);
  if (!answer || answer->id != asked_) {
    return;
  }
  const ExploreStep& step = answer->step;
  context_.recorder.record(job.now(), "explore",
                           {{"found", static_cast<std::int64_t>(step.next.has_value())},
                            {"gain_m3", step.gain_m3},
                            {"far", static_cast<std::int64_t>(step.is_far)},
                            {"x_m", step.next ? step.next->p_W.x() : 0.0},
                            {"y_m", step.next ? step.next->p_W.y() : 0.0},
                            {"z_m", step.next ? step.next->p_W.z() : 0.0}});
  if (!step.next) {
    state_ = State::exhausted;
    return;
  }
  view_ = *step.next;
  navigator_.face(view_.yaw_rad);
  context_.counters.planner_failures_in_row = 0;
  navigator_.set_goal(job.now(), view_.p_W);
  stage_ = Stage::flying;
  since_ = job.now();
}

void ExplorationFlight::watch_flight(JobContext& job) {
  const PathFollower& follower = navigator_.follower();
  const bool is_there =
      (follower.position_W() - context_.goal_now_W).norm() < 0.3 && follower.stands_still();
  if (is_there && navigator_.tracking_error().size_m < 0.1) {
    navigator_.clear_goal();
    if (state_ == State::homing) {
      land(job);
    } else {
      stage_ = Stage::turning;
    }
    return;
  }
  if (follower.speed_m_s() > 0.05) {
    since_ = job.now();
  }
  const bool is_stuck =
      to_seconds(job.now() - since_) > patience_s ||
      (follower.speed_m_s() == 0.0 && context_.counters.planner_failures_in_row >= most_failures);
  if (is_stuck && state_ == State::exploring) {
    give_up_view(job.now());
  }
}

void ExplorationFlight::give_up_view(MissionTime now) {
  context_.event(now, "view given up");
  navigator_.clear_goal();
  unreachable_W_.push_back(view_.p_W);
  await_map(now);
}

void ExplorationFlight::watch_turn(MissionTime now) {
  if (std::abs(wrap_angle(navigator_.follower().yaw_rad() - view_.yaw_rad)) < facing_rad) {
    taken_.push_back(view_);
    await_map(now);
  }
}

void ExplorationFlight::go_home(MissionTime now) {
  state_ = State::homing;
  stage_ = Stage::flying;
  since_ = now;
  navigator_.face(std::nullopt);
  navigator_.set_goal(now, context_.brief.start_W + Vec3::UnitZ() * context_.brief.cruise_height_m);
  context_.event(now, "homebound");
}

void ExplorationFlight::land(JobContext& job) {
  legs_->land(job);
  stage_ = Stage::landing;
  since_ = job.now();
}

}  // namespace flyball
