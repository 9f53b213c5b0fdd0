// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/people/person_finding.h"

#include <algorithm>

namespace flyball {

PersonFinding::Place& PersonFinding::place_near(const Vec3& p_W) {
  for (Place& place : places_) {
    if ((place.mean_W() - p_W).head<2>().norm() <= settings_.within_m) {
      return place;
    }
  }
  return places_.emplace_back();
}

std::optional<Doubt> PersonFinding::take_doubt() {
  const auto place =
      std::find_if(places_.begin(), places_.end(), [](const Place& one) { return !one.is_taken; });
  if (has_found_ || place == places_.end()) {
    return std::nullopt;
  }
  place->is_taken = true;
  return Doubt{place->mean_W(), place->from_W.back()};
}

std::optional<Finding> PersonFinding::add(MissionTime now,
                                          const Sighting& sighting,
                                          const ColourFrame& frame,
                                          const Vec3& from_W) {
  Place& place = place_near(sighting.p_W);
  const bool is_news = std::all_of(
      place.from_W.begin(), place.from_W.end(),
      [&](const Vec3& other_W) { return (other_W - from_W).norm() >= settings_.apart_m; });
  if (!is_news) {
    return std::nullopt;
  }
  place.sum_W += sighting.p_W;
  place.from_W.push_back(from_W);
  if (has_found_ || static_cast<int>(place.from_W.size()) < settings_.sightings) {
    return std::nullopt;
  }
  has_found_ = true;
  return Finding{now, place.mean_W(), sighting, frame};
}

}  // namespace flyball
