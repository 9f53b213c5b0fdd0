// SPDX-License-Identifier: BSD-3-Clause
// tested-in: platform_fit
#include "studies/fit_perception.h"

#include "flyball/flight/perception/perception_nodes.h"

#include "scenario/scenario_parameters.h"

namespace flyball {

Pose looking(const Vec3& p_W, double yaw_rad) {
  Pose X_WB = Pose::Identity();
  X_WB.linear() = Eigen::AngleAxisd{yaw_rad, Vec3::UnitZ()}.toRotationMatrix();
  X_WB.translation() = p_W;
  return X_WB;
}

Status Perception::look(const Pose& X_WB, KernelLoads& loads) {
  Work points;
  X_WC_ = camera_pose(X_WB, bench_.brief.settings.camera);
  view_ = bench_.kernels.point_cloud->build(camera_.frame(X_WC_, MissionTime{}, frames_++),
                                            range_m(), points);
  loads[bench_.brief.settings.kernels.point_cloud].calls.push_back(points);
  Work slam;
  slam.add("pixels", points.count("pixels"));
  loads["visual_slam"].calls.push_back(slam);
  const auto work = prepare(bench_.brief.settings.map.resolution_m);
  if (!work) {
    return work.error();
  }
  loads[mapper_cost(bench_.brief.settings.kernels)].calls.push_back(*work);
  bench_.kernels.mapper->commit();
  return Done{};
}

Result<Work> Perception::prepare(double resolution_m) {
  return bench_.kernels.mapper->prepare(view_.cloud_C.value(), X_WC_, {resolution_m, range_m()});
}

}  // namespace flyball
