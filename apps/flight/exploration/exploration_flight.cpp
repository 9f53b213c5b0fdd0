// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/exploration/exploration_flight.h"

#include "flyball/runtime/random.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

using namespace std::chrono_literals;

// Chosen by hand.
constexpr double there_m = 0.3;      // Near enough to a view, ...
constexpr double facing_rad = 0.05;  // ... and turned this near to its heading.
constexpr double moving_m_s = 0.05;
constexpr int most_failures = 3;     // After so many failed plans in a row a view is given up, ...
constexpr double patience_s = 40.0;  // ... or after standing for so long before it is reached.
// With a view and one to each side of it, a camera of 90 degrees sees most of what is around.
constexpr double third_rad = 2.0943951023931953;

}  // namespace

ExploreRequest explore_request(const Brief& brief, const Viewpoint& from) {
  const Intrinsics camera = brief.settings.camera.intrinsics();
  ExploreRequest request;
  request.from = from;
  request.volume_W = brief.site.volume_W;
  request.bounds_W = brief.site.bounds_W;
  request.body = brief.narrow_body();
  request.settings = brief.settings.explore;
  request.field.horizontal_rad = 2.0 * std::atan(0.5 * camera.width_px / camera.focal_px);
  request.field.vertical_rad = 2.0 * std::atan(0.5 * camera.height_px / camera.focal_px);
  request.field.range_m = request.settings.gain_range_m;
  request.field.pitch_down_rad = brief.settings.camera.pitch_down_rad;
  request.field.forward_m = brief.settings.camera.forward_m;
  request.field.up_m = brief.settings.camera.up_m;
  return request;
}

Status check_volume(const Site& site) {
  if ((site.volume_W.max - site.volume_W.min).minCoeff() <= 0.0) {
    return Error{
        ErrorCode::invalid_input,
        "world \"" + site.place + "\" has no volume to explore; set world.generator to \"office\""};
  }
  return Done{};
}

ExplorationFlight::ExplorationFlight(Graph& graph, const FlightParts& parts)
    : parts_{parts},
      perception_{add_perception(graph, parts)},
      guidance_{add_navigation(graph, parts, perception_).guidance},
      legs_{parts.vehicle, parts.mission},
      explore_{graph.service<ExploreQuery, ExploreAnswer>("explore")} {
  add_explore(graph);
}

void ExplorationFlight::add_explore(Graph& graph) {
  NodeSpec spec;
  spec.name = "explore";
  spec.cost = parts_.brief->settings.kernels.explorer;
  spec.trigger = OnMessage{explore_.request.index};
  spec.priority = 15;
  spec.deadline = 30s;
  spec.threads = Explorer::most_threads;
  spec.reads = {perception_.map.index, parts_.mission.knobs.index};
  spec.writes = {explore_.response.index};
  graph.node(std::move(spec), [service = explore_, map = perception_.map, mission = parts_.mission,
                               explorer = parts_.kernels.explorer](JobContext& job) {
    const auto query = job.take(service.request);
    const auto revision = job.latest(map);
    const auto knobs = job.latest(mission.knobs);
    if (!query || !revision || !knobs) {
      return Work{};
    }
    explorer->apply(knobs->knobs);
    ExploreRequest request = query->request;
    request.settings.iterations = static_cast<int>(knobs->value("explore.iterations"));
    request.settings.threads = static_cast<int>(knobs->value("explore.threads"));
    ExploreStep step = explorer->explore(request, *revision->map);
    Work work = step.work;
    work.shared_among(request.settings.threads);
    job.publish(service.response, ExploreAnswer{query->id, std::move(step)});
    return work;
  });
}

void ExplorationFlight::declare(NodeSpec& spec) const {
  for (const int topic :
       {perception_.localization.pose.index, perception_.map.index, explore_.response.index}) {
    spec.reads.push_back(topic);
  }
  legs_.declare(spec);
  guidance_.declare(spec);
  declare_log(spec, parts_.mission);
  spec.writes.push_back(explore_.request.index);
  spec.writes.push_back(perception_.map_hints.index);
}

Vec3 ExplorationFlight::above_start_W() const {
  const Site& site = parts_.brief->site;
  return site.start_W + Vec3::UnitZ() * site.cruise_height_m;
}

void ExplorationFlight::step(JobContext& job) {
  if (const auto pose = job.latest(perception_.localization.pose)) {
    advance(job, *pose);
  }
}

