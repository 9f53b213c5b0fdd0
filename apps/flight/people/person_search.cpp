// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/people/person_search.h"

#include "flyball/flight/perception/pose_history.h"
#include "flyball/runtime/gimbal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace flyball {
namespace {

using namespace std::chrono_literals;

/// A picture's depth image is that of a frame before or after it, at most.
Duration same_time(const DepthCameraSpec& depth) {
  constexpr double frames = 1.2;
  constexpr Duration least = 60ms;
  return std::max(least, from_seconds(frames / depth.rate_hz));
}

constexpr double inner_share = 0.25;  // Of the box, to each side of its middle. Chosen.

/// The pixel that looks along a direction of the camera's frame (x right, y down, z ahead).
std::optional<std::array<double, 2>> pixel_of(const Vec3& ray_C, const Intrinsics& camera) {
  if (ray_C.z() <= 0.0) {
    return std::nullopt;
  }
  const double u = camera.centre_x_px + camera.focal_px * ray_C.x() / ray_C.z();
  const double v = camera.centre_y_px + camera.focal_px * ray_C.y() / ray_C.z();
  if (u < 0.0 || v < 0.0 || u > camera.width_px - 1.0 || v > camera.height_px - 1.0) {
    return std::nullopt;
  }
  return std::array{u, v};
}

/// Measured depths around a pixel, in no order.
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
  const auto width = static_cast<std::size_t>(depth.camera.width_px);
  std::vector<float> depths;
  for (int y = v[0]; y <= v[1]; ++y) {
    for (int x = u[0]; x <= u[1]; ++x) {
      depths.push_back(
          depth.depth_m[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)]);
    }
  }
  const auto is_no_depth = [](float d) { return !std::isfinite(d) || d <= 0.0F; };
  depths.erase(std::remove_if(depths.begin(), depths.end(), is_no_depth), depths.end());
  return depths;
}

/// Looks at the newest frame.
class Detect {
 public:
  Detect(const FlightParts& parts, Topic<PoseEstimate> poses, Topic<Sightings> sightings)
      : parts_{parts}, poses_topic_{poses}, sightings_{sightings} {}

  Work operator()(JobContext& job) {
    Work work;
    poses_.take_from(job, poses_topic_);
    const auto frame = job.latest(parts_.vehicle.colour);
    const auto depth = job.latest(parts_.vehicle.colour_depth);
    const auto knobs = job.latest(parts_.mission.knobs);
    if (!frame || !depth || !knobs || !is_in(job, parts_.mission, MissionPhase::cruise)) {
      return work;
    }
    const auto pose = poses_.at(frame->captured);
    const DepthCameraSpec& camera = parts_.brief->settings.camera;
    const Duration apart = depth->captured - frame->captured;
    if (!pose || std::max(apart, -apart) > same_time(camera)) {
      return work;
    }
    parts_.kernels.detector->apply(knobs->knobs);
    const auto people =
        parts_.kernels.detector->detect(frame->image.value(), knobs->value("detector.scale"), work);
    if (people) {
      tell(job, *people, *frame, *depth, *pose);
    } else {
      log_event(job, parts_.mission, "not looked at: " + people.error().message);
    }
    return work;
  }

 private:
  void tell(JobContext& job,
            const std::vector<Detection>& people,
            const ColourFrame& frame,
            const DepthFrame& depth,
            const PoseEstimate& pose) {
    Sightings seen{frame, pose.X_WB.translation(), {}};
    for (const Detection& person : people) {
      if (const auto p_W = place_of(person.box, frame, depth.image.value(),
                                    parts_.brief->settings.camera, pose.X_WB)) {
        seen.people.push_back({person.box, person.score, *p_W});
      }
    }
    if (!seen.people.empty()) {
      job.publish(sightings_, std::move(seen));
    }
  }

  FlightParts parts_;
  Topic<PoseEstimate> poses_topic_;
  Topic<Sightings> sightings_;
  PoseHistory poses_{};
};

}  // namespace

std::optional<Vec3> place_of(const ImageBox& box,
                             const ColourFrame& frame,
                             const DepthImage& depth,
                             const DepthCameraSpec& mount,
                             const Pose& X_WB) {
  const Intrinsics& camera = frame.camera;
  const Pose X_LD = camera_pose(Pose::Identity(), mount);
  const Vec3 ray_C{(box.centre_x_px() - camera.centre_x_px) / camera.focal_px,
                   (box.centre_y_px() - camera.centre_y_px) / camera.focal_px, 1.0};
  const Vec3 ray_D = X_LD.linear().transpose() * (frame.X_LC.linear() * ray_C);
  const auto pixel = pixel_of(ray_D, depth.camera);
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
  return level_frame(X_WB) * (X_LD * (ray_D * (static_cast<double>(*middle) / ray_D.z())));
}

Topic<Sightings> add_person_search(Graph& graph,
                                   const FlightParts& parts,
                                   const LocalizationTopics& localization) {
  const auto sightings = graph.topic<Sightings>("sightings", 8);
  NodeSpec spec;
  spec.name = "detect";
  spec.cost = detector_cost(parts.brief->settings);
  spec.trigger = OnMessage{parts.vehicle.colour.index};
  spec.priority = 8;  // A person waits longer than an obstacle: below the map.
  spec.reads = {parts.vehicle.colour_depth.index, localization.poses.index,
                parts.mission.knobs.index, parts.mission.state.index};
  spec.writes = {sightings.index};
  declare_log(spec, parts.mission);
  // Owner: this node alone.
  auto detect = std::make_shared<Detect>(parts, localization.poses, sightings);
  graph.node(std::move(spec), [detect](JobContext& job) { return (*detect)(job); });
  return sightings;
}

}  // namespace flyball
