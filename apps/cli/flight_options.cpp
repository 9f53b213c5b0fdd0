// SPDX-License-Identifier: BSD-3-Clause

#include "flight_options.h"

#include <cmath>
#include <filesystem>

#include <CLI/CLI.hpp>

namespace flyball {

void add_scenario(CLI::App& command, FlightOptions& options) {
  command
      .add_option("SCENARIO", options.scenario,
                  "a name from `flyball list scenarios`, or a .toml file")
      ->required();
  command
      .add_option("--set", options.settings,
                  "changes one setting; `flyball config SCENARIO` lists them all")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  add_kernels(command, options.plugins);
}

void add_kernels(CLI::App& command, Plugins& plugins) {
  const std::string option = "--kernels";
  const auto load = [option, &plugins](const std::vector<std::string>& files) {
    for (const std::string& file : files) {
      auto more = plugins.with_library(file);
      if (!more) {
        throw CLI::ValidationError{option, more.error().message};
      }
      plugins = std::move(*more);
    }
  };
  command
      .add_option_function<std::vector<std::string>>(
          option, load,
          "a library with your own kernels; its code runs in this program with your rights")
      ->type_name("./libNAME.so")
      ->expected(1)
      ->take_all();
}

void refuse_empty(CLI::Option& option) {
  option.check(CLI::Validator{
      [](const std::string& value) { return std::string{value.empty() ? "is empty" : ""}; }, ""});
}

void refuse_nan(CLI::Option& option) {
  option.check(CLI::Validator{[](const std::string& value) {
                                double number = 0.0;
                                const bool is_nan =
                                    CLI::detail::lexical_cast(value, number) && std::isnan(number);
                                return std::string{is_nan ? value + " is no number" : ""};
                              },
                              ""});
}

CLI::Option& add_names(CLI::App& command,
                       const std::string& option,
                       std::vector<std::string>& names,
                       const std::string& description) {
  // One argument each time: what follows it may be the command's own, as SCENARIO.
  CLI::Option& added =
      *command.add_option(option, names, description)->delimiter(',')->expected(1)->take_all();
  added.type_name("A,B,C");
  refuse_empty(added);
  return *added.transform(CLI::Validator{[](std::string& value) {  // Comes before the other check.
                                           CLI::detail::trim(value);
                                           return std::string{};
                                         },
                                         ""});
}

void add_output(CLI::App& command, FlightOptions& options) {
  refuse_empty(
      *command.add_option("--out", options.out, "folder for the record (default: under flights/)")
           ->type_name("DIR"));
  command.add_flag("--json", options.json, "prints the result as JSON");
}

void add_contest(CLI::App& command, std::vector<std::string>& policies, std::string& seeds) {
  add_names(command, "--policies", policies,
            "names from `flyball list policies`, or files; the others are compared with the first "
            "one")
      .required();
  command
      .add_option("--seeds", seeds,
                  "as 1..10, 3 or 1,4,9; one flight of each policy for each; a seed draws world, "
                  "sensors and planner")
      ->type_name("1..N");
}

void add_jobs(CLI::App& command, std::size_t& jobs) {
  command.add_option("--jobs", jobs, "missions at a time (default: one for each processor)")
      ->type_name("J")
      ->check(CLI::Range(1, 1024));
}

void add_trust(CLI::App& command, bool& trusts) {
  command.add_flag("--trust", trusts,
                   "loads the library that the record's policy comes from: its code then runs "
                   "with your rights");
}

std::string run_folder(const std::string& out, const std::string& policy, std::uint64_t seed) {
  namespace fs = std::filesystem;
  return (fs::path{out} / "runs" / fs::path{policy}.stem() / ("seed_" + std::to_string(seed)))
      .string();
}

std::string comparison_folder(const FlightOptions& options, const Scenario& scenario) {
  return options.out.empty() ? "flights/" + scenario.name : options.out;
}

}  // namespace flyball
