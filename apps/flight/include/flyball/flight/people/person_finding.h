// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// When a search believes that it has found somebody. A detector often mistakes something for a
/// person once, but seldom the same thing from several sides.

#include "flyball/flight/flight_settings.h"
#include "flyball/flight/people/person_search.h"
#include "flyball/runtime/colour_frame.h"

#include <optional>
#include <vector>

namespace flyball {

/// A person whom the vehicle believes it has found.
struct Finding {
  MissionTime at{};
  Vec3 p_W{Vec3::Zero()};  ///< Mean place of the sightings that agree.
  Sighting last{};
  ColourFrame frame{};  ///< Of the last sighting.
};

/// Somebody whom too few sightings show.
struct Doubt {
  Vec3 p_W{Vec3::Zero()};
  Vec3 from_W{Vec3::Zero()};  ///< Where the camera was when it showed them.
};

/// Counts sightings that agree. A finding takes `SearchSettings::sightings` of them within
/// `within_m` of each other along the ground, each made at least `apart_m` away from where the
/// earlier ones were made.
class PersonFinding {
 public:
  explicit PersonFinding(const SearchSettings& settings) : settings_{settings} {}

  /// @param from_W  Where the camera was.
  /// @return        The finding that this sighting completes; never more than one in a mission.
  [[nodiscard]] std::optional<Finding> add(MissionTime now,
                                           const Sighting& sighting,
                                           const ColourFrame& frame,
                                           const Vec3& from_W);
  /// Where to look once more; each place once.
  [[nodiscard]] std::optional<Doubt> take_doubt();
  [[nodiscard]] bool has_found() const { return has_found_; }
  [[nodiscard]] std::size_t places() const { return places_.size(); }

 private:
  struct Place {
    Vec3 sum_W{Vec3::Zero()};
    std::vector<Vec3> from_W{};
    bool is_taken{};
    [[nodiscard]] Vec3 mean_W() const { return sum_W / static_cast<double>(from_W.size()); }
  };
  [[nodiscard]] Place& place_near(const Vec3& p_W);

  SearchSettings settings_;
  std::vector<Place> places_{};
  bool has_found_{};
};

}  // namespace flyball
