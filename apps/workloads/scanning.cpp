// SPDX-License-Identifier: BSD-3-Clause
//
// Scanning: take off, photograph an area in lanes from above, fly home, land. Dataflow as in
// MAVBench (MICRO 2018), figure of scanning: GPS, lawnmower path, smoothing, path tracking; no
// camera that looks ahead and no map. So nothing is known to be free but what the scenario
// declares: the world names a height that nothing reaches (`open_above_m`), the flight keeps above
// it, and the guard holds the vehicle inside that space as it does inside a map. That the
// declaration is true is the world's promise; a collision still ends the mission. Take-off and
// landing are upright over the start, where the world keeps every height free.

#include "flyball/flight/exploration/ground_coverage.h"
#include "flyball/flight/exploration/ground_pictures.h"
#include "flyball/flight/legs.h"
#include "flyball/flight/navigation/navigation_nodes.h"
#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

std::string metres(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g m", value);
  return text;
}

Error refused(const std::string& sentence) {
  return {ErrorCode::invalid_input, sentence};
}

class Scanning final : public Workload {
 public:
  [[nodiscard]] Status check(const FlightSettings& settings,
                             const MissionBrief& brief) const override {
    const ScanSettings& scan = settings.scan;
    if (!brief.open_above_m) {
      return refused("workload \"scanning\" flies without a map, above everything, and world \"" +
                     brief.place + "\" names no such height; try: world farm");
    }
    const double floor_m = *brief.open_above_m + clear_margin_m;
    const double ceiling_m = brief.bounds_W.max.z() - brief.ground_z_m - clear_margin_m;
    if (scan.height_m < floor_m || scan.height_m > ceiling_m) {
      return refused("scan.height_m = " + metres(scan.height_m) + " must be at least " +
                     metres(floor_m) + ", above what stands in world \"" + brief.place +
                     "\", and at most " + metres(ceiling_m));
    }
    const Vec3 size = brief.bounds_W.max - brief.bounds_W.min;
    if (scan.length_m > size.x() || scan.width_m > size.y()) {
      return refused("scan.length_m x scan.width_m = " + metres(scan.length_m) + " x " +
                     metres(scan.width_m) + " must fit into the world's " + metres(size.x()) +
                     " x " + metres(size.y()));
    }
    return Done{};
  }

  void build(Graph& graph, const VehicleTopics& vehicle, MissionContext& context) override {
    context_ = &context;
    legs_.emplace(context, vehicle);
    area_W_ = scanned_area_W(context.brief, context.settings.scan);
    seen_ = GroundCoverage{area_W_, scan_cell_m};
    prepare_flight();
    navigator_ = std::make_unique<Navigator>(context);
    pose_ = add_localization(graph, vehicle, context);
    picture_ = graph.topic<GroundPicture>("picture");
    const auto topics = add_path_following(graph, vehicle, pose_, context, *navigator_);
    add_coverage(graph, topics.plan);
    add_pictures(graph);
    add_mission(graph);
  }

  [[nodiscard]] const Navigator* navigator() const override { return navigator_.get(); }

  [[nodiscard]] std::map<std::string, double> quality() const override {
    return {{"area_believed_percent", seen_.covered_percent()}};
  }

 private:
  enum class Stage : std::uint8_t { ready, climbing, flying, landing };
  static constexpr double clear_margin_m = 1.5;  // Half a body, its tube, and the fix's error.

  /// Without a map to be corrected by, a fix is wrong by what its receiver is: the tube around the
  /// reference has room for three standard deviations.
  void prepare_flight() {
    context_->maps_obstacles = false;
    context_->tube.at_rest_m += 3.0 * context_->settings.fix_error_m;
    const Aabb& bounds_W = context_->brief.bounds_W;
    const double floor_m =
        context_->brief.ground_z_m + context_->brief.open_above_m.value_or(bounds_W.max.z());
    Vec3 centre_W = 0.5 * (bounds_W.min + bounds_W.max);
    centre_W.z() = 0.5 * (floor_m + bounds_W.max.z());
    const double radius_m = 0.5 * (bounds_W.max - bounds_W.min).head<2>().norm();
    context_->kernels.mapper->declare_clear(centre_W,
                                            {radius_m, 0.5 * (bounds_W.max.z() - floor_m)});
  }

  /// The service that the navigator asks for plans.
  void add_coverage(Graph& graph, const Service<PlanQuery, PlanAnswer>& plan) {
    NodeSpec spec;
    spec.name = "coverage";
    spec.cost = context_->settings.kernels.coverage;
    spec.trigger = OnMessage{plan.request.index};
    spec.priority = 15;
    spec.deadline = 10s;
    spec.writes = {plan.response.index};
    graph.node(std::move(spec), [this, plan](JobContext& job) {
      const auto query = job.take(plan.request);
      return query ? answer(job, plan, *query) : Work{};
    });
  }

