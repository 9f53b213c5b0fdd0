// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/conformance/path_tracker_conformance.h"

#include "kernel_trials.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

class PathTrackerCulprit final : public PathTracker {
 public:
  explicit PathTrackerCulprit(std::string crime) : crime_{std::move(crime)} {}

  Setpoint track(const Path& path,
                 const PathReference& reference,
                 const PoseEstimate& where,
                 MissionTime now) override {
    Setpoint set = honest_->track(path, reference, where, now);
    if (crime_ == "drifts" && path.empty()) {
      set.v_WB.x() = 0.1;
    } else if (crime_ == "repels" && !path.empty()) {
      set.v_WB -= 2.0 * (set.p_WB - where.X_WB.translation());
    } else if (crime_ == "leaps" && !path.empty()) {
      set.v_WB += set.p_WB - where.X_WB.translation();
    } else if (crime_ == "timeless") {
      set.stamp = {};
    } else if (crime_ == "sideways") {
      set.p_WB.y() += 0.1;
    } else if (crime_ == "slow") {
      set.v_WB *= 0.9;
    } else if (crime_ == "backwards") {
      set.a_WB = -set.a_WB;
    } else if (crime_ == "blind") {
      set.yaw_rad = 0.0;
    } else if (crime_ == "corner" && !path.empty()) {
      const double curvature_1_m = path.at(reference.s_m).curvature_1_m;
      set.a_WB.x() += 0.0025 * (curvature_1_m - curvature_1_m);  // Not a number at the corner.
    } else if (crime_ == "remembers") {
      set.v_WB.z() += 1e-9 * all_missions_++;
    }
    return set;
  }

 private:
  inline static int all_missions_ = 0;
  std::string crime_;
  std::unique_ptr<PathTracker> honest_{kit::kernels().make<PathTracker>("feedforward_pd")};
};

TEST(PathTrackers, keep_their_contract) {
  kit::try_all_registered<PathTrackerConformance, PathTracker>();
}

TEST(PathTrackerConformance, finds_each_kind_of_breach) {
  kit::expect_crimes_found<PathTrackerConformance, PathTracker>(
      [](const std::string& crime) { return std::make_unique<PathTrackerCulprit>(crime); },
      {{"drifts", "moves without a path"},
       {"repels", "does not correct towards the path"},
       {"leaps", "turns a jump of the estimate into a jump of the vehicle"},
       {"timeless", "does not stamp the set-point"},
       {"sideways", "commands a place beside the path"},
       {"slow", "commands another velocity"},
       {"backwards", "does not feed the reference's acceleration forward"},
       {"blind", "does not command the reference's yaw"},
       {"corner", "asks for something impossible at a corner"},
       {"remembers", "begins a mission with what it learnt in another one"}});
}

}  // namespace
}  // namespace flyball
