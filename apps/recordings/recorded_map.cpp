// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/recordings/recorded_map.h"

#include "flyball/kernels/pixel_point.h"
#include "flyball/runtime/text/listed.h"

#include "scenario/kernel_choice.h"
#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

Status check(const Recording& recording) {
  const bool has_depth = std::all_of(recording.frames.begin(), recording.frames.end(),
                                     [](const RecordedFrame& f) { return !f.depth_file.empty(); });
  if (!has_depth) {
    return Error{ErrorCode::invalid_input,
                 "the recording has no depth images, and a map is made of them; record in TUM's "
                 "layout (rgb, depth)"};
  }
  const auto& d = recording.camera.distortion;
  if (recording.camera.distortion_model != DistortionModel::radial_tangential ||
      std::any_of(d.begin(), d.end(), [](double k) { return k != 0.0; })) {
    return Error{ErrorCode::invalid_input,
                 "the recording's lens bends, and depth is mapped for straight lenses only; "
                 "rectify its images first"};
  }
  return Done{};
}

PointCloud cloud_of(const VisualFrame& frame, std::uint64_t sequence, double range_m) {
  PointCloud cloud;
  cloud.captured = frame.captured;
  cloud.sequence = sequence;
  const CameraModel& camera = frame.camera;
  std::size_t pixel = 0;
  for (int row = 0; row < camera.height_px; ++row) {
    const double y = (row - camera.centre_y_px) / camera.focal_y_px;
    for (int column = 0; column < camera.width_px; ++column) {
      const double x = (column - camera.centre_x_px) / camera.focal_x_px;
      const auto depth_m = static_cast<double>(frame.depth_m[pixel++]);
      if (!std::isfinite(depth_m)) {
        continue;
      }
      if (const auto point = point_of_pixel(x, y, depth_m, range_m)) {
        (point->is_hit ? cloud.hits_C : cloud.clear_C).push_back(point->p_C);
      }
    }
  }
  return cloud;
}

}  // namespace

std::optional<Pose> pose_between(const std::vector<TimedPose>& poses,
                                 MissionTime t,
                                 Duration widest_gap) {
  const auto after =
      std::lower_bound(poses.begin(), poses.end(), t,
                       [](const TimedPose& pose, MissionTime time) { return pose.stamp < time; });
  if (after == poses.end()) {
    return std::nullopt;
  }
  if (after->stamp == t) {
    return after->X_WB;
  }
  if (after == poses.begin() || after->stamp - (after - 1)->stamp > widest_gap) {
    return std::nullopt;
  }
  const TimedPose& before = *(after - 1);
  const double share = to_seconds(t - before.stamp) / to_seconds(after->stamp - before.stamp);
  Pose X_WB = Pose::Identity();
  X_WB.translation() =
      (1.0 - share) * before.X_WB.translation() + share * after->X_WB.translation();
  X_WB.linear() = Eigen::Quaterniond{before.X_WB.linear()}
                      .slerp(share, Eigen::Quaterniond{after->X_WB.linear()})
                      .normalized()
                      .toRotationMatrix();
  return X_WB;
}

Result<std::unique_ptr<Mapper>> make_mapper(const std::string& name,
                                            const Plugins& plugins,
                                            std::optional<double> finest_m) {
  const auto unconfigured = plugins.make<Mapper>(name);
  if (!unconfigured) {
    return Error{ErrorCode::not_found,
                 "no mapper \"" + name + "\"; there are: " + listed(plugins.names<Mapper>())};
  }
  KernelSettings chosen;
  chosen.mapper = name;
  const auto specs = unconfigured->parameters();
  const bool has_finest = std::any_of(specs.begin(), specs.end(), [](const ParameterSpec& spec) {
    return spec.name == "finest_m";
  });
  if (finest_m && has_finest) {
    chosen.mapper_parameters["finest_m"] = *finest_m;
  }
  return make_kernel<Mapper>(plugins, chosen);
}

Result<MappingRun> map_recording(const Recording& recording,
                                 const std::vector<TimedPose>& poses,
                                 const MappingSettings& settings,
                                 Mapper& mapper,
                                 const std::function<bool()>& stop) {
  if (const Status usable = check(recording); !usable) {
    return usable.error();
  }
  MappingRun run;
  const auto step = static_cast<std::size_t>(std::max(1, settings.every));
  for (std::size_t i = 0; i < recording.frames.size() && !stop(); i += step) {
    ++run.frames;
    const auto X_WB = pose_between(poses, recording.frames[i].stamp, settings.widest_gap);
    if (!X_WB) {
      ++run.without_pose;
      continue;
    }
    const auto frame = load_frame(recording, i);
    if (!frame) {
      return frame.error();
    }
    const auto work = mapper.prepare(cloud_of(*frame, i, settings.map.range_m),
                                     *X_WB * recording.X_BC, settings.map);
    if (!work) {
      return work.error();
    }
    mapper.commit();
    run.rays += work->count("rays");
    run.updates += work->count("updates");
  }
  if (run.frames > 0 && run.without_pose == run.frames) {
    return Error{ErrorCode::invalid_input,
                 "none of " + std::to_string(run.frames) +
                     " frames has a pose at its time; give poses of this recording, whose times "
                     "are its own"};
  }
  return run;
}

}  // namespace flyball