  Work answer(JobContext& job, const Service<PlanQuery, PlanAnswer>& plan, const PlanQuery& query) {
    const ScanSettings& scan = context_->settings.scan;
    CoverageRequest request{area_W_.min, scan.length_m, scan.width_m,
                            scan.lanes,  query.start_W, query.goal_W};
    request.corner_W.z() = query.goal_W.z();
    auto path = context_->kernels.coverage->cover(request);
    PlanAnswer reply;
    reply.id = query.id;
    reply.start_direction_W = query.start_direction_W;
    reply.body = context_->body_at(context_->knobs.value("mission.max_speed_m_s"));
    Work work;
    if (path) {
      out_m_ = path->out_m;
      back_m_ = path->back_m;
      work = path->work;
      reply.waypoints_W = std::move(path->waypoints_W);
    } else {
      reply.failure = path.error().message;
    }
    job.publish(plan.response, std::move(reply));
    return work;
  }

  /// The camera stores its pictures by itself, which takes no time on board.
  void add_pictures(Graph& graph) {
    NodeSpec spec;
    spec.name = "pictures";
    const Duration period = from_seconds(1.0 / context_->settings.scan.picture_rate_hz);
    spec.trigger = OnPeriod{period, period};
    spec.priority = 5;
    spec.reads = {pose_.index};
    spec.writes = {picture_.index};
    graph.node(std::move(spec), [this](JobContext& job) {
      const auto pose = job.latest(pose_);
      if (pose && is_over_area()) {
        take_picture(job, pose->X_WB);
      }
      return Work{};
    });
  }

  /// From when the picture's edge reaches the first lane until it leaves the last one.
  [[nodiscard]] bool is_over_area() const {
    const PathFollower& follower = navigator_->follower();
    if (stage_ != Stage::flying || !follower.has_path()) {
      return false;
    }
    const Intrinsics camera = context_->settings.camera.intrinsics();
    const double half_picture_m =
        context_->settings.scan.height_m * 0.5 * camera.height_px / camera.focal_px;
    const double left_m = follower.path().length_m() - follower.s_m();
    return follower.s_m() + half_picture_m >= out_m_ && left_m + half_picture_m >= back_m_;
  }

  void take_picture(JobContext& job, const Pose& X_WB) {
    const auto footprint = footprint_of(downward_camera_pose(X_WB),
                                        context_->settings.camera.intrinsics(), area_W_.min.z());
    if (footprint) {
      seen_.add(*footprint);
    }
    job.publish(picture_, GroundPicture{job.now()});
  }

  void add_mission(Graph& graph) {
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    spec.reads = {pose_.index};
    legs_->declare(spec);
    graph.node(std::move(spec), [this](JobContext& job) {
      const auto pose = job.latest(pose_);
      if (pose && !context_->is_over()) {
        advance(job, *pose);
      }
      return Work{};
    });
  }

  void advance(JobContext& job, const PoseEstimate& pose) {
    switch (stage_) {
      case Stage::ready:
        take_off(job, pose);
        break;
      case Stage::climbing:
        if (legs_->are_done(job)) {
          depart(job);
        }
        break;
      case Stage::flying:
        if (navigator_->has_arrived()) {
          land(job);
        }
        break;
      case Stage::landing:
        if (legs_->are_done(job)) {
          end(job);
        }
        break;
    }
  }

  [[nodiscard]] Vec3 above_start() const {
    return context_->brief.start_W + Vec3::UnitZ() * context_->settings.scan.height_m;
  }

  void take_off(JobContext& job, const PoseEstimate& pose) {
    context_->recorder.record(job.now(), "area",
                              {{"x0_m", area_W_.min.x()},
                               {"y0_m", area_W_.min.y()},
                               {"x1_m", area_W_.max.x()},
                               {"y1_m", area_W_.max.y()}});
    navigator_->hover_at(above_start(), yaw_of(pose.X_WB.linear().col(0)));
    legs_->take_off(job, context_->settings.scan.height_m);
    stage_ = Stage::climbing;
  }

  void depart(JobContext& job) {
    navigator_->set_goal(job.now(), above_start());
    context_->phase = MissionPhase::cruise;
    stage_ = Stage::flying;
    context_->event(job.now(), "scanning");
  }

  void land(JobContext& job) {
    navigator_->clear_goal();
    legs_->land(job);
    stage_ = Stage::landing;
  }

  void end(JobContext& job) {
    if (seen_.covered_percent() < context_->settings.scan.coverage_percent) {
      context_->finish(job.now(), MissionStatus::failed, MissionFailure::incomplete);
    } else {
      context_->finish(job.now(), MissionStatus::succeeded, MissionFailure::none);
    }
  }

  MissionContext* context_{};
  std::unique_ptr<Navigator> navigator_;
  std::optional<Legs> legs_{};
  Topic<PoseEstimate> pose_{};
  Topic<GroundPicture> picture_{};
  Aabb area_W_{};
  GroundCoverage seen_{};  ///< By the poses that the vehicle believes.
  double out_m_{};         ///< Along the path, before and
  double back_m_{};        ///< behind the lanes.
  Stage stage_{Stage::ready};
};

}  // namespace

FLYBALL_PLUGIN(scanning) {
  registry.add<flyball::Workload>("scanning", [] { return std::make_unique<Scanning>(); });
}
