// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/people/person_search.h"

#include "flyball/runtime/gimbal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto same_time = 60ms;      // Colour and depth camera run at 20 Hz.
constexpr double inner_share = 0.25;  // Of the box, to each side of its middle.

/// The pixel that looks along a direction of the level frame L (x forward, y left, z up).
std::optional<std::array<double, 2>> pixel_of(const Vec3& ray_L, const Intrinsics& camera) {
  if (ray_L.x() <= 0.0) {
    return std::nullopt;
  }
  const double u = camera.centre_x_px - camera.focal_px * ray_L.y() / ray_L.x();
  const double v = camera.centre_y_px - camera.focal_px * ray_L.z() / ray_L.x();
  if (u < 0.0 || v < 0.0 || u > camera.width_px - 1.0 || v > camera.height_px - 1.0) {
    return std::nullopt;
  }
  return std::array{u, v};
}

/// Finite depths around a pixel, in no order.
std::vector<float> depths_near(const DepthImage& depth,
                               const std::array<double, 2>& pixel,
                               const std::array<double, 2>& half) {
  const auto range = [](double centre, double reach, int count) {
    const auto clamped = [count](double x) {
      return static_cast<int>(std::clamp(std::lround(x), 0L, static_cast<long>(count - 1)));
    };
    return std::array{clamped(centre - reach), clamped(centre + reach)};
  };
  const auto u = range(pixel[0], half[0], depth.camera.width_px);
  const auto v = range(pixel[1], half[1], depth.camera.height_px);
  std::vector<float> depths;
  for (int y = v[0]; y <= v[1]; ++y) {
    for (int x = u[0]; x <= u[1]; ++x) {
      const float d = depth.depth_m[static_cast<std::size_t>(y * depth.camera.width_px + x)];
      if (std::isfinite(d)) {
        depths.push_back(d);
      }
    }
  }
  return depths;
}

Sightings look(JobContext& job,
               const VehicleTopics& vehicle,
               const PoseHistory& history,
               MissionContext& context,
               Work& work) {
  const auto frame = job.latest(vehicle.colour);
  const auto depth = job.latest(vehicle.depth);
  if (!frame || !depth || context.phase != MissionPhase::cruise) {
    return {};
  }
  const auto pose = history.at(frame->captured);
  const Duration apart = depth->captured - frame->captured;
  if (!pose || apart > same_time || -apart > same_time) {
    return {};
  }
  const auto people = context.kernels.detector->detect(frame->image.value(),
                                                       context.knobs.value("detector.scale"), work);
  if (!people) {
    context.event(job.now(), "not looked at: " + people.error().message);
    return {};
  }
  Sightings seen{*frame, pose->X_WB.translation(), {}};
  for (const Detection& person : *people) {
    if (const auto p_W = place_of(person.box, *frame, depth->image.value(), pose->X_WB)) {
      seen.people.push_back({person.box, person.score, *p_W});
    }
  }
  return seen;
}

}  // namespace

std::optional<Vec3> place_of(const ImageBox& box,
                             const ColourFrame& frame,
                             const DepthImage& depth,
                             const Pose& X_WB) {
  const Intrinsics& camera = frame.camera;
  const Vec3 ray_C{(box.centre_x_px() - camera.centre_x_px) / camera.focal_px,
                   (box.centre_y_px() - camera.centre_y_px) / camera.focal_px, 1.0};
  const Vec3 ray_L = frame.X_LC.linear() * ray_C;
  const auto pixel = pixel_of(ray_L, depth.camera);
  if (!pixel) {
    return std::nullopt;
  }
  const double scale = inner_share * depth.camera.focal_px / camera.focal_px;
  std::vector<float> depths =
      depths_near(depth, *pixel, {scale * box.width_px, scale * box.height_px});
  if (depths.empty()) {
    return std::nullopt;
  }
  const auto middle = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 2);
  std::nth_element(depths.begin(), middle, depths.end());
  return level_frame(X_WB) * (ray_L * (static_cast<double>(*middle) / ray_L.x()));
}

Topic<Sightings> add_person_search(Graph& graph,
                                   const VehicleTopics& vehicle,
                                   const PerceptionTopics& perception,
                                   MissionContext& context) {
  const auto sightings = graph.topic<Sightings>("sightings", 8);
  auto history = std::make_shared<PoseHistory>();  // Owners: the two nodes.
  NodeSpec poses;
  poses.name = "look_poses";
  poses.trigger = OnMessage{perception.pose.index};
  poses.priority = 30;
  graph.node(std::move(poses), [perception, history](JobContext& job) {
    if (const auto pose = job.latest(perception.pose)) {
      history->add(*pose);
    }
    return Work{};
  });
  NodeSpec spec;
  spec.name = "detect";
  spec.cost = detector_cost(context.settings);
  spec.trigger = OnMessage{vehicle.colour.index};
  spec.priority = 10;
  spec.reads = {vehicle.depth.index};
  spec.writes = {sightings.index};
  graph.node(std::move(spec), [vehicle, sightings, history, &context](JobContext& job) {
    Work work;
    Sightings seen = look(job, vehicle, *history, context, work);
    if (!seen.people.empty()) {
      job.publish(sightings, std::move(seen));
    }
    return work;
  });
  return sightings;
}

}  // namespace flyball
