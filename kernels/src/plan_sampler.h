// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Where a sampling planner looks next: anywhere, or at a narrow passage.

#include "flyball/runtime/random.h"

#include "gap_finder.h"
#include "motion_checker.h"
#include <vector>

namespace flyball {

struct SampleRegion {
  Aabb box_W{};
  Vec3 start_W{Vec3::Zero()};
  Vec3 goal_W{Vec3::Zero()};
};

/// Mixes samples of the whole box, mostly near the heights of start and goal, with samples in and
/// before narrow passages. Looks for passages only after a number of plain samples: an easy plan
/// does not pay for them. Same seed and map, same samples.
class PlanSampler {
 public:
  /// The checker outlives the sampler.
  PlanSampler(MotionChecker& checker, const SampleRegion& region, std::uint64_t seed);

  [[nodiscard]] Vec3 draw();
  [[nodiscard]] int draws() const { return draws_; }

 private:
  [[nodiscard]] Vec3 draw_anywhere();
  [[nodiscard]] Vec3 draw_at_gap();
  [[nodiscard]] Vec3 clamped(const Vec3& p_W) const;
  void find_passages();

  MotionChecker& checker_;
  SampleRegion region_;
  RandomStream random_;
  std::vector<GapGroup> passages_;
  bool searched_{false};
  int draws_{};
};

}  // namespace flyball
