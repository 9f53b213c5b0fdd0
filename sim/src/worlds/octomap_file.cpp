// SPDX-License-Identifier: BSD-3-Clause
//
// A place that was scanned, from OctoMap's binary file: its occupied cells are solid, all else is
// air.

#include "flyball/runtime/registry.h"
#include "flyball/sim/world.h"

#include "../scan_grid.h"
#include <array>

namespace {

using flyball::Vec3;
using flyball::World;

// Where Debian's liboctomap-dev puts its examples; bare file names are looked for here.
constexpr const char* example_folder = "/usr/share/doc/liboctomap-dev/examples/data/";

// Freiburg's building 079, scanned with one office door open: the corridor (36 m) and that office
// are all that a disc of .71 m can reach, at any height from 1.1 to 1.5 m. The places are those
// with the widest clear cylinder (to 2.5 m height): 1.05 m in the corridor's niches, .79 m in the
// office.
constexpr const char* shipped_file = "geb079.bt";
struct Pair {
  double start_x_m, start_y_m, goal_x_m, goal_y_m;
};
constexpr std::array<Pair, 5> shipped_pairs{{
    {-2.025, -0.075, 2.325, 5.775},   // West corridor, clear 1.05 m, to the office, .79 m.
    {25.275, -0.075, 2.325, 5.775},   // East corridor, 1.05 m, to the office.
    {2.325, 5.775, 16.125, -0.075},   // Office to the middle of the corridor, 1.05 m.
    {-5.175, 0.075, 25.275, -0.075},  // The corridor's length, .97 m to 1.05 m.
    {2.325, 5.775, 22.125, -0.075},   // Office to the east corridor, 1.02 m.
}};

class OctomapFile final : public flyball::WorldGenerator {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    constexpr double far_m = 1e4;
    return {
        {"file", std::string{shipped_file}, 0.0, 0.0,
         "A .bt file; a bare name: OctoMap's examples."},
        {"pair", 1.0, 0.0, 5.0, "Start and goal shipped for geb079.bt; 0: as below."},
        {"start_x_m", 0.0, -far_m, far_m, "With pair = 0."},
        {"start_y_m", 0.0, -far_m, far_m, "With pair = 0."},
        {"goal_x_m", 10.0, -far_m, far_m, "With pair = 0."},
        {"goal_y_m", 0.0, -far_m, far_m, "With pair = 0."},
        {"ground_z_m", 0.0, -far_m, far_m, "Floor in the file; a solid plane closes its holes."},
        {"cruise_height_m", 1.2, 0.5, 100.0, "Above the floor; the band is .3 below to .5 above."},
        {"max_speed_m_s", 1.0, 0.1, 20.0, "In the whole place."}};
  }

  [[nodiscard]] flyball::Result<World> make(const flyball::Parameters& given,
                                            std::uint64_t) const override {
    const std::string& file = given.text("file");
    const auto pair = static_cast<std::size_t>(given.number("pair"));
    if (pair > 0 && file.find(shipped_file) == std::string::npos) {
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "world \"octomap_file\": pair is for geb079.bt only; set pair = 0 and "
                            "start_x_m .. goal_y_m for \"" +
                                file + "\""};
    }
    const bool is_bare = file.find('/') == std::string::npos;
    const auto scan = flyball::read_scan(is_bare ? example_folder + file : file);
    if (!scan) {
      return flyball::Error{scan.error().code,
                            scan.error().message + "; Debian's liboctomap-dev ships geb079.bt"};
    }
    World world = solid_world(*scan, given.number("ground_z_m"));
    const Pair at = pair > 0 ? shipped_pairs[pair - 1]
                             : Pair{given.number("start_x_m"), given.number("start_y_m"),
                                    given.number("goal_x_m"), given.number("goal_y_m")};
    world.start_W = {at.start_x_m, at.start_y_m, world.ground_z_m};
    world.goal_W = {at.goal_x_m, at.goal_y_m, world.ground_z_m};
    world.cruise_height_m = given.number("cruise_height_m");
    world.zones = {{world.bounds_W, given.number("max_speed_m_s")}};
    world.bounds_W.min.z() = world.ground_z_m + world.cruise_height_m - 0.3;
    world.bounds_W.max.z() = world.ground_z_m + world.cruise_height_m + 0.5;
    for (const Vec3& place : {world.start_W, world.goal_W}) {
      if (!scan->extent_W().contains({place.x(), place.y(), scan->extent_W().min.z()})) {
        return flyball::Error{
            flyball::ErrorCode::invalid_input,
            "world \"octomap_file\": start or goal lies outside \"" + file + "\""};
      }
    }
    return world;
  }

 private:
  // Cells under the floor plane are left out: nothing sees or touches them.
  static World solid_world(const flyball::ScanGrid& scan, double ground_z_m) {
    World world;
    world.ground_z_m = ground_z_m;
    world.bounds_W = scan.extent_W();
    const double floor_cell = ground_z_m / scan.resolution_m() + 1e-6;
    world.boxes = merged_boxes(scan, [&](const flyball::ScanGrid::Index& cell) {
      return cell.z() + 1 > floor_cell && scan.state(cell) == flyball::CellState::occupied;
    });
    return world;
  }
};

}  // namespace

FLYBALL_PLUGIN(octomap_file) {
  registry.add<flyball::WorldGenerator>("octomap_file",
                                        [] { return std::make_unique<OctomapFile>(); });
}
