// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/flown_way.h"

#include <algorithm>
#include <cstddef>

namespace flyball {
namespace {

constexpr double spacing_m = 0.1;  // Chosen: a bend of 1 m stays within 2 mm of such chords.
constexpr double same_m = 0.3;     // Chosen: between places so near to each other there is no wall.
constexpr std::size_t least_loop = 30;  // Chosen: 3 m; a vehicle that hovers makes no loop.
constexpr double near_goal_m = 1.0;     // Chosen: as near as way and goal are mostly seen together.

std::size_t nearest(const std::vector<Vec3>& places_W, const Vec3& p_W) {
  const auto is_nearer = [&p_W](const Vec3& a_W, const Vec3& b_W) {
    return (a_W - p_W).squaredNorm() < (b_W - p_W).squaredNorm();
  };
  return static_cast<std::size_t>(std::min_element(places_W.begin(), places_W.end(), is_nearer) -
                                  places_W.begin());
}

}  // namespace

void FlownWay::flew(const Vec3& p_W) {
  if (!places_W_.empty() && (places_W_.back() - p_W).norm() < spacing_m) {
    return;
  }
  const auto is_same = [&p_W](const Vec3& old_W) { return (old_W - p_W).norm() < same_m; };
  const auto loops_end =
      places_W_.end() - static_cast<std::ptrdiff_t>(std::min(least_loop, places_W_.size()));
  const auto first = std::find_if(places_W_.begin(), loops_end, is_same);
  if (first != loops_end) {
    places_W_.erase(first + 1, places_W_.end());
  }
  places_W_.push_back(p_W);
}

bool FlownWay::leads_to(const Vec3& goal_W) const {
  return !places_W_.empty() &&
         (places_W_[nearest(places_W_, goal_W)] - goal_W).norm() < near_goal_m;
}

std::vector<Vec3> FlownWay::between(const Vec3& start_W, const Vec3& goal_W) const {
  if (!leads_to(goal_W)) {
    return {};
  }
  const std::size_t from = nearest(places_W_, start_W);
  const std::size_t to = nearest(places_W_, goal_W);
  const auto begin = places_W_.begin() + static_cast<std::ptrdiff_t>(std::min(from, to));
  const auto end = places_W_.begin() + static_cast<std::ptrdiff_t>(std::max(from, to)) + 1;
  std::vector<Vec3> way_W{begin, end};
  if (from > to) {
    std::reverse(way_W.begin(), way_W.end());
  }
  return way_W;
}

}  // namespace flyball
