// SPDX-License-Identifier: BSD-3-Clause
//
// What maps of three resolutions make of a door: MAVBench's pictures, with numbers.

#include "flyball/records/text_table.h"

#include "experiments/framework/papers.h"
#include "studies/fit_perception.h"
#include <algorithm>
#include <array>

namespace flyball::experiments {
namespace {

constexpr std::array<const char*, 3> cells_m{"0.15", "0.50", "0.80"};
constexpr std::array<double, 4> seen_from_m{5.0, 4.0, 3.0, 2.0};  // Before the wall.
constexpr double square_m = 0.05;                                 // A third of the finest cells.
constexpr std::size_t squares = 101;  // Odd: the middle one lies in the middle of the door.
constexpr double half_picture_m = 0.5 * square_m * squares;

/// A door in a wall across x.
struct Door {
  double wall_x_m{};
  double low_y_m{};
  double high_y_m{};
  [[nodiscard]] double middle_y_m() const { return 0.5 * (low_y_m + high_y_m); }
};

/// The gap in the first wall of the world's building, at the height at which the vehicle flies.
Result<Door> entrance_of(const World& world) {
  constexpr double thickest_m = 0.2;  // Blocks outdoors are wider.
  std::vector<Aabb> wall;
  for (const Aabb& box : world.boxes) {
    const bool is_wall = box.max.x() - box.min.x() < thickest_m &&
                         box.min.z() < world.cruise_height_m && box.max.z() > world.cruise_height_m;
    if (is_wall && (wall.empty() || box.min.x() < wall.front().min.x())) {
      wall.assign(1, box);
    } else if (is_wall && box.min.x() == wall.front().min.x()) {
      wall.push_back(box);
    }
  }
  std::sort(wall.begin(), wall.end(),
            [](const Aabb& a, const Aabb& b) { return a.min.y() < b.min.y(); });
  for (std::size_t i = 1; i < wall.size(); ++i) {
    if (wall[i].min.y() > wall[i - 1].max.y()) {
      return Door{0.5 * (wall[i].min.x() + wall[i].max.x()), wall[i - 1].max.y(), wall[i].min.y()};
    }
  }
  return Error{ErrorCode::failed, "the building of the pictures has no entrance"};
}

PlaceState state_of(const OccupancyView& map, const Vec3& p_W, const Cylinder& body) {
  switch (map.state(p_W)) {
    case CellState::occupied:
      return PlaceState::occupied;
    case CellState::unknown:
      return PlaceState::unknown;
    default:
      return map.body_state(p_W, body) == CellState::free ? PlaceState::passable : PlaceState::free;
  }
}

CellPicture picture_of(const OccupancyView& map,
                       const Door& door,
                       double height_m,
                       const Cylinder& body) {
  CellPicture picture;
  picture.square_m = square_m;
  picture.least_x_m = door.wall_x_m - half_picture_m;
  picture.least_y_m = door.middle_y_m() - half_picture_m;
  picture.columns = squares;
  for (std::size_t row = 0; row < squares; ++row) {
    const double y_m = picture.least_y_m + square_m * (static_cast<double>(row) + 0.5);
    for (std::size_t column = 0; column < squares; ++column) {
      const double x_m = picture.least_x_m + square_m * (static_cast<double>(column) + 0.5);
      picture.squares.push_back(state_of(map, {x_m, y_m, height_m}, body));
    }
  }
  return picture;
}

/// How wide the way is that the body's centre has through the wall, to a centimetre.
double open_width_m(const OccupancyView& map,
                    const Door& door,
                    double height_m,
                    const Cylinder& body) {
  constexpr double step_m = 0.01;
  const int steps = static_cast<int>(0.5 * (door.high_y_m - door.low_y_m) / step_m);
  int open = 0;
  for (int i = -steps; i <= steps; ++i) {
    const Vec3 p_W{door.wall_x_m, door.middle_y_m() + step_m * i, height_m};
    open += map.body_state(p_W, body) == CellState::free ? 1 : 0;
  }
  return step_m * open;
}

struct Seen {
  CellPicture picture{};
  double door_m{};
  double open_m{};  ///< Of the door, for the body's centre.
};

/// The map after a straight approach to the door.
Result<Seen> approach(const std::string& cells) {
  Scenario scenario = scene_a().scenario;
  scenario.map.resolution_m = std::stod(cells);
  const auto setup = set_up_without_governor(scenario);
  if (!setup) {
    return setup.error();
  }
  const World& world = setup->things.world;
  const auto door = entrance_of(world);
  if (!door) {
    return door.error();
  }
  const Workbench bench = workbench_of(scenario, *setup);
  Perception perception{bench, world};
  KernelLoads loads;
  for (const double away_m : seen_from_m) {
    const Vec3 here_W{door->wall_x_m - away_m, door->middle_y_m(), world.cruise_height_m};
    if (const Status seen = perception.look(looking(here_W, 0.0), loads); !seen) {
      return seen.error();
    }
  }
  const OccupancyView& map = bench.kernels.mapper->view();
  const Cylinder body = bench.brief.narrow_body();
  const double height_m = world.cruise_height_m;
  return Seen{picture_of(map, *door, height_m, body), door->high_y_m - door->low_y_m,
              open_width_m(map, *door, height_m, body)};
}

Result<Findings> evaluate(const Evidence& /*evidence*/) {
  Findings findings;
  for (const char* cells : cells_m) {
    auto seen = approach(cells);
    if (!seen) {
      return seen.error();
    }
    Claim claim{std::string{"cells of "} + cells +
                    " m: width of the way that the body's centre has through the door",
                "m"};
    claim.ours = computed(seen->open_m);
    findings.claims.push_back(claim);
    seen->picture.title = std::string{"A door of "} + rounded(seen->door_m, 2) +
                          " m on a map with cells of " + cells + " m";
    findings.figures.push_back({std::string{"door_"} + cells,
                                "A level cut at flying height; x is along the flight. From four "
                                "images, 5 to 2 m before the wall.",
                                std::move(seen->picture)});
  }
  return findings;
}

}  // namespace

Experiment perception_pictures() {
  return {
      "What do coarse cells make of a door?",
      std::string{mavbench} + ", picture of OctoMap at three resolutions (no number is printed)",
      "The first door of the delivery's building, seen from 5, 4, 3 and 2 m with the noise of "
      "an RGB-D camera, in maps with cells of .15, .50 and .80 m. Nothing is flown.",
      {},
      {},
      evaluate};
}

}  // namespace flyball::experiments
