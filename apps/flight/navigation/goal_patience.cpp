// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/goal_patience.h"

#include <algorithm>

namespace flyball {
namespace {

constexpr double same_room_m = 6.0;    // Chosen: a room. From one place obstacles are doubted ...
constexpr int most_doubts = 3;         // ... so often, at most, on the way to a goal.
constexpr double nearer_m = 1.0;       // Chosen: less is an evasion, no progress to the goal.
constexpr double futile_limits = 3.0;  // Chosen: the patience of a standing vehicle so many times.

}  // namespace

void GoalPatience::begin(MissionTime now) {
  doubted_W_.clear();
  resume(now);
}

void GoalPatience::resume(MissionTime now) {
  without_path_since_ = nearer_since_ = now;
  nearest_m_ = std::numeric_limits<double>::infinity();
}

bool GoalPatience::may_doubt(const Vec3& here_W) {
  const auto is_near = [&](const Vec3& p_W) { return (p_W - here_W).norm() < same_room_m; };
  if (std::count_if(doubted_W_.begin(), doubted_W_.end(), is_near) >= most_doubts) {
    return false;
  }
  doubted_W_.push_back(here_W);
  return true;
}

bool GoalPatience::note(MissionTime now, std::optional<double> to_goal_m, bool rests) {
  if (!rests || !to_goal_m) {
    without_path_since_ = now;
  }
  if (!to_goal_m || *to_goal_m < nearest_m_ - nearer_m) {
    nearest_m_ = to_goal_m.value_or(std::numeric_limits<double>::infinity());
    nearer_since_ = now;
  }
  const bool is_futile =
      !doubted_W_.empty() && to_seconds(now - nearer_since_) > futile_limits * limit_s_;
  return is_futile || to_seconds(now - without_path_since_) > limit_s_;
}

}  // namespace flyball