void ExplorationFlight::advance(JobContext& job, const PoseEstimate& pose) {
  switch (stage_) {
    case Stage::ready:
      take_off(job, pose);
      break;
    case Stage::climbing:
      if (legs_.are_done(job)) {
        legs_.enter(job, MissionPhase::cruise);
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
      watch_turn(job);
      break;
    case Stage::landing:
      state_ = legs_.are_done(job) ? State::landed : state_;
      break;
  }
}

void ExplorationFlight::take_off(JobContext& job, const PoseEstimate& pose) {
  const Site& site = parts_.brief->site;
  job.publish(perception_.map_hints,
              MapHint{clear_over(site.start_W, site.start_clear_m, site.clear_height_m)});
  guidance_.hover_at(job, above_start_W(), yaw_of(pose.X_WB.linear().col(0)));
  legs_.take_off(job, parts_.brief->site.cruise_height_m);
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
  const auto navigator = guidance_.state(job);
  if (!revision || revision->captured < since_ || !navigator) {
    return;
  }
  if (looks_again_) {
    fly_to_next_view_again(job, navigator->position_W);
    return;
  }
  ExploreQuery query;
  query.id = ++asked_;
  query.request = explore_request(*parts_.brief, {navigator->position_W, navigator->yaw_rad});
  query.request.taken = taken_;
  query.request.unreachable_W = unreachable_W_;
  query.request.seed = RandomStream{parts_.brief->settings.seed, "explorer", query.id}.next();
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
  log(job, parts_.mission, "explore",
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
  fly_to(job, *step.next);
}

void ExplorationFlight::fly_to(JobContext& job, const Viewpoint& view) {
  view_ = view;
  guidance_.go_to_view(job, view_.p_W, view_.yaw_rad);
  stage_ = Stage::flying;
  since_ = job.now();
}

bool ExplorationFlight::takes_view(JobContext& job) const {
  const bool explores = state_ == State::exploring && stage_ >= Stage::mapping;
  return explores && guidance_.state(job);
}

bool ExplorationFlight::look_again() {
  if (looks_again_ || taken_.empty()) {
    return false;
  }
  for (const Viewpoint& view : taken_) {
    for (const double turn_rad : {third_rad, -third_rad}) {
      again_.push_back({view.p_W, wrap_angle(view.yaw_rad + turn_rad)});
    }
  }
  looks_again_ = true;
  state_ = State::exploring;
  stage_ = Stage::mapping;
  return true;
}

void ExplorationFlight::fly_to_next_view_again(JobContext& job, const Vec3& from_W) {
  const auto nearest =
      std::min_element(again_.begin(), again_.end(), [&](const Viewpoint& a, const Viewpoint& b) {
        return (a.p_W - from_W).squaredNorm() < (b.p_W - from_W).squaredNorm();
      });
  if (nearest == again_.end()) {
    state_ = State::exhausted;
    return;
  }
  fly_to(job, *nearest);
}

/// It was had or cannot be reached. A view that another one took the place of is still to come.
void ExplorationFlight::cross_off_view() {
  const auto is_this = [this](const Viewpoint& one) {
    return one.p_W == view_.p_W && one.yaw_rad == view_.yaw_rad;
  };
  again_.erase(std::remove_if(again_.begin(), again_.end(), is_this), again_.end());
}

void ExplorationFlight::watch_flight(JobContext& job) {
  const auto navigator = guidance_.state(job);
  if (!navigator) {
    return;
  }
  const bool is_there =
      (navigator->position_W - navigator->goal_W).norm() < there_m && navigator->stands_still;
  if (is_there && navigator->tracking_error.size_m < parts_.brief->arrival_error_m()) {
    guidance_.give_up_goal(job);
    if (state_ == State::homing) {
      land(job);
    } else {
      stage_ = Stage::turning;
    }
    return;
  }
  if (navigator->speed_m_s > moving_m_s || navigator->must_hover) {
    since_ = job.now();
  }
  const bool is_stuck =
      to_seconds(job.now() - since_) > patience_s ||
      (navigator->speed_m_s == 0.0 && navigator->planner_failures >= most_failures);
  if (is_stuck && state_ == State::exploring) {
    give_up_view(job);
  }
}

void ExplorationFlight::give_up_view(JobContext& job) {
  log_event(job, parts_.mission, "view given up");
  guidance_.give_up_goal(job);
  unreachable_W_.push_back(view_.p_W);
  cross_off_view();
  await_map(job.now());
}

void ExplorationFlight::watch_turn(JobContext& job) {
  const auto navigator = guidance_.state(job);
  if (navigator && std::abs(wrap_angle(navigator->yaw_rad - view_.yaw_rad)) < facing_rad) {
    if (!looks_again_) {
      taken_.push_back(view_);
    }
    cross_off_view();
    await_map(job.now());
  }
}

void ExplorationFlight::go_home(JobContext& job) {
  if (state_ == State::homing || state_ == State::landed) {
    return;
  }
  state_ = State::homing;
  stage_ = Stage::flying;
  since_ = job.now();
  guidance_.go_to(job, above_start_W());
  log_event(job, parts_.mission, "homebound");
}

void ExplorationFlight::land(JobContext& job) {
  legs_.land(job);
  stage_ = Stage::landing;
  since_ = job.now();
}

}  // namespace flyball
