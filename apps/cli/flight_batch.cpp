// SPDX-License-Identifier: BSD-3-Clause

#include "flight_batch.h"

#include "flyball/scenario/overruled_settings.h"
#include "flyball/scenario/policy_choice.h"

#include "children.h"
#include <algorithm>
#include <map>
#include <optional>

namespace flyball {
namespace {

/// What a process that left no record said, or how it ended.
Error failure_of(const PlannedFlight& flight, const ChildEnd& end) {
  const bool by_signal = end.exit_code > exit_by_signal;
  std::string why = by_signal ? "ended by signal " + std::to_string(end.exit_code - exit_by_signal)
                              : "no record, exit code " + std::to_string(end.exit_code);
  if (!end.errors.empty()) {
    why += "; " + end.errors.substr(0, end.errors.find_last_not_of('\n') + 1);
  }
  return {ErrorCode::failed, name_of(flight) + ": " + why};
}

/// Reports a mission that left no record. An error in the input concerns many missions, so it is
/// reported once.
void add_failure(const PlannedFlight& flight, const ChildEnd& end, Flown& flown) {
  Error error = failure_of(flight, end);
  if (end.exit_code == exit_bad_input) {
    error.message = remarked(end.errors);
  }
  add_new({error}, flown.errors);
  flown.exit_code = end.exit_code == exit_bad_input
                        ? exit_bad_input
                        : std::max(flown.exit_code, exit_mission_failed);
}

/// The step of the physics in comparisons, if it differs from that of a single flight. Empty when
/// the scenario does not name one, or when the user has chosen the step.
std::optional<std::string> comparison_step(const LoadedScenario& loaded) {
  const auto entry = [&](const char* key) {
    return *std::find_if(loaded.entries.begin(), loaded.entries.end(),
                         [&](const ConfigEntry& each) { return each.key == key; });
  };
  const bool has_step = loaded.scenario.vehicle.comparison_step_s > 0.0 &&
                        entry("vehicle.physics_step_s").origin == "default";
  return has_step ? std::optional{entry("vehicle.comparison_step_s").value} : std::nullopt;
}

}  // namespace

std::variant<PlannedFlight, std::vector<Error>> plan_flight(const FlightOptions& options,
                                                            const std::string& policy,
                                                            std::uint64_t seed,
                                                            const std::string& folder,
                                                            const std::vector<Override>& varied) {
  PlannedFlight flight;
  flight.given = of_set(options.settings);
  flight.given.insert(flight.given.end(), varied.begin(), varied.end());
  std::vector<Override> overrides = flight.given;
  overrides.push_back({"governor.policy=" + policy, "--policies"});
  overrides.push_back({"seed=" + std::to_string(seed), "--seeds"});
  auto loaded = load_overridden_scenario(options.scenario, overrides, options.plugins);
  if (auto* errors = std::get_if<std::vector<Error>>(&loaded)) {
    return std::move(*errors);
  }
  const auto step_s = comparison_step(std::get<LoadedScenario>(loaded));
  flight.scenario = std::move(std::get<LoadedScenario>(loaded).scenario);
  flight.folder = run_folder(folder.empty() ? comparison_folder(options, flight.scenario) : folder,
                             policy, seed);
  flight.arguments = {
      "run",        options.scenario,     "--policy", flight.scenario.governor.policy,
      "--seed",     std::to_string(seed), "--json",   "--out",
      flight.folder};
  for (const std::string& setting : options.settings) {
    flight.arguments.insert(flight.arguments.end(), {"--set", setting});
  }
  for (const Override& setting : varied) {
    flight.arguments.insert(flight.arguments.end(), {"--set", setting.key_and_value});
  }
  for (const std::string& library : options.plugins.libraries()) {
    flight.arguments.insert(flight.arguments.end(), {"--kernels", library});
  }
  if (step_s) {
    flight.scenario.vehicle.physics_step_s = flight.scenario.vehicle.comparison_step_s;
    flight.arguments.insert(flight.arguments.end(), {"--set", "vehicle.physics_step_s=" + *step_s});
  }
  return flight;
}

void add_new(const std::vector<Error>& errors, std::vector<Error>& all) {
  for (const Error& error : errors) {
    const bool is_known = std::any_of(all.begin(), all.end(), [&error](const Error& other) {
      return other.message == error.message;
    });
    if (!is_known) {
      all.push_back(error);
    }
  }
}

void PolicyRemarks::add(const Scenario& scenario, const std::vector<Override>& given) {
  std::string all = scenario.name + "\n" + scenario.governor.policy;
  for (const auto& [key_and_value, option] : given) {
    all.append("\n").append(option).append(" ").append(key_and_value);
  }
  if (!seen_.insert(std::move(all)).second) {
    return;
  }
  for (const std::string& policy : asked_policies(scenario.governor.policy)) {
    if (asked_.insert(policy).second) {  // To look at a library takes a process of its own.
      const auto choice = choose_policy(policy, scenario.plugins, scenario.seed);
      tell(choice ? choice->caution : "");
    }
  }
  for (const std::string& sentence : overruled_settings(scenario, given)) {
    tell(sentence);
  }
}

void PolicyRemarks::tell(const std::string& sentence) {
  if (!sentence.empty() && told_.insert(sentence).second) {
    remark(sentence);
  }
}

std::string name_of(const PlannedFlight& flight) {
  return flight.scenario.governor.policy + " seed " + std::to_string(flight.scenario.seed);
}

Flown fly_all(const std::vector<const PlannedFlight*>& flights,
              std::size_t jobs,
              const std::function<bool(std::size_t)>& took) {
  std::vector<std::vector<std::string>> arguments;
  arguments.reserve(flights.size());
  for (const PlannedFlight* flight : flights) {
    arguments.push_back(flight->arguments);
  }
  Flown flown;
  flown.signal = run_children(arguments, jobs, [&](const ChildEnd& end) {
    if (!took(end.index)) {
      add_failure(*flights[end.index], end, flown);
    }
  });
  return flown;
}

std::optional<int> unfinished(const Flown& flown) {
  if (flown.signal != 0) {
    note("interrupted; the same command goes on from here");
    return exit_by_signal + flown.signal;
  }
  if (!flown.errors.empty()) {
    (void)refuse(flown.errors);
    return flown.exit_code;
  }
  return std::nullopt;
}

std::vector<Error> check_settings(const FlightOptions& options, const std::string& policy_option) {
  std::vector<Error> errors;
  for (const std::string& setting : options.settings) {
    const std::string key = key_of(setting);
    if (key == "seed" || key == "governor.policy") {
      errors.push_back({ErrorCode::invalid_input, "--set " + setting +
                                                      " has an option of its own; give " +
                                                      (key == "seed" ? "--seeds" : policy_option)});
    }
  }
  return errors;
}

std::vector<Error> check_contest(const FlightOptions& options,
                                 const std::vector<std::string>& policies,
                                 const Result<std::vector<std::uint64_t>>& seeds) {
  std::vector<Error> errors = check_settings(options);
  if (!seeds) {
    errors.push_back(seeds.error());
  }
  std::map<std::string, std::string> by_folder;
  for (const std::string& policy : policies) {
    const auto [other, is_new] = by_folder.emplace(run_folder("", policy, 0), policy);
    if (!is_new) {
      add_new({{ErrorCode::invalid_input,
                other->second == policy
                    ? "--policies has \"" + policy + "\" twice; name each once"
                    : "--policies has \"" + other->second + "\" and \"" + policy +
                          "\", whose flights would have the same name; rename one of them"}},
              errors);
    }
  }
  return errors;
}

}  // namespace flyball
