// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/drift.h"

#include "flyball/records/report.h"
#include "flyball/records/text_table.h"
#include "flyball/studies/policy_trouble.h"

#include "claimed_folder.h"
#include "commands.h"
#include "flight_batch.h"
#include "seed_list.h"
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <thread>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace flyball {
namespace {

// The first 50 bounds after an event are not counted, because a policy needs time to notice it.
constexpr std::uint64_t first_bound = 51;
constexpr std::uint64_t last_bound = 450;

struct DriftOptions {
  FlightOptions flight{};
  std::vector<std::string> policies{};
  std::string seeds{"1..1"};
  double at_s{30.0};
  std::size_t jobs{std::max(1U, std::thread::hardware_concurrency())};
};

struct DriftEntry : PlannedFlight {
  std::size_t drift{};   ///< Of the cases.
  std::size_t policy{};  ///< Of the policies.
};

/// What all seeds of one policy under one event came to.
struct Outcome {
  DriftCount latency_bounds{};
  std::map<double, DriftCount> levels{};  ///< By resolution [m]; of whole flights.
  std::size_t flights{};
  std::size_t succeeded{};
  std::size_t collisions{};
  double energy_j{};  ///< Sum of those that succeeded: one that failed early needed little.
  PolicyTrouble trouble{};

  /// Empty where none succeeded.
  [[nodiscard]] std::optional<double> energy_mean_j() const {
    return succeeded == 0 ? std::nullopt : std::optional{energy_j / static_cast<double>(succeeded)};
  }
};

using DriftEntries = std::vector<DriftEntry>;

/// The flights of one event, which is `cases[drift]`, or why some cannot be flown.
std::variant<DriftEntries, std::vector<Error>> plan_event(const DriftOptions& options,
                                                          const std::vector<DriftCase>& cases,
                                                          std::size_t drift,
                                                          const std::vector<std::uint64_t>& seeds) {
  DriftEntries entries;
  std::vector<Error> all;
  FlightOptions flight = options.flight;
  flight.settings.insert(flight.settings.end(), cases[drift].settings.begin(),
                         cases[drift].settings.end());
  for (std::size_t policy = 0; policy < options.policies.size(); ++policy) {
    for (const std::uint64_t seed : seeds) {
      auto planned = plan_flight(flight, options.policies[policy], seed, "");
      if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
        add_new(*errors, all);
        continue;
      }
      auto& one = std::get<PlannedFlight>(planned);
      const std::string folder =
          comparison_folder(options.flight, one.scenario) + "/" + cases[drift].name;
      one.folder = run_folder(folder, options.policies[policy], seed);
      *(std::find(one.arguments.begin(), one.arguments.end(), "--out") + 1) = one.folder;
      entries.push_back({std::move(one), drift, policy});
    }
  }
  if (!all.empty()) {
    return all;
  }
  return entries;
}

std::variant<DriftEntries, std::vector<Error>> plan(const DriftOptions& options,
                                                    const std::vector<DriftCase>& cases,
                                                    const std::vector<std::uint64_t>& seeds) {
  DriftEntries entries;
  std::vector<Error> all;
  for (std::size_t drift = 0; drift < cases.size(); ++drift) {
    auto planned = plan_event(options, cases, drift, seeds);
    if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
      add_new(*errors, all);
    } else {
      auto& more = std::get<DriftEntries>(planned);
      std::move(more.begin(), more.end(), std::back_inserter(entries));
    }
  }
  if (!all.empty()) {
    return all;
  }
  return entries;
}

