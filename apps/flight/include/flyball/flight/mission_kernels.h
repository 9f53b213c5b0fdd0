// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The kernels of one mission. Each is called by one node alone.

#include "flyball/kernels/collision_check.h"
#include "flyball/kernels/coverage_planner.h"
#include "flyball/kernels/detector.h"
#include "flyball/kernels/explorer.h"
#include "flyball/kernels/localizer.h"
#include "flyball/kernels/mapper.h"
#include "flyball/kernels/path_planner.h"
#include "flyball/kernels/path_tracker.h"
#include "flyball/kernels/point_cloud.h"
#include "flyball/kernels/smoother.h"
#include "flyball/kernels/tracker.h"

#include <memory>

namespace flyball {

/// Owners: the node that calls the kernel, and who set up the mission, who may use it before the
/// graph runs and after it has stopped. Of the localizer, `track_frame` and `add_imu_sample`
/// belong to the node `see`, the rest to the node `localize`.
struct MissionKernels {
  std::shared_ptr<PointCloudBuilder> point_cloud;
  std::shared_ptr<Mapper> mapper;
  std::shared_ptr<CollisionChecker> collision_check;
  std::shared_ptr<PathPlanner> planner;
  std::shared_ptr<Smoother> smoother;
  std::shared_ptr<PathTracker> path_tracker;
  std::shared_ptr<Localizer> localizer;
  std::shared_ptr<CoveragePlanner> coverage;
  std::shared_ptr<Explorer> explorer;
  std::shared_ptr<Detector> detector;         ///< These three only where the workload
  std::shared_ptr<Tracker> buffered_tracker;  ///< looks for people.
  std::shared_ptr<Tracker> real_time_tracker;
};

}  // namespace flyball
