// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/scenario/catalogue.h"
#include "flyball/simulation/mission.h"

#include "commands.h"
#include "console.h"
#include "flight_options.h"
#include "scenario/scenario_keys.h"
#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct GraphOptions {
  std::string workload;
  std::string format{"text"};
  Plugins plugins{};
};

int graph(const GraphOptions& options) {
  const std::vector<std::string> known = workload_names(options.plugins);
  if (std::find(known.begin(), known.end(), options.workload) == known.end()) {
    return refuse({{ErrorCode::not_found, "no workload \"" + options.workload + "\"; " +
                                              name_meant(options.workload, known) +
                                              "try: flyball list workloads"}});
  }
  if (options.format != "text" && options.format != "dot") {
    return refuse(
        {{ErrorCode::invalid_input, "--format " + options.format + " is neither text nor dot"}});
  }
  Scenario scenario;  // The defaults: any kernels show the same dataflow.
  scenario.mission.workload = options.workload;
  scenario.plugins = options.plugins;
  const Result<std::string> drawn = describe_graph(scenario, options.format == "dot");
  if (!drawn) {
    return refuse({drawn.error()});
  }
  print(*drawn);
  return exit_success;
}

}  // namespace

void add_graph(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("graph", "prints a workload's nodes, topics and services");
  const auto options = std::make_shared<GraphOptions>();  // Owners: the parser's callbacks.
  command->add_option("WORKLOAD", options->workload, "a name from `flyball list workloads`")
      ->required();
  command->add_option("--format", options->format, "text or dot (for Graphviz)")
      ->type_name("text|dot");
  add_kernels(*command, options->plugins);
  command->callback([options, &exit_code] { exit_code = graph(*options); });
}

}  // namespace flyball
