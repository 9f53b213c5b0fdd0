// SPDX-License-Identifier: BSD-3-Clause
//
// A storey of a building after an earthquake: cross walls with holes broken through them, slabs
// that lean from the floor or hang from the ceiling, rubble, and one person behind the last wall.
// The vehicle stands inside, by the west wall.

#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"
#include "flyball/runtime/text/number_text.h"
#include "flyball/sim/world.h"

#include "world/building.h"
#include <algorithm>
#include <utility>

namespace {

using flyball::Aabb;
using flyball::BuildingPlan;
using flyball::Material;
using flyball::RandomStream;
using flyball::Vec3;

constexpr double start_m = 1.5;            // From the west wall.
constexpr double lowest_m = 0.5;           // Of the body's centre.
constexpr double below_ceiling_m = 0.675;  // The body, its tube, and a hand's breadth of air.
constexpr double sill_z_m = 0.375;         // Of a hole; in the middle of a voxel, as its top.
constexpr double top_z_m = 2.025;
constexpr double step_m = 0.15;        // Of a slab, which is a stair of boxes.
constexpr double slab_m = 0.12;        // Thick: a usual concrete floor less its screed.
constexpr double passage_m = 1.6;      // Kept free around start and holes.
constexpr double behind_wall_m = 1.6;  // Between the last cross wall and the person, at least, ...
constexpr double before_wall_m = 1.0;  // ... and from there to the east wall.
constexpr double person_room_m = 1.0;  // Kept free around the person.
constexpr double lying_m = 0.31;       // Of the figure "victim", .176 of its length of 1.75 m.
constexpr int tries = 60;

double apart_m(const Aabb& box, const Vec3& place_W) {
  const Vec3 nearest = box.nearest(place_W);
  return (nearest - place_W).head<2>().norm();
}

/// What is being built, and what has to stay free.
struct Ruin {
  flyball::World world{};
  double length_m{};
  double half_width_m{};
  std::vector<std::pair<Vec3, double>> free{};  ///< Places, and how far around them.

