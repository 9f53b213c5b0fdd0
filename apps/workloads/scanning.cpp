// SPDX-License-Identifier: BSD-3-Clause
//
// Scanning: the vehicle takes off, photographs an area in lanes from above, flies home and lands.
// The dataflow is that of MAVBench (MICRO 2018), figure of scanning: GPS, lawnmower path,
// smoothing, path tracking, without a forward camera and without a map. So only space that the
// scenario declares is known to be free: the world names a height that nothing reaches
// (`open_above_m`), the vehicle flies above it, and the guard holds the vehicle inside that space
// as it would inside a map. If the declaration is wrong, a collision ends the mission as in any
// other. Take-off and landing are vertical over the start, where the world keeps every height free.

#include "flyball/flight/exploration/ground_coverage.h"
#include "flyball/flight/exploration/ground_pictures.h"
#include "flyball/flight/flight_parts.h"
#include "flyball/flight/legs.h"
#include "flyball/flight/navigation/navigation_nodes.h"
#include "flyball/flight/perception/camera_rate.h"
#include "flyball/flight/workload.h"
#include "flyball/runtime/registry.h"
#include "flyball/runtime/text/number_text.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace {

using namespace flyball;
using namespace std::chrono_literals;

std::string metres(double value) {
  return short_number_text(value) + " m";
}

Error refused(const std::string& sentence) {
  return {ErrorCode::invalid_input, sentence};
}

class Scanning final : public Workload {
 public:
  [[nodiscard]] Status check(const FlightSettings& settings, const Site& site) const override {
    const ScanSettings& scan = settings.scan;
    if (!site.open_above_m) {
      return refused("workload \"scanning\" flies without a map, above everything, and world \"" +
                     site.place + "\" names no such height; try: world farm");
    }
    const double margin_m = std::max(least_margin_m, body_and_tube_m + widening_m(settings));
    const double floor_m = *site.open_above_m + margin_m;
    const double ceiling_m = site.bounds_W.max.z() - site.ground_z_m - margin_m;
    if (scan.height_m < floor_m || scan.height_m > ceiling_m) {
      return refused("scan.height_m = " + metres(scan.height_m) + " must be at least " +
                     metres(floor_m) + ", above what stands in world \"" + site.place +
                     "\", and at most " + metres(ceiling_m));
    }
    const Vec3 size = site.bounds_W.max - site.bounds_W.min;
    if (scan.length_m > size.x() || scan.width_m > size.y()) {
      return refused("scan.length_m x scan.width_m = " + metres(scan.length_m) + " x " +
                     metres(scan.width_m) + " must fit into the world's " + metres(size.x()) +
                     " x " + metres(size.y()));
    }
    return Done{};
  }

  void adapt(Brief& brief) const override {
    brief.maps_obstacles = false;
    brief.tube.at_rest_m += widening_m(brief.settings);
  }

  void build(Graph& graph, const FlightParts& parts) override {
    brief_ = parts.brief;
    mission_ = parts.mission;
    legs_.emplace(parts.vehicle, parts.mission);
    area_W_ = scanned_area_W(brief_->site, brief_->settings.scan);
    declared_ = declared_space(*parts.kernels.mapper);
    const LocalizationTopics localization = add_localization(graph, with_camera_rate(graph, parts));
    pose_ = localization.pose;
    picture_ = graph.topic<GroundPicture>("picture", 16);
    lanes_ = graph.topic<Lanes>("lanes");
    map_ = graph.topic<MapRevision>("map_revision");
    const NavigationTopics topics = add_path_following(graph, parts, localization, declared_);
    guidance_.emplace(topics.guidance);
    add_coverage(graph, parts, topics.plan);
    add_pictures(graph, topics.guidance.state);
    add_mission(graph);
  }

  [[nodiscard]] std::map<std::string, double> quality() const override {
    return {{"area_believed_percent", seen_.covered_percent()}};
  }

 private:
  enum class Stage : std::uint8_t { ready, climbing, flying, landing, done };
  static constexpr double least_margin_m = 1.5;
  static constexpr double body_and_tube_m = 1.0;  // Chosen: half a body, its tube, and a cell.

  /// No map corrects the error of a GPS fix, so the tube around the reference has room for three
  /// standard deviations of it.
  static double widening_m(const FlightSettings& settings) { return 3.0 * settings.fix_error_m; }

