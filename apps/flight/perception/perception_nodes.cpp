// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/perception/perception_nodes.h"

#include "flyball/flight/perception/camera_rate.h"
#include "flyball/flight/perception/pose_history.h"
#include "flyball/flight/perception/rate_limit.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace flyball {
namespace {

using namespace std::chrono_literals;

// MAVBench's deliveries ran ORB-SLAM2 beside the map even when ground truth steered the vehicle.
// Its load on the cores is charged, but nothing uses a pose from it.
void add_slam_load(Graph& graph, const FlightParts& parts) {
  NodeSpec spec;
  spec.name = "slam_load";
  spec.cost = "visual_slam";
  spec.trigger = OnMessage{parts.vehicle.depth.index};
  spec.priority = 10;
  spec.reads = {parts.mission.knobs.index};
  auto limit = std::make_shared<RateLimit>();  // Owner: this node alone.
  graph.node(std::move(spec),
             [limit, depth = parts.vehicle.depth, mission = parts.mission](JobContext& job) {
               Work work;
               const auto frame = job.latest(depth);
               if (frame && is_localizers_turn(job, mission, *limit, frame->captured)) {
                 work.add("pixels", frame->pixels);
               }
               return work;
             });
}

void add_points(Graph& graph, const FlightParts& parts, Topic<PointCloudFrame> cloud) {
  NodeSpec spec;
  spec.name = "points";
  spec.cost = parts.brief->settings.kernels.point_cloud;
  spec.trigger = OnMessage{parts.vehicle.depth.index};
  spec.priority = 20;
  spec.reads = {parts.mission.knobs.index};
  spec.writes = {cloud.index};
  auto limit = std::make_shared<RateLimit>();  // Owner: this node alone.
  graph.node(std::move(spec), [depth = parts.vehicle.depth, knobs_topic = parts.mission.knobs,
                               cloud, limit, builder = parts.kernels.point_cloud](JobContext& job) {
    Work work;
    const auto frame = job.latest(depth);
    const auto knobs = job.latest(knobs_topic);
    if (!frame || !knobs) {
      return work;
    }
    if (!limit->passes(frame->captured, knobs->value("map.rate_hz"))) {
      return work;
    }
    builder->apply(knobs->knobs);
    const double range_m = knobs->value("map.range_m");
    PointCloudFrame points = builder->build(*frame, range_m, work);
    points.range_m = range_m;
    job.publish(cloud, std::move(points));
    return work;
  });
}

/// Bytes of the whole map as an octree that says free, occupied or unknown: OctoMap's binary format
/// writes two bits for each child of a node, and so 2 (1 + 1/8 + 1/64 + ...) bits for each cell if
/// no eight of them are joined to a larger one.
double octree_bytes(const Mapper& mapper, double resolution_m) {
  constexpr double bits_per_cell = 16.0 / 7.0;
  double cells = 0.0;
  for (const MapLevel& level : mapper.contents().levels) {
    if (level.cell_m <= resolution_m) {  // The last of them is the level that is mapped at.
      cells = static_cast<double>(level.known_cells);
    }
  }
  return cells * bits_per_cell / 8.0;
}

/// Owns the mapper while the graph runs; others get revisions.
class Map {
 public:
  Map(const FlightParts& parts, const PerceptionTopics& topics)
      : brief_{parts.brief},
        mission_{parts.mission},
        topics_{topics},
        mapper_{parts.kernels.mapper} {}

  Work operator()(JobContext& job) {
    poses_.take_from(job, topics_.localization.poses);
    while (const auto told = job.take(topics_.map_hints)) {
      std::visit([this](const auto& hint) { take(hint); }, *told);
    }
    const auto frame = job.latest(topics_.cloud);
    const auto knobs = job.latest(mission_.knobs);
    const auto pose = frame ? poses_.at(frame->captured) : std::nullopt;
    const auto where = job.latest(topics_.localization.status);
    if (!pose || !knobs || (where && where->is_lost)) {  // A frame without a pose is of no use.
      return Work{};
    }
    return insert(job, *frame, *pose, *knobs);
  }

