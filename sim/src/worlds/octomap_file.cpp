// SPDX-License-Identifier: BSD-3-Clause
//
// A place that was scanned, from OctoMap's files: its occupied cells are solid, all else is air.

#include "flyball/runtime/registry.h"
#include "flyball/sim/world.h"

#include "world/scan_file.h"
#include "world/scanned_place.h"
#include <array>

namespace {

using flyball::World;

// Freiburg's building 079, scanned with one office door open: the corridor (36 m) and that office
// are all that a disc of .71 m can reach, at any height from 1.1 to 1.5 m. The places are those
// with the widest clear cylinder (to 2.5 m height): 1.05 m in the corridor's niches, .79 m in the
// office.
constexpr const char* shipped_file = "geb079.bt";
constexpr std::array<flyball::Trip, 5> shipped_pairs{{
    {-2.025, -0.075, 2.325, 5.775},   // West corridor, clear 1.05 m, to the office, .79 m.
    {25.275, -0.075, 2.325, 5.775},   // East corridor, 1.05 m, to the office.
    {2.325, 5.775, 16.125, -0.075},   // Office to the middle of the corridor, 1.05 m.
    {-5.175, 0.075, 25.275, -0.075},  // The corridor's length, .97 m to 1.05 m.
    {2.325, 5.775, 22.125, -0.075},   // Office to the east corridor, 1.02 m.
}};

class OctomapFile final : public flyball::WorldGenerator {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    std::vector<flyball::ParameterSpec> all{
        {"file", std::string{shipped_file}, 0.0, 0.0,
         "A .bt or .ot file; the current folder's, else OctoMap's example."},
        {"pair", 1.0, 0.0, 5.0,
         "Start and goal shipped for geb079.bt; 0: by start_x_m to goal_y_m."}};
    const auto place = flyball::place_parameters();
    all.insert(all.end(), place.begin(), place.end());
    return all;
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
    const auto scan = flyball::read_scan(flyball::scan_path(file));
    if (!scan) {
      const bool is_shipped_one =
          scan.error().code == flyball::ErrorCode::not_found && file == shipped_file;
      return flyball::Error{
          scan.error().code,
          scan.error().message +
              (is_shipped_one ? "; install liboctomap-dev, which brings it, or set world.file"
                              : "")};
    }
    const flyball::Trip trip = pair > 0 ? shipped_pairs[pair - 1] : flyball::trip_of(given);
    auto world = world_in(*scan, trip, given, 0.0, file);
    if (!world) {
      return flyball::Error{world.error().code, "world \"octomap_file\": " + world.error().message};
    }
    return world;
  }
};

}  // namespace

FLYBALL_PLUGIN(octomap_file) {
  registry.add<flyball::WorldGenerator>("octomap_file",
                                        [] { return std::make_unique<OctomapFile>(); });
}