  [[nodiscard]] bool fits(const Aabb& box) const {
    return box.min.x() > 0.1 && box.max.x() < length_m - 0.1 && box.min.y() > 0.1 - half_width_m &&
           box.max.y() < half_width_m - 0.1 &&
           std::all_of(free.begin(), free.end(), [&](const auto& place) {
             return apart_m(box, place.first) >= place.second;
           });
  }
};

class CollapsedBuilding final : public flyball::WorldGenerator {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"length_m", 15.0, 9.0, 60.0, "From the west wall to the east one."},
            {"width_m", 10.5, 6.0, 60.0, "Of the storey."},
            {"walls", 2.0, 1.0, 8.0, "Cross walls, each with a hole."},
            {"hole_m", 1.1, 0.75, 3.0, "Width of a hole."},
            {"slabs", 4.0, 0.0, 30.0, "Fallen floors wished."},
            {"rubble", 16.0, 0.0, 200.0, "Heaps wished."},
            {"indoor_speed_m_s", 1.0, 0.1, 10.0, "Limit everywhere."},
            {"person",
             std::string{"standing"},
             0.0,
             0.0,
             "How the person is found; who lies, by yolo.",
             {"standing", "lying"}}};
  }

  [[nodiscard]] flyball::Result<flyball::World> make(const flyball::Parameters& given,
                                                     std::uint64_t seed) const override {
    RandomStream walls{seed, "world/collapsed_building/walls"};
    RandomStream debris{seed, "world/collapsed_building/debris"};
    RandomStream person{seed, "world/collapsed_building/person"};
    Ruin ruin;
    ruin.length_m = flyball::on_wall_grid(given.number("length_m"));
    const auto cross_walls = static_cast<int>(given.number("walls"));
    if (!has_room(ruin.length_m, cross_walls)) {
      int most = cross_walls;
      while (most > 0 && !has_room(ruin.length_m, most)) {
        --most;
      }
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "world \"collapsed_building\": walls = " + std::to_string(cross_walls) +
                                " leaves no room for start and person in a length_m of " +
                                flyball::short_number_text(ruin.length_m) +
                                "; lengthen it, or have at most " + std::to_string(most) +
                                " walls"};
    }
    ruin.half_width_m = flyball::on_wall_grid(0.5 * given.number("width_m"));
    ruin.world.start_W = ruin.world.goal_W = {start_m, 0.0, 0.0};
    ruin.free.emplace_back(ruin.world.start_W, passage_m);
    flyball::Building building = shell(ruin);
    const double last_wall_m = add_walls(ruin, building, given, walls);
    ruin.world.boxes = building.boxes;
    add_person(ruin, last_wall_m, given.text("person") == "lying", person);
    for (int i = 0; i < static_cast<int>(given.number("slabs")); ++i) {
      add_slab(ruin, debris);
    }
    for (int i = 0; i < static_cast<int>(given.number("rubble")); ++i) {
      add_rubble(ruin, debris);
    }
    declare(ruin, building.extent_W, given.number("indoor_speed_m_s"));
    return std::move(ruin.world);
  }

 private:
  /// Between the west wall and the first cross wall, and behind the last one.
  static bool has_room(double length_m, int walls) {
    const double first_m = wall_at_m(length_m, 1, walls);
    const double last_m = wall_at_m(length_m, walls, walls);
    return walls == 0 || (first_m - flyball::half_wall_m - start_m >= 1.0 &&
                          last_m + behind_wall_m <= length_m - before_wall_m);
  }
  /// Where one of them stands.
  static double wall_at_m(double length_m, int number, int walls) {
    return flyball::on_wall_grid(length_m * number / (walls + 1.0));
  }

  static flyball::Building shell(const Ruin& ruin) {
    const double w = ruin.half_width_m;
    flyball::Building building;
    const Vec3 wall{flyball::half_wall_m, flyball::half_wall_m, 0.0};
    building.extent_W = {Vec3{0.0, -w, 0.0} - wall, Vec3{ruin.length_m, w, 0.0} + wall};
    add_wall(building, {true, 0.0, -w, w});
    add_wall(building, {true, ruin.length_m, -w, w});
    add_wall(building, {false, -w, 0.0, ruin.length_m});
    add_wall(building, {false, w, 0.0, ruin.length_m});
    add_ceiling(building);
    return building;
  }

  /// @return Where the last one stands.
  static double add_walls(Ruin& ruin,
                          flyball::Building& building,
                          const flyball::Parameters& given,
                          RandomStream& random) {
    const int walls = static_cast<int>(given.number("walls"));
    BuildingPlan plan;
    plan.door_width_m = given.number("hole_m");
    double at_m = 0.0;
    for (int i = 1; i <= walls; ++i) {
      at_m = wall_at_m(ruin.length_m, i, walls);
      const double reach_m = ruin.half_width_m - 0.5 * plan.door_width_m - 0.6;
      const double hole_m =
          door_centre_m(plan, random.uniform(-reach_m, reach_m), -reach_m, reach_m);
      add_holed_wall(ruin, building, at_m, {hole_m, 0.5 * plan.door_width_m});
      ruin.free.emplace_back(Vec3{at_m, hole_m, 0.0}, passage_m);
    }
    return at_m;
  }

  struct Hole {
    double centre_m;
    double half_m;
  };
  static void add_holed_wall(const Ruin& ruin,
                             flyball::Building& building,
                             double at_m,
                             const Hole& hole) {
    const double w = ruin.half_width_m;
    const double left_m = hole.centre_m - hole.half_m;
    const double right_m = hole.centre_m + hole.half_m;
    const auto add = [&](double from_m, double to_m, double low_m, double high_m) {
      building.boxes.push_back({{at_m - flyball::half_wall_m, from_m, low_m},
                                {at_m + flyball::half_wall_m, to_m, high_m}});
    };
    add(-w, left_m, 0.0, flyball::ceiling_z_m);
    add(right_m, w, 0.0, flyball::ceiling_z_m);
    add(left_m, right_m, 0.0, sill_z_m);
    add(left_m, right_m, top_z_m, flyball::ceiling_z_m);
  }

  static void add_person(Ruin& ruin, double last_wall_m, bool lies, RandomStream& random) {
    for (int i = 0; i < tries; ++i) {
      const double x_m = random.uniform(last_wall_m + behind_wall_m, ruin.length_m - before_wall_m);
      const double y_m = random.uniform(1.0 - ruin.half_width_m, ruin.half_width_m - 1.0);
      const Vec3 foot_W{x_m, y_m, 0.0};
      const double to_hole_m = (ruin.free.back().first - foot_W).head<2>().norm();
      if (to_hole_m < 2.0 && i + 1 < tries) {
        continue;
      }
      flyball::Person person;
      if (lies) {
        person.look = "victim";
        person.lies = true;
        person.radius_m = 0.5 * person.height_m;
        person.height_m = lying_m;
      } else {
        person.look = "walker";
      }
      person.walk = {{0.0, foot_W}};
      person.heading_rad = random.uniform(-3.0, 3.0);
      ruin.world.people.push_back(person);
      ruin.free.emplace_back(foot_W, person_room_m);
      return;
    }
  }

  /// A stair of boxes that leans from the floor up, or hangs from the ceiling down.
  static void add_slab(Ruin& ruin, RandomStream& random) {
    for (int i = 0; i < tries; ++i) {
      const bool along_y = random.uniform() < 0.5;
      const bool hangs = random.uniform() < 0.4;
      const double slope = random.uniform(0.4, 1.2);
      const int steps = static_cast<int>(random.uniform(8.0, 16.0));
      const double width_m = random.uniform(1.2, 2.4);
      const double x_m = random.uniform(0.0, ruin.length_m);
      const double y_m = random.uniform(-ruin.half_width_m, ruin.half_width_m);
      const double run_m = steps * step_m;
      Aabb ground{{x_m, y_m, 0.0}, {x_m, y_m, flyball::ceiling_z_m}};
      ground.max.x() += along_y ? width_m : run_m;
      ground.max.y() += along_y ? run_m : width_m;
      if (!ruin.fits(ground)) {
        continue;
      }
      for (int k = 0; k < steps; ++k) {
        add_step(ruin, ground, {along_y, hangs, slope, k});
      }
      return;
    }
  }

  struct Step {
    bool along_y;
    bool hangs;
    double slope;
    int number;
  };
  static void add_step(Ruin& ruin, const Aabb& ground, const Step& step) {
    const Eigen::Index axis = step.along_y ? 1 : 0;
    const double rise_m = step.slope * step_m;
    const double low_m = step.hangs ? flyball::ceiling_z_m - (step.number + 1) * rise_m - slab_m
                                    : step.number * rise_m;
    Aabb box = ground;
    box.min[axis] = ground.min[axis] + step.number * step_m;
    box.max[axis] = box.min[axis] + step_m;
    box.min.z() = std::max(0.0, low_m);
    box.max.z() = std::min(flyball::ceiling_z_m, low_m + rise_m + slab_m);
    if (box.max.z() > box.min.z() + 0.01) {
      add_broken(ruin, box, Material::gravel);
    }
  }

  /// What has come down shows what it is made of: concrete with its gravel, or masonry. What stands
  /// is plastered.
  static void add_broken(Ruin& ruin, const Aabb& box, Material material) {
    ruin.world.box_materials.resize(ruin.world.boxes.size(), Material::plaster);
    ruin.world.boxes.push_back(box);
    ruin.world.box_materials.push_back(material);
  }

  static void add_rubble(Ruin& ruin, RandomStream& random) {
    for (int i = 0; i < tries; ++i) {
      Vec3 size = Vec3::Zero();
      Vec3 corner = Vec3::Zero();
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        size[axis] = random.uniform(0.2, 0.8);
      }
      corner.x() = random.uniform(0.0, ruin.length_m);
      corner.y() = random.uniform(-ruin.half_width_m, ruin.half_width_m);
      const Aabb heap{corner, corner + size};
      if (ruin.fits(heap)) {
        add_broken(ruin, heap, Material::brick);
        return;
      }
    }
  }

  static void declare(Ruin& ruin, const Aabb& extent_W, double speed_m_s) {
    flyball::World& world = ruin.world;
    world.volume_W = extent_W;
    world.volume_W.max.z() = flyball::ceiling_z_m;
    world.bounds_W = world.volume_W;
    world.bounds_W.min.z() = lowest_m;
    world.bounds_W.max.z() -= below_ceiling_m;
    world.zones = {{extent_W, speed_m_s}};
    world.cruise_height_m = 1.2;
    world.ground_material = Material::gravel;
  }
};

}  // namespace

FLYBALL_PLUGIN(collapsed_building) {
  registry.add<flyball::WorldGenerator>("collapsed_building",
                                        [] { return std::make_unique<CollapsedBuilding>(); });
}