 private:
  void take(const ClearSpace& clear) { mapper_->declare_clear(clear.centre_W, clear.space); }
  void take(const DoubtedPlace& doubted) {
    mapper_->doubt_obstacles(doubted.centre_W, doubted.radius_m);
  }

  Work insert(JobContext& job,
              const PointCloudFrame& frame,
              const PoseEstimate& pose,
              const KnobsInForce& knobs) {
    mapper_->apply(knobs.knobs);
    const double resolution_m = knobs.value("map.resolution_m");
    const double longest_m = mapper_->longest_range_m(resolution_m);
    const MapperSettings settings{resolution_m, std::min(knobs.value("map.range_m"), longest_m)};
    const auto work =
        mapper_->prepare_frame(frame, camera_pose(pose.X_WB, brief_->settings.camera), settings);
    if (!work) {
      log_event(job, mission_, "frame not mapped: " + work.error().message);
      return Work{};
    }
    mapper_->commit();
    MapRevision revision{++number_, frame.captured, settings.resolution_m, mapper_->revision()};
    revision.range_m =
        frame.range_m > 0.0 ? std::min(frame.range_m, settings.range_m) : settings.range_m;
    revision.longest_range_m = longest_m;
    if (brief_->settings.has_edge) {
      revision.bytes = octree_bytes(*mapper_, settings.resolution_m);
    }
    job.publish(topics_.map, std::move(revision));
    return *work;
  }

  std::shared_ptr<const Brief> brief_;  ///< Owners: all nodes.
  MissionTopics mission_;
  PerceptionTopics topics_;
  std::shared_ptr<Mapper> mapper_;  ///< See MissionKernels.
  PoseHistory poses_{};
  std::uint64_t number_{};
};

void add_map(Graph& graph, const FlightParts& parts, const PerceptionTopics& topics) {
  NodeSpec spec;
  spec.name = "map";
  spec.cost = mapper_cost(parts.brief->settings.kernels);
  spec.trigger = OnMessage{topics.cloud.index};
  spec.priority = 10;
  spec.deadline = 5s;
  spec.reads = {topics.localization.poses.index, topics.localization.status.index,
                topics.map_hints.index, parts.mission.knobs.index};
  spec.writes = {topics.map.index};
  declare_log(spec, parts.mission);
  auto map = std::make_shared<Map>(parts, topics);  // Owner: this node alone.
  graph.node(std::move(spec), [map](JobContext& job) { return (*map)(job); });
}

}  // namespace

Pose camera_pose(const Pose& X_WB, const DepthCameraSpec& camera) {
  const double yaw = yaw_of(X_WB.linear().col(0));
  Eigen::Matrix3d R_BC;  // clang-format off
  R_BC << 0, 0, 1,
         -1, 0, 0,
          0, -1, 0;  // clang-format on
  const Eigen::Matrix3d R_WL = Eigen::AngleAxisd{yaw, Vec3::UnitZ()}.toRotationMatrix();
  Pose X_WC = Pose::Identity();
  X_WC.linear() =
      R_WL * R_BC * Eigen::AngleAxisd{-camera.pitch_down_rad, Vec3::UnitX()}.toRotationMatrix();
  X_WC.translation() = X_WB.translation() + R_WL * Vec3{camera.forward_m, 0.0, camera.up_m};
  return X_WC;
}

PerceptionTopics add_perception(Graph& graph, const FlightParts& given) {
  const FlightParts parts = with_camera_rate(graph, given);
  PerceptionTopics topics;
  topics.localization = add_localization(graph, parts);
  topics.cloud = graph.topic<PointCloudFrame>("cloud");
  topics.map_hints = graph.topic<MapHint>("map_hints", 16);
  topics.map = graph.topic<MapRevision>("map_revision");
  if (parts.brief->settings.kernels.slam_load && !parts.vehicle.view) {
    add_slam_load(graph, parts);
  }
  add_points(graph, parts, topics.cloud);
  add_map(graph, parts, topics);
  return topics;
}

}  // namespace flyball