  /// Where the lanes lie along the path.
  struct Lanes {
    double out_m{};   ///< Arc length at which the lanes begin.
    double back_m{};  ///< Arc length at which they end.
  };

  /// The space that is known to be free: all that lies higher than any obstacle.
  [[nodiscard]] std::shared_ptr<const OccupancyView> declared_space(Mapper& mapper) const {
    const Site& site = brief_->site;
    const double ceiling_m = site.bounds_W.max.z();
    const double floor_m = site.ground_z_m + site.open_above_m.value_or(ceiling_m);
    Vec3 centre_W = 0.5 * (site.bounds_W.min + site.bounds_W.max);
    centre_W.z() = 0.5 * (floor_m + ceiling_m);
    const double radius_m = 0.5 * (site.bounds_W.max - site.bounds_W.min).head<2>().norm();
    mapper.declare_clear(centre_W, {radius_m, 0.5 * (ceiling_m - floor_m)});
    return mapper.revision();
  }

  /// The service that the navigator asks for plans.
  void add_coverage(Graph& graph,
                    const FlightParts& parts,
                    const Service<PlanQuery, PlanAnswer>& plan) {
    NodeSpec spec;
    spec.name = "coverage";
    spec.cost = brief_->settings.kernels.coverage;
    spec.trigger = OnMessage{plan.request.index};
    spec.priority = 15;
    spec.deadline = 10s;
    spec.reads = {mission_.knobs.index};
    spec.writes = {plan.response.index, lanes_.index};
    graph.node(std::move(spec), [this, plan, planner = parts.kernels.coverage](JobContext& job) {
      const auto query = job.take(plan.request);
      const auto knobs = job.latest(mission_.knobs);
      return query && knobs ? answer(job, plan, *query, *knobs, *planner) : Work{};
    });
  }

  /// Run by the node `coverage`: touches nothing but the brief and the topics.
  Work answer(JobContext& job,
              const Service<PlanQuery, PlanAnswer>& plan,
              const PlanQuery& query,
              const KnobsInForce& knobs,
              CoveragePlanner& planner) const {
    const ScanSettings& scan = brief_->settings.scan;
    CoverageRequest request{area_W_.min, scan.length_m, scan.width_m,
                            scan.lanes,  query.start_W, query.goal_W};
    request.corner_W.z() = query.goal_W.z();
    planner.apply(knobs.knobs);
    auto path = planner.cover(request);
    PlanAnswer reply;
    reply.id = query.id;
    reply.start_direction_W = query.start_direction_W;
    reply.body = brief_->body_at(knobs.value("mission.max_speed_m_s"));
    Work work;
    if (path) {
      job.publish(lanes_, Lanes{path->out_m, path->back_m});
      work = path->work;
      reply.waypoints_W = std::move(path->waypoints_W);
    } else {
      reply.failure = path.error().message;
    }
    job.publish(plan.response, std::move(reply));
    return work;
  }

  /// The camera stores its pictures itself, which takes no time of the computer.
  void add_pictures(Graph& graph, Topic<NavigatorState> navigator) {
    NodeSpec spec;
    spec.name = "pictures";
    const Duration period = from_seconds(1.0 / brief_->settings.scan.picture_rate_hz);
    spec.trigger = OnPeriod{period, period};
    spec.priority = 5;
    spec.reads = {pose_.index, navigator.index, lanes_.index, mission_.state.index};
    spec.writes = {picture_.index};
    graph.node(std::move(spec), [this, navigator](JobContext& job) {
      const auto pose = job.latest(pose_);
      const auto state = job.latest(navigator);
      const auto lanes = job.latest(lanes_);
      if (pose && state && lanes && is_in(job, mission_, MissionPhase::cruise) &&
          is_over_area(*state, *lanes)) {
        job.publish(picture_, picture(job.now(), pose->X_WB));
      }
      return Work{};
    });
  }

