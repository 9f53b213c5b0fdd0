// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/flown_way.h"

#include <algorithm>
#include <cstddef>

namespace flyball {
namespace {

constexpr double between_places_m = 0.1;  // Chosen: a bend of 1 m stays within 2 mm of such chords.
constexpr double same_m = 0.3;  // Chosen: between places so near to each other there is no wall.
constexpr std::size_t least_loop = 30;  // Chosen: 3 m; a vehicle that hovers makes no loop.
constexpr double jump_m = 0.5;          // Chosen: farther than the vehicle flies between two ticks.
constexpr double joint_m = 3.0;         // Chosen: so far from the way a search may have led.

}  // namespace

void FlownWay::flew(const Vec3& p_W) {
  if (places_W_.empty()) {
    places_W_.push_back(p_W);
    return;
  }
  const double from_last_m = (places_W_.back() - p_W).norm();
  if (from_last_m < between_places_m) {
    return;
  }
  if (from_last_m > jump_m) {
    go_on_from(p_W);
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

// The vehicle has come here without a record of its way: it went back, was lost or flew home.
void FlownWay::go_on_from(const Vec3& p_W) {
  const auto last = nearest(p_W, beside_way_m);
  places_W_.resize(last ? *last + 1 : 0);
}

std::optional<std::size_t> FlownWay::nearest(const Vec3& p_W, double within_m) const {
  const auto is_nearer = [&p_W](const Vec3& a_W, const Vec3& b_W) {
    return (a_W - p_W).squaredNorm() < (b_W - p_W).squaredNorm();
  };
  const auto place = std::min_element(places_W_.begin(), places_W_.end(), is_nearer);
  if (place == places_W_.end() || (*place - p_W).norm() > within_m) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(place - places_W_.begin());
}

bool FlownWay::leads_to(const Vec3& goal_W) const {
  return nearest(goal_W, beside_way_m).has_value();
}

std::vector<Vec3> FlownWay::between(const Vec3& start_W, const Vec3& goal_W, double most_m) const {
  const auto from = nearest(start_W, joint_m);
  const auto to = nearest(goal_W, beside_way_m);
  if (!from || !to) {
    return {};
  }
  std::size_t at = *from;
  std::vector<Vec3> way_W{start_W, places_W_[at]};
  double length_m = (way_W[1] - way_W[0]).norm();
  while (at != *to && (most_m <= 0.0 || length_m < most_m)) {
    at = at < *to ? at + 1 : at - 1;
    length_m += (places_W_[at] - way_W.back()).norm();
    way_W.push_back(places_W_[at]);
  }
  return way_W;
}

}  // namespace flyball
