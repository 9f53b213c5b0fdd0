// SPDX-License-Identifier: BSD-3-Clause
#include "plan_sampler.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace flyball {
namespace {

// Measured with tests/kernels/rrt_test.cpp: an open plan needs fewer, a door more.
constexpr int plain_draws = 48;
constexpr double gap_share = 0.5;
constexpr double level_share = 0.75;  // Of the plain samples: near the line's height.
constexpr double level_spread_m = 0.25;
constexpr double near_gap_m = 0.3;  // Approach points lie this far ...
constexpr double far_gap_m = 2.0;   // ... to this far before a passage.
constexpr double same_height_m = 0.3;

}  // namespace

PlanSampler::PlanSampler(MotionChecker& checker, const SampleRegion& region, std::uint64_t seed)
    : checker_{checker}, region_{region}, random_{seed, "plan_sampler"} {}

Vec3 PlanSampler::draw() {
  ++draws_;
  if (!searched_ && draws_ > plain_draws) {
    find_passages();
  }
  if (!passages_.empty() && random_.uniform() < gap_share) {
    return clamped(draw_at_gap());
  }
  return clamped(draw_anywhere());
}

Vec3 PlanSampler::draw_anywhere() {
  const Aabb& box = region_.box_W;
  Vec3 p{random_.uniform(box.min.x(), box.max.x()), random_.uniform(box.min.y(), box.max.y()), 0.0};
  if (random_.uniform() < level_share) {
    const Eigen::Vector2d line = (region_.goal_W - region_.start_W).head<2>();
    const double share =
        line.dot((p - region_.start_W).head<2>()) / std::max(line.squaredNorm(), 1e-9);
    const double height_m = region_.start_W.z() + std::clamp(share, 0.0, 1.0) *
                                                      (region_.goal_W.z() - region_.start_W.z());
    p.z() = height_m + level_spread_m * random_.normal();
  } else {
    p.z() = random_.uniform(box.min.z(), box.max.z());
  }
  return p;
}

Vec3 PlanSampler::draw_at_gap() {
  const auto pick = [this](std::size_t size) {
    return static_cast<std::size_t>(random_.uniform() * static_cast<double>(size));
  };
  const GapGroup& group = passages_[pick(passages_.size())];
  // The narrowest gap of a door is the one square to it.
  const Gap& gap = group[random_.uniform() < 0.5 ? 0 : pick(group.size())];
  const Vec3 through{-gap.across_W.y(), gap.across_W.x(), 0.0};
  const double play_m = std::max(0.0, 0.5 * gap.width_m - checker_.body().radius_m);
  const double aside_m = random_.uniform() < 0.25 ? random_.uniform(-play_m, play_m) : 0.0;
  const double before_m = random_.uniform(-far_gap_m, far_gap_m);
  const bool in_gap = std::abs(before_m) < near_gap_m;
  return gap.centre_W + aside_m * gap.across_W + (in_gap ? 0.0 : before_m) * through;
}

Vec3 PlanSampler::clamped(const Vec3& p_W) const {
  return p_W.cwiseMax(region_.box_W.min).cwiseMin(region_.box_W.max);
}

void PlanSampler::find_passages() {
  searched_ = true;
  std::vector<double> heights_m{region_.start_W.z()};
  if (std::abs(region_.goal_W.z() - region_.start_W.z()) > same_height_m) {
    heights_m.push_back(region_.goal_W.z());
  }
  for (const double height_m : heights_m) {
    Aabb layer = region_.box_W;
    layer.min.z() = height_m - checker_.body().half_height_m;
    layer.max.z() = height_m + checker_.body().half_height_m;
    auto found = find_gaps(checker_, layer);
    std::move(found.begin(), found.end(), std::back_inserter(passages_));
  }
}

}  // namespace flyball
