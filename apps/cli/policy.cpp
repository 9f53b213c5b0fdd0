// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/governors/policy_conformance.h"
#include "flyball/scenario/policy_choice.h"

#include "commands.h"
#include "console.h"
#include "flight_options.h"
#include <algorithm>
#include <memory>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct CheckOptions {
  std::string file{};
  Plugins plugins{};
};

/// Of one policy that is asked.
int check_one(const std::string& file, const CheckOptions& options) {
  constexpr std::uint64_t seed = 1;
  const Result<PolicyChoice> choice = choose_policy(file, options.plugins, seed);
  if (!choice) {
    return refuse({choice.error()});
  }
  if (!choice->caution.empty()) {
    note("flyball: " + choice->caution);
  }
  std::string why;
  PolicyConformance conformance{{[&choice, &why]() -> std::unique_ptr<Policy> {
                                   auto made = choice->make();
                                   why = made ? "" : ": " + made.error().message;
                                   return made ? std::move(*made) : nullptr;
                                 },
                                 choice->parameters}};
  const std::vector<std::string> breaches = conformance.breaches();
  if (breaches.empty()) {
    print(file + " keeps the contract of a policy\n");
    return exit_success;
  }
  for (const std::string& breach : breaches) {
    print(file + " " + breach + why + "\n");
  }
  return exit_mission_failed;
}

int check(const CheckOptions& options) {
  int exit_code = exit_success;
  for (const std::string& one : asked_policies(options.file)) {
    exit_code = std::max(exit_code, check_one(one, options));
  }
  return exit_code;
}

}  // namespace

void add_policy(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("policy", "checks a policy before it flies");
  command->require_subcommand(1);
  CLI::App* check_command = command->add_subcommand(
      "check",
      "lists what a policy, or either one of a combination, breaks of the common contract");
  const auto options = std::make_shared<CheckOptions>();  // Owners: the parser's callbacks.
  check_command
      ->add_option("FILE", options->file,
                   "a preset (.toml), a script (.lua), a library (.so), or a policy's name")
      ->required();
  add_kernels(*check_command, options->plugins);
  check_command->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace flyball
