// SPDX-License-Identifier: BSD-3-Clause
//
// A place from a mesh, as CAD programs and scanners write it: cells that its surfaces touch are
// solid.

#include "flyball/runtime/registry.h"
#include "flyball/sim/world.h"

#include "world/scanned_place.h"
#include "world/solid_surface.h"

namespace {

using flyball::World;

class MeshFile final : public flyball::WorldGenerator {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    std::vector<flyball::ParameterSpec> all{
        {"file", std::string{}, 0.0, 0.0, "OBJ, STL, PLY, glTF, COLLADA, or what Assimp reads."},
        {"cell_m", 0.1, 0.02, 1.0, "Cells that a surface touches are solid."},
        {"metres_per_unit", 1.0, 1e-4, 1e4, "Of the file's lengths; .001 for millimetres."},
        {"up",
         std::string{"file"},
         0.0,
         0.0,
         "The file's axis that points up; file: y for glTF, else z. COLLADA files say it "
         "themselves.",
         {"file", "y", "z"}}};
    const auto place = flyball::place_parameters();
    all.insert(all.end(), place.begin(), place.end());
    return all;
  }

  [[nodiscard]] flyball::Result<World> make(const flyball::Parameters& given,
                                            std::uint64_t) const override {
    const std::string& file = given.text("file");
    if (file.empty()) {
      return error(flyball::ErrorCode::invalid_input,
                   "no file is named; set world.file to a mesh (OBJ, STL, PLY, glTF, COLLADA)");
    }
    const auto grid =
        flyball::read_mesh(file, {given.number("cell_m"), given.number("metres_per_unit"),
                                  flyball::up_axis(given.text("up"))});
    if (!grid) {
      return error(grid.error().code, grid.error().message);
    }
    auto world = world_in(*grid, flyball::trip_of(given), given, given.number("cell_m"), file);
    return world ? std::move(world) : error(world.error().code, world.error().message);
  }

 private:
  static flyball::Result<World> error(flyball::ErrorCode code, const std::string& why) {
    return flyball::Error{code, "world \"mesh_file\": " + why};
  }
};

}  // namespace

FLYBALL_PLUGIN(mesh_file) {
  registry.add<flyball::WorldGenerator>("mesh_file", [] { return std::make_unique<MeshFile>(); });
}
