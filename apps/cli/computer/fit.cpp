// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/platform_fit.h"

#include "cli/commands.h"
#include "cli/console.h"
#include <memory>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

int fit(const std::string& platform) {
  const Result<PlatformFit> result = fit_platform(platform);
  if (!result) {
    return refuse({result.error()});
  }
  print(to_text(*result));
  return result->is_in_step() ? exit_success : exit_mission_failed;
}

}  // namespace

void add_fit(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "fit",
      "compares a platform's kernel times with MAVBench's, and says which scales match them");
  const auto platform = std::make_shared<std::string>();  // Owners: the parser's callbacks.
  command->add_option("PLATFORM", *platform, "a name, or a .toml file")->required();
  command->callback([platform, &exit_code] { exit_code = fit(*platform); });
}

}  // namespace flyball
