// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/pictures.h"
#include "flyball/records/place_picture.h"
#include "flyball/records/report.h"
#include "flyball/records/text_table.h"

#include "commands.h"
#include "console.h"
#include "flight_options.h"
#include <algorithm>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct WorldOptions {
  std::string file{};
  std::string picture{};
  PlaceView view{};
};

std::string from_to(double low_m, double high_m) {
  return rounded(low_m, 2) + " to " + rounded(high_m, 2) + " m";
}

std::string described(const PlacePlan& plan) {
  const Aabb& extent = plan.extent_W;
  const auto room = cells_with_room(plan);
  const auto cells = static_cast<double>(std::count(room.begin(), room.end(), true));
  return aligned({{"x", from_to(extent.min.x(), extent.max.x())},
                  {"y", from_to(extent.min.y(), extent.max.y())},
                  {"z", from_to(extent.min.z(), extent.max.z())},
                  {"cells", rounded(plan.cell_m, 3) + " m"},
                  {"room for a vehicle", rounded(cells * plan.cell_m * plan.cell_m, 1) + " m2"}});
}

int describe_world(const WorldOptions& options) {
  const auto plan = plan_of_place(options.file, options.view);
  if (!plan) {
    return refuse({plan.error()});
  }
  if (!options.picture.empty()) {
    if (std::filesystem::path{options.picture}.extension() != ".png") {
      return refuse({{ErrorCode::invalid_input,
                      "--picture \"" + options.picture + "\" must end in .png, which it becomes"}});
    }
    const auto png = png_of(picture_of(*plan));
    if (!png) {
      return refuse({png.error()});
    }
    if (const Status written = write_file(options.picture, *png); !written) {
      return refuse({written.error()});
    }
  }
  print(described(*plan));
  return exit_success;
}

}  // namespace

void add_world(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "world", "draws the floor plan of a map or mesh, to choose start and goal in");
  const auto options = std::make_shared<WorldOptions>();  // Owners: the parser's callbacks.
  PlaceView& view = options->view;
  refuse_empty(
      *command->add_option("FILE", options->file, "OctoMap's .bt or .ot, or a mesh")->required());
  refuse_empty(*command->add_option("--picture", options->picture, "writes the plan there")
                    ->type_name("OUT.png"));
  refuse_nan(
      *command->add_option("--height", view.height_m, "height of the flight above the ground")
           ->type_name("M")
           ->check(CLI::Range(0.0, 1e4)));
  refuse_nan(
      *command->add_option("--ground", view.ground_z_m, "height (z) of the floor in the file")
           ->type_name("M")
           ->check(CLI::Range(-1e4, 1e4)));
  refuse_nan(
      *command->add_option("--cell", view.cell_m, "size of the cells that a mesh is cut into")
           ->type_name("M")
           ->check(CLI::Range(0.02, 1.0)));
  refuse_nan(*command
                  ->add_option("--metres-per-unit", view.metres_per_unit,
                               "metres that one unit of a mesh stands for")
                  ->check(CLI::Range(1e-4, 1e4)));
  command->add_option("--up", view.up, "the mesh's axis that points up")
      ->check(CLI::IsMember({"file", "y", "z"}));
  command->callback([options, &exit_code] { exit_code = describe_world(*options); });
}

}  // namespace flyball
