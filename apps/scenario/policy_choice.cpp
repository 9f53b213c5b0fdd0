// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/scenario/policy_choice.h"

#include "flyball/governors/combined_policy.h"
#include "flyball/governors/preset.h"
#include "flyball/scenario/files.h"

#include "scenario/scenario_parameters.h"
#include <filesystem>
#include <utility>

namespace flyball {
namespace {

/// Empty: it is none, or a broken one, which `choose_policy` will tell.
Preset combination_of(const std::string& name) {
  const auto file = find_shipped("presets", name);
  if (file && std::filesystem::path{*file}.extension() == ".toml") {
    if (const auto preset = load_preset(*file); preset && preset->is_combination()) {
      return *preset;
    }
  }
  return {};
}

Result<std::unique_ptr<Policy>> start_one(const std::string& name,
                                          const Scenario& scenario,
                                          const KnobSettings& knobs,
                                          const BoardModel& board) {
  const auto choice = choose_policy(name, scenario.plugins, scenario.seed);
  if (!choice) {
    return choice.error();
  }
  return choice->started(knobs, board);
}

/// One half of a combination.
Result<std::unique_ptr<Policy>> start_half(const std::string& name,
                                           const Scenario& scenario,
                                           const KnobSettings& knobs,
                                           const BoardModel& board) {
  if (combination_of(name).is_combination()) {
    return Error{ErrorCode::invalid_input,
                 "policy \"" + name + "\" is a combination itself; name one policy"};
  }
  return start_one(name, scenario, knobs, board);
}

}  // namespace

std::vector<std::string> asked_policies(const std::string& name) {
  const Preset both = combination_of(name);
  return both.is_combination() ? std::vector{both.application, both.clock} : std::vector{name};
}

std::vector<std::string> files_behind_policy(const std::string& name) {
  std::vector<std::string> names = asked_policies(name);
  if (names.front() != name) {
    names.insert(names.begin(), name);
  }
  std::vector<std::string> files;
  for (const std::string& one : names) {
    const auto file = find_shipped("presets", one);
    for (std::string& part : file ? files_of_policy(*file) : std::vector<std::string>{}) {
      files.push_back(std::move(part));
    }
  }
  return files;
}

std::string library_of_policy(const std::string& name) {
  for (std::string& part : files_behind_policy(name)) {
    if (std::filesystem::path{part}.extension() == ".so") {
      return std::move(part);
    }
  }
  return {};
}

Result<PolicyChoice> choose_policy(const std::string& name,
                                   const Plugins& plugins,
                                   std::uint64_t seed) {
  const auto file = find_shipped("presets", name);
  if (file) {
    return load_policy(*file, plugins.registry(), seed);
  }
  if (file.error().code == ErrorCode::not_found && plugins.make<Policy>(name)) {
    return PolicyChoice{"policy \"" + name + "\"", [name, plugins] {
                          return Result<std::unique_ptr<Policy>>{plugins.make<Policy>(name)};
                        }};
  }
  return file.error();
}

Result<std::unique_ptr<Policy>> start_policy(const Scenario& scenario,
                                             const KnobSettings& knobs,
                                             const BoardModel& board) {
  const std::string& name = scenario.governor.policy;
  const Preset both = combination_of(name);
  if (!both.is_combination()) {
    return start_one(name, scenario, knobs, board);
  }
  auto application = start_half(both.application, scenario, knobs, board);
  if (!application) {
    return application.error();
  }
  auto clock = start_half(both.clock, scenario, knobs, board);
  if (!clock) {
    return clock.error();
  }
  return std::unique_ptr<Policy>{std::make_unique<CombinedPolicy>(
      std::move(*application), std::move(*clock), from_seconds(scenario.governor.period_s), knobs)};
}

}  // namespace flyball
