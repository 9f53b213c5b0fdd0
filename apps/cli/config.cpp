// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/text_table.h"

#include "commands.h"
#include "console.h"
#include "flight_options.h"
#include <memory>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

int config(const FlightOptions& options) {
  const auto loaded = load_scenario(options.scenario, options.settings, options.plugins);
  if (const auto* errors = std::get_if<std::vector<Error>>(&loaded)) {
    return refuse(*errors);
  }
  std::vector<std::vector<std::string>> lines{{"KEY", "VALUE", "DEFAULT", "FROM", "MEANING"}};
  for (const ConfigEntry& entry : std::get<LoadedScenario>(loaded).entries) {
    lines.push_back({entry.key, entry.value, entry.fallback, entry.origin, entry.description});
  }
  print(aligned(lines));
  return exit_success;
}

}  // namespace

void add_config(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("config", "prints every setting, its default and where it comes from");
  const auto options = std::make_shared<FlightOptions>();  // Owners: the parser's callbacks.
  add_scenario(*command, *options);
  command->callback([options, &exit_code] { exit_code = config(*options); });
}

}  // namespace flyball