Status add(const DriftEntry& entry, double at_s, Outcome& outcome) {
  const auto picture = finished_run(entry.folder, entry.scenario);
  const Result<DriftRecord> record = read_drift_record(entry.folder);
  if (!picture || !record) {
    return record ? Error{ErrorCode::failed, "no record in \"" + entry.folder + "\""}
                  : record.error();
  }
  ++outcome.flights;
  if (has_succeeded(picture->summary)) {
    ++outcome.succeeded;
    outcome.energy_j += picture->summary.energy_total_j();
  }
  outcome.collisions += picture->summary.failure == MissionFailure::collision ? 1 : 0;
  outcome.trouble.add(picture->summary);
  const DriftCount count =
      count_bounds(*record, MissionTime{from_seconds(at_s)}, first_bound, last_bound);
  outcome.latency_bounds.decisions += count.decisions;
  outcome.latency_bounds.late += count.late;
  for (const LevelBounds& level : picture->summary.latency_bounds) {
    outcome.levels[level.resolution_m].decisions += level.issued;
    outcome.levels[level.resolution_m].late += level.late;
  }
  return Done{};
}

std::string percent(double share) {
  return rounded(100.0 * share, 1) + " %";
}

std::string share_of(const DriftCount& count) {
  return count.decisions > 0 ? percent(count.late_share()) : "-";
}

/// A bound is kept on the whole only if it is kept in rarely used levels, too.
std::string levels_text(const DriftOptions& options,
                        const std::vector<DriftCase>& cases,
                        const std::vector<Outcome>& outcomes) {
  std::vector<std::vector<std::string>> lines{
      {"event", "policy", "cells m", "late", "of bounds", "share"}};
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    for (const auto& [resolution_m, count] : outcomes[i].levels) {
      lines.push_back({cases[i / options.policies.size()].name,
                       options.policies[i % options.policies.size()], rounded(resolution_m, 4),
                       std::to_string(count.late), std::to_string(count.decisions),
                       share_of(count)});
    }
  }
  return lines.size() == 1
             ? ""
             : "Latency bounds of each size of cells, of whole flights:\n" + aligned(lines);
}

/// Under all events together.
std::string troubles_text(const DriftOptions& options, const std::vector<Outcome>& outcomes) {
  std::string text;
  for (std::size_t policy = 0; policy < options.policies.size(); ++policy) {
    PolicyTrouble all;
    for (std::size_t i = policy; i < outcomes.size(); i += options.policies.size()) {
      all.add(outcomes[i].trouble);
    }
    const std::string sentence = all.text(options.policies[policy]);
    text += sentence + (sentence.empty() ? "" : "\n");
  }
  return text;
}

std::string to_text(const DriftOptions& options,
                    const std::vector<DriftCase>& cases,
                    const std::vector<Outcome>& outcomes) {
  std::vector<std::vector<std::string>> lines{
      {"event", "policy", "late", "of bounds", "share", "succeeded", "collisions", "energy kJ"}};
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& one = outcomes[i];
    const std::optional<double> energy_j = one.energy_mean_j();
    lines.push_back(
        {cases[i / options.policies.size()].name, options.policies[i % options.policies.size()],
         std::to_string(one.latency_bounds.late), std::to_string(one.latency_bounds.decisions),
         share_of(one.latency_bounds),
         std::to_string(one.succeeded) + "/" + std::to_string(one.flights),
         std::to_string(one.collisions), energy_j ? rounded(1e-3 * *energy_j, 1) : "-"});
  }
  std::string text = "Latency bounds " + std::to_string(first_bound) + " to " +
                     std::to_string(last_bound) + " after the event, over all seeds:\n" +
                     aligned(lines) + levels_text(options, cases, outcomes) +
                     troubles_text(options, outcomes);
  for (const DriftCase& drift : cases) {
    text += drift.name + ": " + drift.description + "\n";
  }
  return text;
}

nlohmann::ordered_json share_in_json(const DriftCount& count) {
  return count.decisions > 0 ? nlohmann::ordered_json(count.late_share())
                             : nlohmann::ordered_json();
}

nlohmann::ordered_json levels_in_json(const Outcome& one) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const auto& [resolution_m, count] : one.levels) {
    all.push_back({{"resolution_m", resolution_m},
                   {"latency_bounds", count.decisions},
                   {"late", count.late},
                   {"late_share", share_in_json(count)}});
  }
  return all;
}

