// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/kernels/mapper.h"
#include "flyball/records/text_table.h"
#include "flyball/scenario/plugins.h"

#include "commands.h"
#include "console.h"
#include "flight_options.h"
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct MapOptions {
  std::string file{};
  std::string out{};
  std::optional<double> resolution_m{};
};

/// The map in a file, as a mapper of this name holds it.
Result<std::unique_ptr<Mapper>> load(const std::string& mapper_name, const std::string& file) {
  auto mapper = Plugins{}.make<Mapper>(mapper_name);
  if (!mapper) {
    return Error{ErrorCode::unavailable, "this build has no mapper " + mapper_name};
  }
  if (const Status read = mapper->read(file); !read) {
    return read.error();
  }
  return mapper;
}

std::string volume_m3(std::uint64_t cells, double cell_m) {
  return rounded(static_cast<double>(cells) * cell_m * cell_m * cell_m, 2);
}

std::string bytes_per(std::size_t bytes, std::uint64_t cells) {
  return cells == 0 ? "-" : rounded(static_cast<double>(bytes) / static_cast<double>(cells), 2);
}

void add_lines(const std::string& mapper,
               const MapContents& contents,
               std::vector<std::vector<std::string>>& lines) {
  for (const MapLevel& level : contents.levels) {
    lines.push_back({mapper, rounded(level.cell_m, 3), std::to_string(level.known_cells),
                     std::to_string(level.occupied_cells),
                     volume_m3(level.known_cells, level.cell_m),
                     volume_m3(level.occupied_cells, level.cell_m), std::to_string(contents.bytes),
                     bytes_per(contents.bytes, level.known_cells)});
  }
}

int describe(const MapOptions& options) {
  std::vector<std::vector<std::string>> lines{{"MAPPER", "CELL_M", "KNOWN", "OCCUPIED", "KNOWN_M3",
                                               "OCCUPIED_M3", "BYTES", "BYTES_PER_KNOWN"}};
  for (const char* name : {"flyball", "octomap"}) {
    const auto mapper = load(name, options.file);
    if (!mapper) {
      return refuse({mapper.error()});
    }
    add_lines(name, (*mapper)->contents(), lines);
  }
  print(aligned(lines));
  return exit_success;
}

/// OctoMap's own trees keep the log-odds of a file as they are; bricks, which make wider cells of
/// it, round them.
int export_map(const MapOptions& options) {
  const auto mapper = load(options.resolution_m ? "flyball" : "octomap", options.file);
  if (!mapper) {
    return refuse({mapper.error()});
  }
  if (const Status written = (*mapper)->write(options.out, options.resolution_m); !written) {
    return refuse({written.error()});
  }
  return exit_success;
}

/// Both mappers read the file; each cell must have the same state in both.
int import_map(const MapOptions& options) {
  const auto bricks = load("flyball", options.file);
  if (!bricks) {
    return refuse({bricks.error()});
  }
  const auto stock = load("octomap", options.file);
  if (!stock) {
    return refuse({stock.error()});
  }
  const MapLevel arrived = (*bricks)->contents().levels.front();
  const MapLevel sent = (*stock)->contents().levels.front();
  if (arrived.known_cells != sent.known_cells || arrived.occupied_cells != sent.occupied_cells) {
    remark("of " + std::to_string(sent.known_cells) + " cells in \"" + options.file + "\", " +
           std::to_string(sent.occupied_cells) + " occupied, the map has " +
           std::to_string(arrived.known_cells) + ", " + std::to_string(arrived.occupied_cells) +
           " occupied");
    return exit_mission_failed;
  }
  print(std::to_string(arrived.known_cells) + " cells of " + rounded(arrived.cell_m, 3) + " m, " +
        std::to_string(arrived.occupied_cells) + " occupied\n");
  return exit_success;
}

CLI::App* add_file_command(CLI::App& map,
                           const std::string& name,
                           const std::string& what,
                           MapOptions& options) {
  CLI::App* command = map.add_subcommand(name, what);
  refuse_empty(
      *command->add_option("FILE", options.file, "an OctoMap file, .bt or .ot")->required());
  return command;
}

}  // namespace

void add_map(CLI::App& program, int& exit_code) {
  CLI::App* map = program.add_subcommand("map", "reads, writes and makes OctoMap files");
  map->require_subcommand(1);
  const auto options = std::make_shared<MapOptions>();  // Owners: the parser's callbacks.
  add_file_command(*map, "info", "prints what is known, and in how much memory", *options)
      ->callback([options, &exit_code] { exit_code = describe(*options); });
  add_file_command(*map, "import", "reads a file and checks that every cell arrives", *options)
      ->callback([options, &exit_code] { exit_code = import_map(*options); });
  CLI::App* write = add_file_command(*map, "export",
                                     "writes a map anew: .bt, .ot, or with wider cells", *options);
  refuse_empty(
      *write->add_option("OUT", options->out, "a file that ends in .bt or .ot")->required());
  CLI::Option* resolution =
      write->add_option("--resolution", options->resolution_m, "1, 2, 4 or 8 times the file's")
          ->type_name("M");
  refuse_empty(*resolution);
  refuse_nan(*resolution);
  write->callback([options, &exit_code] { exit_code = export_map(*options); });
  add_map_from(*map, exit_code);
}

}  // namespace flyball
