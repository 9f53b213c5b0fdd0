// SPDX-License-Identifier: BSD-3-Clause
// tested-in: visual_slam
//
// What the estimate thinks of its own error.

#include "visual/motion.h"
#include "visual/slam.h"
#include <map>

namespace flyball {

// The solver takes its landmarks for independent. They are not: those of a keyframe share the depth
// camera's errors and lie on the same few surfaces. Measured over 16 settings of speed, rate and
// size on rendered views, the squared error is 2.7 to 6.4 times what it then expects.
constexpr double shared_errors = 5.0;

/// Keyframes err together, as each was found from the ones before: the mean of their covariances is
/// an upper bound of that of their mean.
Matrix6 Slam::uncertainty(const Found& found) const {
  std::map<std::size_t, int> anchors;
  int total = 0;
  for (std::size_t i = 0; i < found.matches.size(); ++i) {
    if (found.pose.fits[i]) {
      ++anchors[map_.landmark(found.matches[i].landmark).anchor];
      ++total;
    }
  }
  Matrix6 covariance = shared_errors * found.pose.covariance;
  const Pose X_CW = found.pose.X_WC.inverse();
  for (const auto& [anchor, count] : anchors) {
    const Keyframe& keyframe = map_.keyframes()[anchor];
    const Matrix6 by = carried(X_CW * keyframe.X_WC);
    covariance += static_cast<double>(count) / total * by * keyframe.covariance * by.transpose();
  }
  return covariance;
}

}  // namespace flyball
