// SPDX-License-Identifier: BSD-3-Clause
#include "planning/plan_sampler.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flyball {
namespace {

// Measured with tests/kernels/rrt_test.cpp: an open plan needs fewer, a door more.
constexpr int plain_draws = 48;
constexpr int most_redraws = 32;
constexpr double gap_share = 0.5;
constexpr double level_share = 0.75;  // Of the plain samples: near the line's height.
constexpr double level_spread_m = 0.25;
constexpr double before_m = 0.1;  // From a passage's end to the body. Chosen: less than a cell.
constexpr double same_height_m = 0.3;  // Chosen: two fine cells.
constexpr double ceiling_m = 1.2;      // Chosen: so far above a vehicle is a room's ceiling.
constexpr double lower_m = 0.5;        // Chosen: from under a ceiling to under a lintel.

}  // namespace

PlanSampler::PlanSampler(MotionChecker& checker, const SampleRegion& region, std::uint64_t seed)
    : checker_{checker}, region_{region}, random_{seed, "plan_sampler"} {}

Vec3 PlanSampler::draw() {
  ++draws_;
  const bool wants_shorter = std::isfinite(region_.shorter_than_m);
  if (!searched_ && (wants_shorter || draws_ > plain_draws)) {
    find_passages();
  }
  if (!next_.empty() || (!passages_.empty() && random_.uniform() < gap_share)) {
    return draw_at_passage();
  }
  // The ellipsoid of short paths may hold little of the box, but never nothing.
  Vec3 p_W = region_.box_W.nearest(draw_anywhere());
  for (int i = 1; i < most_redraws && !is_wanted(p_W); ++i) {
    p_W = region_.box_W.nearest(draw_anywhere());
  }
  return p_W;
}

/// In the box, and a path over it may be short enough.
bool PlanSampler::is_wanted(const Vec3& p_W) const {
  return region_.box_W.contains(p_W) &&
         (p_W - region_.start_W).norm() + (region_.goal_W - p_W).norm() < region_.shorter_than_m;
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

// Both sides of a passage in a row, each twice: a planner with two trees takes turns, and a tree
// that has reached one side goes straight on to the other.
Vec3 PlanSampler::draw_at_passage() {
  if (next_.empty()) {
    const auto pick = [this](std::size_t size) {
      return static_cast<std::size_t>(random_.uniform() * static_cast<double>(size));
    };
    const std::vector<Passage>& group = passages_[pick(passages_.size())];
    // The narrowest of a door is the one square to it.
    const Passage& passage = group[random_.uniform() < 0.5 ? 0 : pick(group.size())];
    const bool forth = random_.uniform() < 0.5;
    const Vec3& first_W = forth ? passage.front_W : passage.back_W;
    const Vec3& second_W = forth ? passage.back_W : passage.front_W;
    next_ = {second_W, second_W, first_W, first_W};
  }
  Vec3 p_W = next_.back();
  next_.pop_back();
  return p_W;
}

void PlanSampler::find_passages() {
  searched_ = true;
  std::vector<double> heights_m{region_.start_W.z()};
  if (std::abs(region_.goal_W.z() - region_.start_W.z()) > same_height_m) {
    heights_m.push_back(region_.goal_W.z());
  }
  // A door ends below the ceiling, and a vehicle right under the ceiling would see none.
  const double lower_z_m = std::min(heights_m.front(), heights_m.back()) - lower_m;
  if (lower_z_m > region_.box_W.min.z() && has_ceiling(region_.start_W)) {
    heights_m.push_back(lower_z_m);
  }
  for (const double height_m : heights_m) {
    Aabb layer = region_.box_W;
    layer.min.z() = height_m - checker_.body().half_height_m;
    layer.max.z() = height_m + checker_.body().half_height_m;
    for (const GapGroup& gaps : find_gaps(checker_, layer)) {
      add_passages(gaps);
    }
  }
}

bool PlanSampler::has_ceiling(const Vec3& over_W) {
  const Vec3 body{checker_.body().radius_m, checker_.body().radius_m, 0.0};
  return checker_.has_occupied({over_W - body, over_W + body + ceiling_m * Vec3::UnitZ()});
}

/// Those of a group that the body passes; the narrowest stays first.
void PlanSampler::add_passages(const GapGroup& gaps) {
  std::vector<Passage> passages;
  for (const Gap& gap : gaps) {
    const Vec3 through{-gap.across_W.y(), gap.across_W.x(), 0.0};
    const Vec3 aside_W = (checker_.body().radius_m + before_m) * through;
    const Passage passage{gap.centre_W - aside_W, gap.centre_W + aside_W};
    if (is_wanted(passage.front_W) && is_wanted(passage.back_W) &&
        checker_.is_flyable(passage.front_W, passage.back_W)) {
      passages.push_back(passage);
    }
  }
  if (!passages.empty()) {
    passages_.push_back(std::move(passages));
  }
}

}  // namespace flyball
