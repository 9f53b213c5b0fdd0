// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// People in the true world: where they are at each moment of the mission, and how they look.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/random.h"
#include "flyball/runtime/time.h"

#include <string>
#include <vector>

namespace flyball {

struct WalkPoint {
  double time_s{};
  Vec3 foot_W{Vec3::Zero()};
};

struct PersonPose {
  Vec3 foot_W{Vec3::Zero()};
  double heading_rad{};
};

struct Person {
  std::string look{"walker"};  ///< A name of `person_looks()`.
  double height_m{1.75};  ///< Of the upright cylinder that depth cameras see and vehicles touch,
  double radius_m{0.3};   ///< as this is.
  /// In order of time; at even pace along the line between two points, before the first and after
  /// the last one at rest. One point: a person who stays. Never empty.
  std::vector<WalkPoint> walk{{}};
  double heading_rad{};  ///< Of a person who stays; a walker looks where it goes.
  /// On the back, feet towards the heading and the middle over the foot point: as long as the
  /// cylinder, which is a low one then, is wide.
  bool lies{};

  /// A function of time alone.
  [[nodiscard]] PersonPose at(MissionTime now) const;
  [[nodiscard]] Vec3 centre_W(MissionTime now) const {
    return at(now).foot_W + Vec3::UnitZ() * (0.5 * height_m);
  }
};

/// Names that `Person::look` may have.
[[nodiscard]] std::vector<std::string> person_looks();

/// A walk at random that stays within an area and away from what stands there.
struct WalkStyle {
  double duration_s{300.0};
  double speed_m_s{1.3};         ///< Comfortable pace of adults: Bohannon 1997, 1.3-1.5 m/s.
  double sprint_m_s{3.5};        ///< Jog.
  double sprint_share{0.2};      ///< Of the legs.
  double leg_m{6.0};             ///< Mean distance between two turns.
  double largest_turn_rad{1.0};  ///< Between two legs.
};

/// Discs that the walk keeps out of.
struct WalkObstacle {
  Vec3 centre_W{Vec3::Zero()};
  double radius_m{};
};

/// Legs from `start_W`, each a draw from `random`; where a leg would leave the area or come into an
/// obstacle, other turns are tried, and after 64 vain ones the person waits a second.
[[nodiscard]] std::vector<WalkPoint> random_walk(const Vec3& start_W,
                                                 const Aabb& area_W,
                                                 const std::vector<WalkObstacle>& obstacles,
                                                 const WalkStyle& style,
                                                 RandomStream random);

}  // namespace flyball
