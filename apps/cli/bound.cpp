// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/text_table.h"
#include "flyball/scenario/override.h"
#include "flyball/studies/energy_bound.h"

#include "commands.h"
#include "console.h"
#include "flight_options.h"
#include <memory>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct BoundOptions {
  FlightOptions flight{};
  std::string seed{};
};

int bound(const BoundOptions& options) {
  std::vector<Override> overrides = of_set(options.flight.settings);
  if (!options.seed.empty()) {
    overrides.push_back({"seed=" + options.seed, "--seed"});
  }
  const auto loaded =
      load_overridden_scenario(options.flight.scenario, overrides, options.flight.plugins);
  if (const auto* errors = std::get_if<std::vector<Error>>(&loaded)) {
    return refuse(*errors);
  }
  const Scenario& scenario = std::get<LoadedScenario>(loaded).scenario;
  const Result<EnergyBound> least = bound_energy(scenario);
  if (!least) {
    return refuse({least.error()});
  }
  if (options.flight.json) {
    print(to_json(*least, scenario) + "\n");
    return exit_success;
  }
  std::string text = scenario.name + ", seed " + std::to_string(scenario.seed) + ": at least " +
                     rounded(1e-3 * least->energy_j(), 1) + " kJ\n";
  for (std::size_t i = 0; i < least->legs.size(); ++i) {
    const BoundedLeg& leg = least->legs[i];
    text += (i == 0 ? "  out   " : "  back  ") + rounded(leg.length_m, 1) + " m, " +
            rounded(1e-3 * leg.energy_j, 1) + " kJ\n";
  }
  print(text);
  return exit_success;
}

}  // namespace

void add_bound(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("bound", "computes a lower bound of the energy that a delivery takes");
  const auto options = std::make_shared<BoundOptions>();  // Owners: the parser's callbacks.
  add_scenario(*command, options->flight);
  refuse_empty(*command
                    ->add_option("--seed", options->seed,
                                 "seed of world, sensors and planner; default: the scenario's")
                    ->type_name("N"));
  command->add_flag("--json", options->flight.json, "prints the result as JSON");
  command->callback([options, &exit_code] { exit_code = bound(*options); });
}

}  // namespace flyball
