// SPDX-License-Identifier: BSD-3-Clause
//
// Scanning: take off, photograph an area in lanes from above, fly home, land. Dataflow as in
// MAVBench (MICRO 2018), figure of scanning: GPS, lawnmower path, smoothing, path tracking; no
// camera that looks ahead and no map. So nothing is known to be free but what the scenario
// declares: the world names a height that nothing reaches (`open_above_m`), the flight keeps above
// it, and the guard holds the vehicle inside that space as it does inside a map. That the
// declaration is true is the world's promise; a collision still ends the mission. Take-off and
// landing are upright over the start, where the world keeps every height free.

#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"

#include "flight/navigation/navigation_nodes.h"
#include "simulation/ground_coverage.h"
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

constexpr double cell_m = 0.5;  // Of the grid that coverage is counted on.

Vec3 area_corner(const MissionBrief& brief, const ScanSettings& scan) {
  const Vec3 centre_W = 0.5 * (brief.bounds_W.min + brief.bounds_W.max);
  return {centre_W.x() - 0.5 * scan.length_m, centre_W.y() - 0.5 * scan.width_m, brief.ground_z_m};
}

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
    vehicle_ = vehicle;
    const ScanSettings& scan = context.settings.scan;
    area_W_.min = area_corner(context.brief, scan);
    area_W_.max = area_W_.min + Vec3{scan.length_m, scan.width_m, 0.0};
    seen_ = GroundCoverage{area_W_, cell_m};
    prepare_flight();
    navigator_ = std::make_unique<Navigator>(context);
    pose_ = add_localization(graph, vehicle, context);
    const auto topics = add_path_following(graph, vehicle, pose_, context, *navigator_);
    add_coverage(graph, topics.plan);
    add_pictures(graph);
    add_mission(graph);
  }

  [[nodiscard]] const Navigator* navigator() const override { return navigator_.get(); }

  [[nodiscard]] std::map<std::string, double> quality() const override {
    return {{"area_covered_percent", seen_.covered_percent()},
            {"overlap_percent", seen_.overlap_percent()},
            {"pictures", static_cast<double>(seen_.pictures())}};
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

  /// The camera and its record are instruments of the simulator: they take no time on board, and
  /// the footprints are of where the vehicle truly was.
  void add_pictures(Graph& graph) {
    NodeSpec spec;
    spec.name = "pictures";
    const Duration period = from_seconds(1.0 / context_->settings.scan.picture_rate_hz);
    spec.trigger = OnPeriod{period, period};
    spec.priority = 5;
    spec.reads = {vehicle_.navigation.index};
    graph.node(std::move(spec), [this](JobContext& job) {
      const auto sample = job.latest(vehicle_.navigation);
      if (sample && is_over_area()) {
        take_picture(job.now(), sample->X_WB_truth);
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

  void take_picture(MissionTime now, const Pose& X_WB) {
    const auto footprint = footprint_of(downward_camera_pose(X_WB),
                                        context_->settings.camera.intrinsics(), area_W_.min.z());
    if (!footprint) {
      return;
    }
    seen_.add(*footprint);
    record(*footprint, now, context_->recorder);
  }

  void add_mission(Graph& graph) {
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    spec.reads = {pose_.index, vehicle_.status.index};
    spec.writes = {vehicle_.command.index};
    graph.node(std::move(spec), [this](JobContext& job) {
      const auto pose = job.latest(pose_);
      const auto status = job.latest(vehicle_.status);
      if (pose && status && !context_->is_over()) {
        advance(job, *pose, *status);
      }
      return Work{};
    });
  }

  void advance(JobContext& job, const PoseEstimate& pose, const FlightStatus& status) {
    switch (stage_) {
      case Stage::ready:
        take_off(job, pose);
        break;
      case Stage::climbing:
        if (status.manoeuvre_done && job.now() >= settle_) {
          depart(job);
        }
        break;
      case Stage::flying:
        if (navigator_->has_arrived()) {
          land(job);
        }
        break;
      case Stage::landing:
        if (status.manoeuvre_done && job.now() >= settle_) {
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
    context_->phase = MissionPhase::take_off;
    job.publish(vehicle_.command,
                FlightCommand{FlightCommand::Kind::take_off, context_->settings.scan.height_m});
    stage_ = Stage::climbing;
    settle_ = job.now() + 500ms;  // The status on its way now is from before the command.
  }

  void depart(JobContext& job) {
    navigator_->set_goal(job.now(), above_start());
    context_->phase = MissionPhase::cruise;
    stage_ = Stage::flying;
    context_->event(job.now(), "scanning");
  }

  void land(JobContext& job) {
    navigator_->clear_goal();
    context_->phase = MissionPhase::land;
    job.publish(vehicle_.command, FlightCommand{FlightCommand::Kind::land, 0.0});
    stage_ = Stage::landing;
    settle_ = job.now() + 500ms;
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
  VehicleTopics vehicle_{};
  Topic<PoseEstimate> pose_{};
  Aabb area_W_{};
  GroundCoverage seen_{};
  double out_m_{};   ///< Along the path, before and
  double back_m_{};  ///< behind the lanes.
  Stage stage_{Stage::ready};
  MissionTime settle_{};
};

}  // namespace

FLYBALL_PLUGIN(scanning) {
  registry.add<flyball::Workload>("scanning", [] { return std::make_unique<Scanning>(); });
}
