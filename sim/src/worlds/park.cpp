// SPDX-License-Identifier: BSD-3-Clause
//
// A lawn with a gravel path, young trees, benches, hedges and a person who walks, stops and jogs.
// All that stands here is lower than 3.2 m, so that a camera above it looks over the crowns; they,
// and the hedges, hide the person now and then.

#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"
#include "flyball/sim/world.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace {

using flyball::Aabb;
using flyball::Material;
using flyball::Pillar;
using flyball::Vec3;

constexpr double look_first_s = 12.0;  // The person stands until the vehicle is up and looks.
constexpr double person_ahead_m = 7.0;
constexpr double keep_clear_m = 4.0;  // Around the start, and where the person stands first.
constexpr int most_tries = 2000;

class Park final : public flyball::WorldGenerator {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"size_m", 80.0, 30.0, 300.0, "Of the lawn, each way."},
            {"trees", 40.0, 0.0, 400.0, "How many, with crowns of 1 m around."},
            {"hedges", 10.0, 0.0, 100.0, "How many, 1.2 m high and 4 m long."},
            {"benches", 8.0, 0.0, 100.0, "How many."},
            {"walk_speed_m_s", 1.3, 0.2, 3.0, "Of the person."},
            {"sprint_speed_m_s", 3.5, 0.2, 8.0, "Of the person, now and then."},
            {"sprint_share", 0.2, 0.0, 1.0, "Of the legs between two turns."},
            {"walk_time_s", 300.0, 10.0, 3600.0, "Then the person stands."}};
  }

  [[nodiscard]] flyball::Result<flyball::World> make(const flyball::Parameters& given,
                                                     std::uint64_t seed) const override {
    flyball::World world;
    const double half_m = 0.5 * given.number("size_m");
    world.bounds_W = {{-half_m, -half_m, 0.9}, {half_m, half_m, 12.0}};
    world.goal_W = {person_ahead_m, 0.0, 0.0};
    world.cruise_height_m = 4.5;
    world.open_above_m = 3.2;
    // Beside the start: the body would touch even 5 mm of it.
    add_box(world, {{-half_m, 3.0, 0.0}, {half_m, 5.4, 0.005}}, Material::gravel);
    flyball::RandomStream random{seed, "world/park"};
    std::vector<flyball::WalkObstacle> taken;
    const auto place = [&](double count, double radius_m, const auto& plant) {
      for (int i = 0; i < static_cast<int>(std::lround(count)); ++i) {
        if (const auto foot_W = free_place(world, taken, radius_m, random)) {
          plant(*foot_W);
          taken.push_back({*foot_W, radius_m});
        }
      }
    };
    place(given.number("trees"), 0.7, [&](const Vec3& at) { add_tree(world, at, random); });
    place(given.number("hedges"), 2.4, [&](const Vec3& at) { add_hedge(world, at, random); });
    place(given.number("benches"), 1.2, [&](const Vec3& at) {
      const Vec3 half{0.9, 0.25, 0.0};
      add_box(world, {at - half, at + half + Vec3{0.0, 0.0, 0.45}}, Material::wood);
    });
    add_person(world, given, taken, seed);
    return world;
  }

 private:
  static void add_box(flyball::World& world, const Aabb& box, Material material) {
    world.boxes.push_back(box);
    world.box_materials.resize(world.boxes.size(), Material::plaster);
    world.box_materials.back() = material;
  }

  static void add_tree(flyball::World& world, const Vec3& foot_W, flyball::RandomStream& random) {
    const double trunk_m = random.uniform(1.2, 1.6);
    world.pillars.push_back({foot_W, 0.08, trunk_m, Material::bark});
    world.pillars.push_back({foot_W + Vec3{0.0, 0.0, trunk_m}, random.uniform(0.6, 1.0),
                             random.uniform(1.0, 1.5), Material::leaves});
  }

  static void add_hedge(flyball::World& world, const Vec3& foot_W, flyball::RandomStream& random) {
    const bool along_x = random.uniform() < 0.5;
    const Vec3 half = along_x ? Vec3{2.0, 0.3, 0.0} : Vec3{0.3, 2.0, 0.0};
    add_box(world, {foot_W - half, foot_W + half + Vec3{0.0, 0.0, 1.2}}, Material::leaves);
  }

  /// Empty when 2000 throws found none: the lawn is full.
  static std::optional<Vec3> free_place(const flyball::World& world,
                                        const std::vector<flyball::WalkObstacle>& taken,
                                        double radius_m,
                                        flyball::RandomStream& random) {
    for (int i = 0; i < most_tries; ++i) {
      const Vec3 at{random.uniform(world.bounds_W.min.x(), world.bounds_W.max.x()),
                    random.uniform(world.bounds_W.min.y(), world.bounds_W.max.y()), 0.0};
      const bool starts_here = (at - world.start_W).norm() < keep_clear_m + radius_m ||
                               (at - world.goal_W).norm() < keep_clear_m + radius_m;
      if (!starts_here && std::none_of(taken.begin(), taken.end(), [&](const auto& other) {
            return (other.centre_W - at).norm() < other.radius_m + radius_m;
          })) {
        return at;
      }
    }
    return std::nullopt;
  }

  static void add_person(flyball::World& world,
                         const flyball::Parameters& given,
                         const std::vector<flyball::WalkObstacle>& taken,
                         std::uint64_t seed) {
    flyball::WalkStyle style;
    style.speed_m_s = given.number("walk_speed_m_s");
    style.sprint_m_s = given.number("sprint_speed_m_s");
    style.sprint_share = given.number("sprint_share");
    style.duration_s = given.number("walk_time_s");
    // The walk keeps so far from the edge that the vehicle behind it stays inside.
    Aabb lawn_W = world.bounds_W;
    const Vec3 margin{0.2 * (lawn_W.max.x() - lawn_W.min.x()),
                      0.2 * (lawn_W.max.y() - lawn_W.min.y()), 0.0};
    lawn_W.min += margin;
    lawn_W.max -= margin;
    flyball::Person person;
    person.heading_rad = 3.0;  // Towards the vehicle's start.
    person.walk = flyball::random_walk(world.goal_W, lawn_W, taken, style, {seed, "walk/park"});
    for (flyball::WalkPoint& point : person.walk) {
      point.time_s += look_first_s;
    }
    world.people.push_back(std::move(person));
  }
};

}  // namespace

FLYBALL_PLUGIN(park) {
  registry.add<flyball::WorldGenerator>("park", [] { return std::make_unique<Park>(); });
}
