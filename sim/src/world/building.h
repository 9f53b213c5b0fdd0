// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A one-storey building of rooms, doors and furniture, for the world generators.

#include "flyball/runtime/random.h"
#include "flyball/runtime/result.h"
#include "flyball/sim/world.h"

#include <vector>

namespace flyball {

/// Rooms stand in `rows` along x and `columns` along y. Wall centres lie on multiples of .15 m, and
/// walls are .15 m thick, so that their faces are in the middle of .15 m voxels: depth noise then
/// does not thicken them.
struct BuildingPlan {
  double facade_x_m{};  ///< Centre of the outer wall that faces -x; a multiple of .15.
  int rows{4};
  int columns{3};            ///< Odd: the entrance is in the middle one.
  double room_depth_m{9.0};  ///< Between wall centres, along x; a multiple of .15.
  double room_width_m{10.2};
  double door_width_m{0.82};
  double most_door_width_m{};  ///< Above `door_width_m`: each door's width is drawn between them.
  double entrance_y_m{};       ///< Wish; kept .5 m away from the corners of the room behind it.
  bool has_exit{false};        ///< A door in the last wall too, in the middle column.
  bool fine_doors{true};       ///< See `door_centre_m`.
  int furniture_per_room{4};
  Vec3 keep_clear_W{Vec3::Zero()};  ///< No furniture within 1.3 m.
};

constexpr double half_wall_m = 0.075;  ///< Faces in the middle of voxels.
constexpr double ceiling_z_m = 2.775;  ///< In the middle of a voxel.

/// The nearest multiple of .15 m, where wall centres lie.
[[nodiscard]] double on_wall_grid(double x_m);

/// A stretch of wall between two crossings, from wall centre to wall centre.
struct WallStretch {
  bool along_y{};
  double at_m{};   ///< Across the wall.
  double low_m{};  ///< Along it.
  double high_m{};
};

/// Opening in a wall, as seen from above.
struct Doorway {
  Aabb opening_W{};     ///< Through the wall, from the ground to the lintel.
  bool wall_along_y{};  ///< The wall's direction.
};

struct Building {
  std::vector<Aabb> boxes{};
  std::vector<Doorway> doors{};  ///< The entrance first.
  Aabb extent_W{};
};

/// Where the centre of a door goes that was wished at `wish_m`, within [low_m, high_m].
///
/// Fine doors have their centre on the centre of a .15 m voxel (cells are [k r, (k + 1) r)), so
/// that .75 m of an .82 m door stay free in full voxels, and no .80 m cell lies wholly inside the
/// opening, so that at .80 m it is shut. For a width that makes the second impossible the first
/// holds alone.
[[nodiscard]] double door_centre_m(const BuildingPlan& plan,
                                   double wish_m,
                                   double low_m,
                                   double high_m);

void add_wall(Building& building, const WallStretch& stretch);
/// The door is kept .5 m away from the corners.
void add_wall_with_door(Building& building,
                        const WallStretch& stretch,
                        BuildingPlan plan,
                        double wish_m,
                        RandomStream& random);
/// Boxes on the room's floor, a passage away from each other, from the building's doors so far and
/// from what the plan keeps clear.
void furnish(Building& building, const Aabb& room, const BuildingPlan& plan, RandomStream& random);
/// Over the building's extent, whose height it sets.
void add_ceiling(Building& building);

/// From `least_m` up to `most_m`. Fine doors are wider by whole pairs of .15 m voxels, so that
/// their jambs lie as deep in their voxels as those of the narrowest one: a jamb just beyond a
/// voxel's face is seen only from within the door, when the vehicle is there.
[[nodiscard]] double door_width_m(double least_m, double most_m, bool fine, RandomStream& random);

/// @pre The plan's rooms are larger than a door and 2 m.
[[nodiscard]] Building make_building(const BuildingPlan& plan, RandomStream& random);

}  // namespace flyball
