// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/perception/perception_nodes.h"

#include "flyball/flight/perception/visual_nodes.h"

#include <algorithm>
#include <memory>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto pose_memory = 3s;

void add_localizer(Graph& graph,
                   const VehicleTopics& vehicle,
                   Topic<PoseEstimate> pose,
                   MissionContext& context) {
  NodeSpec spec;
  spec.name = "localize";
  spec.cost = "localizer";
  spec.trigger = OnMessage{vehicle.navigation.index};
  spec.priority = 30;
  spec.deadline = 10ms;
  spec.writes = {pose.index};
  if (vehicle.true_pose) {
    spec.reads = {vehicle.true_pose->index};
  }
  graph.node(std::move(spec), [vehicle, pose, &context](JobContext& job) {
    Work work;
    if (const auto sample = job.latest(vehicle.navigation)) {
      if (const auto truth = vehicle.true_pose ? job.latest(*vehicle.true_pose) : nullptr) {
        context.kernels.localizer->reveal(*truth);
      }
      const PoseEstimate estimate = context.kernels.localizer->estimate(*sample, work);
      if (!context.localization.is_lost()) {
        context.localization.passed(estimate);
      }
      job.publish(pose, estimate);
    }
    return work;
  });
}

// The paper's deliveries ran ORB-SLAM2 beside the map even when ground truth steered; its load on
// the cores is charged, its pose is not used.
void add_slam_load(Graph& graph, const VehicleTopics& vehicle) {
  NodeSpec spec;
  spec.name = "slam_load";
  spec.cost = "visual_slam";
  spec.trigger = OnMessage{vehicle.depth.index};
  spec.priority = 10;
  graph.node(std::move(spec), [vehicle](JobContext& job) {
    Work work;
    if (const auto frame = job.latest(vehicle.depth)) {
      work.add("pixels", frame->pixels);
    }
    return work;
  });
}

void add_points(Graph& graph,
                const VehicleTopics& vehicle,
                Topic<PointCloudFrame> cloud,
                MissionContext& context) {
  NodeSpec spec;
  spec.name = "points";
  spec.cost = context.settings.kernels.point_cloud;
  spec.trigger = OnMessage{vehicle.depth.index};
  spec.priority = 20;
  spec.writes = {cloud.index};
  auto last = std::make_shared<std::optional<MissionTime>>();  // Owner: this node alone.
  graph.node(std::move(spec), [vehicle, cloud, &context, last](JobContext& job) {
    Work work;
    const auto frame = job.latest(vehicle.depth);
    // A tenth of the interval as tolerance: a 20 Hz camera satisfies a 20 Hz knob.
    const double interval_s = 0.9 / context.knobs.value("map.rate_hz");
    if (!frame || (*last && to_seconds(frame->captured - **last) < interval_s)) {
      return work;
    }
    *last = frame->captured;
    const double range_m = context.knobs.value("map.range_m");
    job.publish(cloud, context.kernels.point_cloud->build(*frame, range_m, work));
    return work;
  });
}

void add_mapper(Graph& graph, const PerceptionTopics& topics, MissionContext& context) {
  NodeSpec spec;
  spec.name = "map";
  spec.cost = mapper_cost(context.settings.kernels);
  spec.trigger = OnMessage{topics.cloud.index};
  spec.priority = 10;
  spec.deadline = 5s;
  spec.reads = {topics.pose.index};
  spec.writes = {topics.map.index};
  auto revision = std::make_shared<std::uint64_t>(0);  // Owner: this node alone.
  auto history = std::make_shared<PoseHistory>();
  NodeSpec poses;
  poses.name = "pose_history";
  poses.trigger = OnMessage{topics.pose.index};
  poses.priority = 30;
  graph.node(std::move(poses), [topics, history](JobContext& job) {
    if (const auto pose = job.latest(topics.pose)) {
      history->add(*pose);
    }
    return Work{};
  });
  graph.node(std::move(spec), [topics, history, revision, &context](JobContext& job) {
    const auto frame = job.latest(topics.cloud);
    const auto pose = frame ? history->at(frame->captured) : std::nullopt;
    if (!pose || context.localization.is_lost()) {  // Seen from nobody knows where.
      return Work{};
    }
    const MapperSettings settings{context.knobs.value("map.resolution_m"),
                                  context.knobs.value("map.range_m")};
    const auto work = context.kernels.mapper->prepare_frame(
        *frame, camera_pose(pose->X_WB, context.settings.camera), settings);
    if (!work) {
      context.event(job.now(), "frame not mapped: " + work.error().message);
      return Work{};
    }
    job.at_end([&context](MissionTime) { context.kernels.mapper->commit(); });
    job.publish(topics.map,
                MapRevision{++*revision, frame->captured, job.now(), settings.resolution_m});
    return *work;
  });
}

}  // namespace

void PoseHistory::add(const PoseEstimate& pose) {
  poses_.push_back(pose);
  while (poses_.front().stamp + pose_memory < pose.stamp) {
    poses_.pop_front();
  }
}

std::optional<PoseEstimate> PoseHistory::at(MissionTime t) const {
  if (poses_.empty()) {
    return std::nullopt;
  }
  const auto after = std::lower_bound(
      poses_.begin(), poses_.end(), t,
      [](const PoseEstimate& pose, MissionTime time) { return pose.stamp < time; });
  if (after == poses_.end()) {
    return poses_.back();
  }
  if (after == poses_.begin() || after->stamp == t) {
    return *after;
  }
  const PoseEstimate& a = *(after - 1);
  const PoseEstimate& b = *after;
  const double u = ratio(t - a.stamp, b.stamp - a.stamp);
  PoseEstimate mixed = a;
  mixed.stamp = t;
  mixed.X_WB.translation() = (1.0 - u) * a.X_WB.translation() + u * b.X_WB.translation();
  mixed.X_WB.linear() = Eigen::Quaterniond{a.X_WB.linear()}
                            .slerp(u, Eigen::Quaterniond{b.X_WB.linear()})
                            .toRotationMatrix();
  mixed.v_WB = (1.0 - u) * a.v_WB + u * b.v_WB;
  return mixed;
}

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

Topic<PoseEstimate> add_localization(Graph& graph,
                                     const VehicleTopics& vehicle,
                                     MissionContext& context) {
  const auto pose = graph.topic<PoseEstimate>("pose");
  add_localizer(graph, vehicle, pose, context);
  add_sight(graph, context);
  return pose;
}

PerceptionTopics add_perception(Graph& graph,
                                const VehicleTopics& vehicle,
                                MissionContext& context) {
  PerceptionTopics topics;
  topics.pose = add_localization(graph, vehicle, context);
  topics.cloud = graph.topic<PointCloudFrame>("cloud");
  topics.map = graph.topic<MapRevision>("map_revision");
  if (context.settings.kernels.slam_load && !context.has_rgb_camera) {
    add_slam_load(graph, vehicle);
  }
  add_points(graph, vehicle, topics.cloud, context);
  add_mapper(graph, topics, context);
  return topics;
}

}  // namespace flyball
