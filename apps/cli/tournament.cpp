// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/tournament.h"

#include "flyball/records/report.h"
#include "flyball/studies/energy_bound.h"

#include "claimed_folder.h"
#include "commands.h"
#include "seed_list.h"
#include "stored_flights.h"
#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <thread>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct TournamentOptions {
  FlightOptions flight{};  ///< Its scenario is empty: the worlds are.
  std::vector<std::string> worlds{};
  std::vector<std::string> policies{};
  std::string seeds{"1..3"};
  std::vector<std::string> pair_texts{};  ///< `MINE:OTHER`
  std::vector<PolicyPair> pairs{};        ///< The same, read.
  std::size_t jobs{std::max(1U, std::thread::hardware_concurrency())};
  bool keeps_records{};
  bool shows_bound{};
};

using Entries = std::vector<StoredFlight>;

std::string out_folder(const TournamentOptions& options) {
  return options.flight.out.empty() ? "flights/tournament" : options.flight.out;
}

/// World by world, policy by policy, seed by seed; all are checked before the first one flies.
std::variant<Entries, std::vector<Error>> plan(const TournamentOptions& options,
                                               const std::vector<std::uint64_t>& seeds) {
  Entries entries;
  std::set<std::string> names;
  for (const std::string& world : options.worlds) {
    FlightOptions flight = options.flight;
    flight.scenario = world;
    const std::string folder =
        (std::filesystem::path{out_folder(options)} / std::filesystem::path{world}.stem()).string();
    for (std::size_t i = 0; i < options.policies.size() * seeds.size(); ++i) {
      auto planned =
          plan_flight(flight, options.policies[i / seeds.size()], seeds[i % seeds.size()], folder);
      if (auto* errors = std::get_if<std::vector<Error>>(&planned)) {
        return std::move(*errors);
      }
      entries.push_back({std::move(std::get<PlannedFlight>(planned)), "", std::nullopt});
    }
    if (!names.insert(entries.back().scenario.name).second) {
      return std::vector{Error{ErrorCode::invalid_input,
                               "--worlds has two whose name is \"" + entries.back().scenario.name +
                                   "\"; give each scenario a name of its own"}};
    }
  }
  return entries;
}

/// Of each world and seed once; where none is known, of none.
KnownBounds bounds_of(const Entries& entries) {
  KnownBounds bounds;
  std::set<std::string> told;
  for (const StoredFlight& entry : entries) {
    const Scenario& scenario = entry.scenario;
    if (bounds.count({scenario.name, scenario.seed}) > 0) {
      continue;
    }
    const Result<EnergyBound> least = bound_energy(scenario);
    if (least) {
      bounds[{scenario.name, scenario.seed}] = least->energy_j();
    } else if (told.insert(scenario.name).second) {
      note(scenario.name + " has no bound: " + least.error().message);
    }
  }
  return bounds;
}

/// Each is two policies that fly, with a colon between them.
Result<std::vector<PolicyPair>> read_pairs(const TournamentOptions& options) {
  const auto& policies = options.policies;
  const auto flies = [&policies](const std::string& name) {
    return std::find(policies.begin(), policies.end(), name) != policies.end();
  };
  std::vector<PolicyPair> pairs;
  for (const std::string& text : options.pair_texts) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const PolicyPair pair{text.substr(0, colon), text.substr(std::min(colon + 1, text.size()))};
    if (!flies(pair.policy) || !flies(pair.to) || pair.policy == pair.to) {
      return Error{ErrorCode::invalid_input,
                   "--pairs has \"" + text + "\"; give two of --policies with a colon between"};
    }
    pairs.push_back(pair);
  }
  return pairs;
}

int show(const TournamentOptions& options, const Entries& entries) {
  std::vector<Summary> flights;
  for (const StoredFlight& entry : entries) {
    flights.push_back(*entry.summary);
  }
  const std::vector<WorldResult> worlds = tournament_of(
      flights, options.shows_bound ? bounds_of(entries) : KnownBounds{}, options.pairs);
  const std::string report = out_folder(options) + "/tournament.html";
  if (const Status written = write_file(report, tournament_page("Tournament", worlds)); !written) {
    return refuse({written.error()});
  }
  if (options.flight.json) {
    print(to_json(worlds) + "\n");
    note("report: " + report);
  } else {
    print(to_text(worlds) + "report: " + report + "\n");
  }
  return exit_success;
}

int fly_and_show(const TournamentOptions& options, FlightStore& store, Entries& entries) {
  const StoredBatch batch{out_folder(options), options.jobs, options.keeps_records, true};
  if (const std::optional<int> code = unfinished(fly_stored(batch, store, pointers_to(entries)))) {
    return *code;
  }
  return show(options, entries);
}

int hold_tournament(TournamentOptions options) {
  const Result<std::vector<std::uint64_t>> seeds = read_seeds(options.seeds);
  if (!seeds) {
    return refuse({seeds.error()});
  }
  if (const Status distinct = check_distinct(options.policies); !distinct) {
    return refuse({distinct.error()});
  }
  Result<std::vector<PolicyPair>> pairs = read_pairs(options);
  if (!pairs) {
    return refuse({pairs.error()});
  }
  options.pairs = std::move(*pairs);
  auto planned = plan(options, *seeds);
  if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
    return refuse(*errors);
  }
  const auto claimed = ClaimedFolder::claim(out_folder(options));
  if (!claimed) {
    return refuse({claimed.error()});
  }
  auto store = FlightStore::open(out_folder(options) + "/tournament.db");
  if (!store) {
    remove_empty(claimed->made());
    return refuse({store.error()});
  }
  return fly_and_show(options, *store, std::get<Entries>(planned));
}

}  // namespace

void add_tournament(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "tournament", "flies policies over several worlds and seeds; continues where it was stopped");
  const auto options = std::make_shared<TournamentOptions>();  // Owners: the parser's callbacks.
  refuse_empty(*command->add_option("--worlds", options->worlds, "scenarios, by name or file")
                    ->delimiter(',')
                    ->required()
                    ->type_name("A,B,C"));
  add_contest(*command, options->policies, options->seeds);
  add_jobs(*command, options->jobs);
  refuse_empty(*command
                    ->add_option("--pairs", options->pair_texts,
                                 "pairs of policies to compare beside those with the first one")
                    ->delimiter(',')
                    ->type_name("A:B,C:D"));
  command->add_option("--set", options->flight.settings, "changes one setting in every world")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  add_kernels(*command, options->flight.plugins);
  command->add_flag("--keep-records", options->keeps_records,
                    "keeps the whole record of each flight, not only its summary");
  command->add_flag("--bound", options->shows_bound,
                    "compares the energy with the lower bound of flyball bound");
  add_output(*command, options->flight);
  command->callback([options, &exit_code] { exit_code = hold_tournament(*options); });
}

}  // namespace flyball