std::string to_json(const DriftOptions& options,
                    const std::vector<DriftCase>& cases,
                    const std::vector<Outcome>& outcomes) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& one = outcomes[i];
    const std::optional<double> energy_j = one.energy_mean_j();
    all.push_back({{"event", cases[i / options.policies.size()].name},
                   {"policy", options.policies[i % options.policies.size()]},
                   {"latency_bounds", one.latency_bounds.decisions},
                   {"late", one.latency_bounds.late},
                   {"late_share", share_in_json(one.latency_bounds)},
                   {"levels", levels_in_json(one)},
                   {"flights", one.flights},
                   {"succeeded", one.succeeded},
                   {"collisions", one.collisions},
                   {"policy_faults", one.trouble.faults},
                   {"policy_trouble", one.trouble.why},
                   {"energy_mean_j",
                    energy_j ? nlohmann::ordered_json(*energy_j) : nlohmann::ordered_json()}});
  }
  return all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

int show(const DriftOptions& options,
         const std::vector<DriftCase>& cases,
         const DriftEntries& entries) {
  std::vector<Outcome> outcomes(cases.size() * options.policies.size());
  for (const DriftEntry& entry : entries) {
    Outcome& outcome = outcomes[entry.drift * options.policies.size() + entry.policy];
    if (const Status added = add(entry, options.at_s, outcome); !added) {
      return refuse({added.error()});
    }
  }
  print(options.flight.json ? to_json(options, cases, outcomes)
                            : to_text(options, cases, outcomes));
  return exit_success;
}

/// Where no flight can be planned, the one that says why.
std::vector<DriftCase> cases_of(const DriftOptions& options, std::uint64_t seed) {
  const auto planned = plan_flight(options.flight, options.policies.front(), seed, "");
  const auto* flight = std::get_if<PlannedFlight>(&planned);
  return flight == nullptr ? std::vector<DriftCase>{{}}
                           : drift_cases(options.at_s, flight->scenario);
}

int drift(const DriftOptions& options) {
  const Result<std::vector<std::uint64_t>> seeds = read_seeds(options.seeds);
  if (const auto errors = check_contest(options.flight, options.policies, seeds); !errors.empty()) {
    return refuse(errors);
  }
  const std::vector<DriftCase> cases = cases_of(options, seeds->front());
  auto planned = plan(options, cases, *seeds);
  if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
    return refuse(*errors);
  }
  const DriftEntries& entries = std::get<DriftEntries>(planned);
  remark_on_policies(entries);
  const auto claimed =
      ClaimedFolder::claim(comparison_folder(options.flight, entries.front().scenario));
  if (!claimed) {
    return refuse({claimed.error()});
  }
  for (const DriftCase& one : cases) {
    if (!one.caveat.empty()) {
      remark(one.caveat);
    }
  }
  std::vector<const PlannedFlight*> flights;
  for (const DriftEntry& entry : entries) {
    if (!finished_run(entry.folder, entry.scenario)) {
      flights.push_back(&entry);
    }
  }
  std::size_t done = entries.size() - flights.size();
  const Flown flown = fly_all(flights, options.jobs, [&](std::size_t index) {
    const auto& flight = *flights[index];
    const bool left_record = finished_run(flight.folder, flight.scenario).has_value();
    if (left_record && has_watcher()) {
      note("[" + std::to_string(++done) + "/" + std::to_string(entries.size()) + "] " +
           flight.folder);
    }
    return left_record;
  });
  if (const std::optional<int> code = unfinished(flown)) {
    return *code;
  }
  return show(options, cases, entries);
}

}  // namespace

void add_drift(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "drift", "counts the latency bounds that policies violate after the computer has changed");
  const auto options = std::make_shared<DriftOptions>();  // Owners: the parser's callbacks.
  add_scenario(*command, options->flight);
  add_contest(*command, options->policies, options->seeds);
  refuse_nan(
      *command->add_option("--at", options->at_s, "mission time at which the computer changes")
           ->check(CLI::Range(0.0, 86400.0))
           ->type_name("SECONDS"));
  add_jobs(*command, options->jobs);
  add_output(*command, options->flight);
  command->callback([options, &exit_code] { exit_code = drift(*options); });
}

}  // namespace flyball