  /// Pictures count from the place where their edge reaches the first lane to the place where it
  /// leaves the last one.
  [[nodiscard]] bool is_over_area(const NavigatorState& navigator, const Lanes& lanes) const {
    if (!navigator.has_path()) {
      return false;
    }
    const Intrinsics camera = brief_->settings.camera.intrinsics();
    const double half_picture_m =
        brief_->settings.scan.height_m * 0.5 * camera.height_px / camera.focal_px;
    const double left_m = navigator.path->length_m() - navigator.s_m;
    return navigator.s_m + half_picture_m >= lanes.out_m && left_m + half_picture_m >= lanes.back_m;
  }

  [[nodiscard]] GroundPicture picture(MissionTime taken, const Pose& X_WB) const {
    return {taken, footprint_of(downward_camera_pose(X_WB), brief_->settings.camera.intrinsics(),
                                area_W_.min.z())};
  }

  void add_mission(Graph& graph) {
    seen_ = GroundCoverage{area_W_, scan_cell_m};
    NodeSpec spec;
    spec.name = "mission";
    spec.trigger = OnPeriod{100ms, 200ms};
    spec.priority = 35;
    spec.reads = {pose_.index, picture_.index};
    spec.writes = {mission_.progress.index, mission_.end.index, map_.index};
    legs_->declare(spec);
    guidance_->declare(spec);
    declare_log(spec, mission_);
    graph.node(std::move(spec), [this](JobContext& job) {
      while (const auto picture = job.take(picture_)) {
        if (picture->footprint) {
          seen_.add(*picture->footprint);
          tell_progress(job, mission_, ProgressUnit::square_metre, covered_m2());
        }
      }
      if (const auto pose = job.latest(pose_)) {
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
        if (const auto navigator = guidance_->state(job); navigator && navigator->has_arrived) {
          land(job);
        }
        break;
      case Stage::landing:
        if (legs_->are_done(job)) {
          end(job);
        }
        break;
      case Stage::done:
        break;
    }
  }

  [[nodiscard]] double covered_m2() const {
    const Vec3 extent = area_W_.max - area_W_.min;
    return 1e-2 * seen_.covered_percent() * extent.x() * extent.y();
  }

  [[nodiscard]] Vec3 above_start() const {
    return brief_->site.start_W + Vec3::UnitZ() * brief_->settings.scan.height_m;
  }

  void take_off(JobContext& job, const PoseEstimate& pose) {
    log(job, mission_, "area",
        {{"x0_m", area_W_.min.x()},
         {"y0_m", area_W_.min.y()},
         {"x1_m", area_W_.max.x()},
         {"y1_m", area_W_.max.y()}});
    job.publish(map_, MapRevision{1, job.now(), declared_->resolution_m(), declared_});
    guidance_->hover_at(job, above_start(), yaw_of(pose.X_WB.linear().col(0)));
    legs_->take_off(job, brief_->settings.scan.height_m);
    stage_ = Stage::climbing;
  }

  void depart(JobContext& job) {
    guidance_->go_to(job, above_start());
    legs_->enter(job, MissionPhase::cruise);
    stage_ = Stage::flying;
    log_event(job, mission_, "scanning");
  }

  void land(JobContext& job) {
    guidance_->give_up_goal(job);
    legs_->land(job);
    stage_ = Stage::landing;
  }

  void end(JobContext& job) {
    const bool is_enough = seen_.covered_percent() >= brief_->settings.scan.coverage_percent;
    end_mission(job, mission_, is_enough ? MissionStatus::succeeded : MissionStatus::failed,
                is_enough ? MissionFailure::none : MissionFailure::incomplete);
    stage_ = Stage::done;
  }

  // Constant once the graph is built.
  std::shared_ptr<const Brief> brief_{};  ///< Owners: all nodes.
  MissionTopics mission_{};
  std::shared_ptr<const OccupancyView> declared_{};  ///< Owners: this, `smooth` and `follow`.
  Topic<PoseEstimate> pose_{};
  Topic<GroundPicture> picture_{};
  Topic<Lanes> lanes_{};
  Topic<MapRevision> map_{};
  Aabb area_W_{};

  // The node `mission` alone uses these.
  std::optional<Guidance> guidance_{};
  std::optional<Legs> legs_{};
  GroundCoverage seen_{};  ///< Computed from the poses that the vehicle believes.
  Stage stage_{Stage::ready};
};

}  // namespace

FLYBALL_PLUGIN(scanning) {
  registry.add<flyball::Workload>("scanning", [] { return std::make_unique<Scanning>(); });
}
