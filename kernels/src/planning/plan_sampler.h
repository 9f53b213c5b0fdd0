// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Where a sampling planner looks next: anywhere, or at a narrow passage.

#include "flyball/runtime/random.h"

#include "maps/gap_finder.h"
#include "planning/motion_checker.h"
#include <limits>
#include <vector>

namespace flyball {

struct SampleRegion {
  Aabb box_W{};
  Vec3 start_W{Vec3::Zero()};
  Vec3 goal_W{Vec3::Zero()};
  double shorter_than_m{std::numeric_limits<double>::infinity()};  ///< Of paths over the samples.
};

/// Mixes samples of the whole box, mostly near the heights of start and goal, with samples on
/// both sides of narrow passages. Looks for passages only after a number of plain samples, for an
/// easy plan shall not pay for them; at once where a shorter path is looked for. Same seed and map,
/// same samples.
class PlanSampler {
 public:
  /// The checker outlives the sampler.
  PlanSampler(MotionChecker& checker, const SampleRegion& region, std::uint64_t seed);

  [[nodiscard]] Vec3 draw();
  [[nodiscard]] int draws() const { return draws_; }

 private:
  /// A place on each side from which the body flies straight through.
  struct Passage {
    Vec3 front_W{Vec3::Zero()};
    Vec3 back_W{Vec3::Zero()};
  };

  [[nodiscard]] bool is_wanted(const Vec3& p_W) const;
  [[nodiscard]] Vec3 draw_anywhere();
  [[nodiscard]] Vec3 draw_at_passage();
  void find_passages();
  [[nodiscard]] bool has_ceiling(const Vec3& over_W);
  void add_passages(const GapGroup& gaps);

  MotionChecker& checker_;
  SampleRegion region_;
  RandomStream random_;
  std::vector<std::vector<Passage>> passages_;  ///< In groups: those of one door.
  std::vector<Vec3> next_;                      ///< Last one first.
  bool searched_{false};
  int draws_{};
};

}  // namespace flyball
