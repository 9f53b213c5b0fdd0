// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The true world: solid boxes and pillars, people, and what a scenario declares about it.

#include "flyball/runtime/geometry.h"
#include "flyball/runtime/parameters.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/speed_zone.h"
#include "flyball/sim/movers.h"
#include "flyball/sim/person.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// What a surface looks like to a colour camera.
enum class Material : std::uint8_t { plaster, brick, wood, bark, leaves, grass, gravel, asphalt };

/// Upright cylinder standing between two heights (a trunk, a lamp post).
struct Pillar {
  Vec3 foot_W{Vec3::Zero()};
  double radius_m{};
  double height_m{};
  Material material{Material::bark};
};

struct World {
  Aabb bounds_W{};  ///< Where the vehicle may fly: planner bounds.
  double ground_z_m{};
  bool has_ground{true};      ///< A solid plane at `ground_z_m`.
  std::vector<Aabb> boxes{};  ///< Solid; may touch and overlap.
  std::vector<Pillar> pillars{};
  std::vector<Mover> movers{};  ///< `Clearance` leaves them out: `clearance_m` of movers.h.
  std::vector<Person> people{};
  Material ground_material{Material::grass};
  std::vector<Material> box_materials{};  ///< By index; plaster for boxes beyond its end.
  std::vector<SpeedZone> zones{};
  Vec3 start_W{Vec3::Zero()};   ///< On the ground, where the vehicle takes off.
  Vec3 goal_W{Vec3::Zero()};    ///< On the ground, where it delivers.
  double start_clear_m{1.0};    ///< No solid is closer to the vertical line over the start.
  double goal_clear_m{1.0};     ///< The same over the goal.
  double clear_height_m{2.5};   ///< Up to which both count.
  double cruise_height_m{1.5};  ///< Above ground.
  /// Nothing reaches higher than this above the ground, and the vehicle is told so; null where
  /// that is not so.
  std::optional<double> open_above_m{};
  Aabb volume_W{};  ///< To be explored; empty where there is nothing to explore.
};

/// Makes a world from a seed and parameters.
class WorldGenerator {
 public:
  WorldGenerator() = default;
  WorldGenerator(const WorldGenerator&) = delete;
  WorldGenerator& operator=(const WorldGenerator&) = delete;
  virtual ~WorldGenerator() = default;

  [[nodiscard]] virtual std::vector<ParameterSpec> parameters() const = 0;
  /// Same parameters and seed, same world. Start and goal are clear by at least 1 m up to 2.5 m
  /// height (a scanned place: by `start_clear_m` and `goal_clear_m` within the flight band).
  /// @error `not_found` (a file), `invalid_input` (parameters that contradict each other).
  [[nodiscard]] virtual Result<World> make(const Parameters& given, std::uint64_t seed) const = 0;
};

/// Distance queries against the true world's solids; people are no part of it, see
/// `distance_to_people_m`.
class Clearance {
 public:
  explicit Clearance(const World& world);
  /// Distance from the surface of the upright cylinder around `p_WB` to the nearest solid, at most
  /// `limit_m`; zero when they touch or overlap. The ground counts unless `ignore_ground`.
  /// @cost About .3 us among 150 solids, 6 us among 27 000.
  [[nodiscard]] double distance_m(const Vec3& p_WB,
                                  const Cylinder& body,
                                  double limit_m,
                                  bool ignore_ground) const;

 private:
  struct Column {
    int first_box{};
    int first_pillar{};
  };
  [[nodiscard]] double nearest_in(int column,
                                  const Vec3& p_WB,
                                  const Cylinder& body,
                                  double best_m) const;

  double ground_z_m_{};
  bool has_ground_{};
  std::vector<Aabb> boxes_{};
  std::vector<Pillar> pillars_{};
  double cell_m_{4.0};
  int columns_x_{1};
  int columns_y_{1};
  Vec3 origin_{Vec3::Zero()};
  std::vector<Column> columns_{};  ///< Row by row, one more at the end.
  std::vector<int> boxes_in_{};    ///< Box indices, column by column.
  std::vector<int> pillars_in_{};
};

/// Distance from the upright cylinder around `p_WB` to the nearest person's, at most `limit_m`;
/// zero when they touch.
[[nodiscard]] double distance_to_people_m(const std::vector<Person>& people,
                                          MissionTime now,
                                          const Vec3& p_WB,
                                          const Cylinder& body,
                                          double limit_m);

}  // namespace flyball
