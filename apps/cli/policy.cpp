// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/governors/policy_conformance.h"
#include "flyball/scenario/knobs.h"
#include "flyball/scenario/override.h"
#include "flyball/scenario/policy_choice.h"
#include "flyball/scenario/shipped_platform.h"

#include "commands.h"
#include "console.h"
#include "flight_options.h"
#include <algorithm>
#include <memory>
#include <utility>
#include <variant>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct CheckOptions {
  std::string file{};
  std::string scenario{};  ///< Empty: the knobs and the board that every mission has.
  std::vector<std::string> settings{};
  Plugins plugins{};
};

/// Where the policy is to fly.
struct Place {
  KnobSettings knobs = conformance_knobs();
  BoardModel board = conformance_board();
};

std::variant<Place, std::vector<Error>> place_of(const CheckOptions& options) {
  if (options.scenario.empty()) {
    return Place{};
  }
  const auto loaded =
      load_overridden_scenario(options.scenario, of_set(options.settings), options.plugins);
  if (const auto* errors = std::get_if<std::vector<Error>>(&loaded)) {
    return *errors;
  }
  const Scenario& scenario = std::get<LoadedScenario>(loaded).scenario;
  const auto platform = find_platform(scenario.platform.name);
  if (!platform) {
    return std::vector<Error>{platform.error()};
  }
  auto knobs = standard_knobs(scenario, ModeledPlatform{*platform});
  if (!knobs) {
    return std::vector<Error>{knobs.error()};
  }
  return Place{KnobSettings{std::move(*knobs)}, board_model_of(*platform)};
}

/// Of one policy that is asked.
int check_one(const std::string& file, const CheckOptions& options, const Place& place) {
  constexpr std::uint64_t seed = 1;
  const Result<PolicyChoice> choice = choose_policy(file, options.plugins, seed);
  if (!choice) {
    return refuse({choice.error()});
  }
  if (!choice->caution.empty()) {
    remark(choice->caution);
  }
  std::string why;
  PolicyConformance conformance{{[&choice, &why]() -> std::unique_ptr<Policy> {
                                   auto made = choice->make();
                                   why = made ? "" : ": " + made.error().message;
                                   return made ? std::move(*made) : nullptr;
                                 },
                                 choice->parameters,
                                 {},
                                 place.knobs,
                                 place.board}};
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
  const auto place = place_of(options);
  if (const auto* errors = std::get_if<std::vector<Error>>(&place)) {
    return refuse(*errors);
  }
  int exit_code = exit_success;
  for (const std::string& one : asked_policies(options.file)) {
    exit_code = std::max(exit_code, check_one(one, options, std::get<Place>(place)));
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
  CLI::Option* scenario =
      check_command
          ->add_option("--scenario", options->scenario,
                       "the mission whose knobs and computer the policy is checked with; default: "
                       "the knobs that every mission has")
          ->type_name("SCENARIO");
  refuse_empty(*scenario);
  check_command->add_option("--set", options->settings, "changes one setting of that scenario")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all()
      ->needs(scenario);
  add_kernels(*check_command, options->plugins);
  check_command->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace flyball
