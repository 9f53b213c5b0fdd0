// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/tournament.h"

#include "flyball/records/report.h"
#include "flyball/studies/energy_bound.h"
#include "flyball/studies/tournament_store.h"

#include "claimed_folder.h"
#include "commands.h"
#include "flight_batch.h"
#include "seed_list.h"
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

/// One mission of the tournament.
struct Entry : PlannedFlight {
  std::optional<Summary> summary{};  ///< Empty until it has flown.
};
using Entries = std::vector<Entry>;

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
      entries.push_back({std::move(std::get<PlannedFlight>(planned)), std::nullopt});
    }
    if (!names.insert(entries.back().scenario.name).second) {
      return std::vector{Error{ErrorCode::invalid_input,
                               "--worlds has two whose name is \"" + entries.back().scenario.name +
                                   "\"; give each scenario a name of its own"}};
    }
  }
  return entries;
}

/// Keeps the summary; the rest of the record is large, and goes unless it was asked for.
Status keep(const TournamentOptions& options, TournamentStore& store, Entry& entry) {
  if (Status added = store.add(entry.scenario, *entry.summary); !added) {
    return added;
  }
  std::error_code ignored;  // A folder that stays behind is no harm.
  if (!options.keeps_records) {
    std::filesystem::remove_all(entry.folder, ignored);
    const std::filesystem::path of_policy = std::filesystem::path{entry.folder}.parent_path();
    remove_empty({of_policy.parent_path().parent_path().string(), of_policy.parent_path().string(),
                  of_policy.string()});
  }
  return Done{};
}

void show_progress(const Entry& entry, std::size_t done, std::size_t all) {
  const Summary& s = *entry.summary;
  const bool failed = s.failure != MissionFailure::none;
  note("[" + std::to_string(done) + "/" + std::to_string(all) + "] " + s.scenario + " " +
       name_of(entry) + ": " + (failed ? to_string(s.failure) : to_string(s.status)) + " after " +
       std::to_string(static_cast<long>(s.mission_time_s)) + " s, " +
       std::to_string(static_cast<long>(s.energy_total_j() * 1e-3)) + " kJ");
}

Flown fly_missing(const TournamentOptions& options, TournamentStore& store, Entries& entries) {
  std::vector<Entry*> missing;
  std::vector<const PlannedFlight*> flights;
  for (Entry& entry : entries) {
    if (!entry.summary) {
      missing.push_back(&entry);
      flights.push_back(&entry);
    }
  }
  std::size_t done = entries.size() - missing.size();
  std::vector<Error> unwritten;
  Flown flown = fly_all(flights, options.jobs, [&](std::size_t index) {
    Entry& entry = *missing[index];
    const auto run = finished_run(entry.folder, entry.scenario);
    if (!run) {
      return false;
    }
    entry.summary = run->summary;
    if (const Status kept = keep(options, store, entry); !kept) {
      unwritten.push_back(kept.error());
    }
    if (++done; has_watcher()) {
      show_progress(entry, done, entries.size());
    }
    return true;
  });
  if (!unwritten.empty()) {
    flown.errors.push_back(unwritten.front());
    flown.exit_code = exit_bad_input;
  }
  return flown;
}

/// Of each world and seed once; where none is known, of none.
KnownBounds bounds_of(const Entries& entries) {
  KnownBounds bounds;
  std::set<std::string> told;
  for (const Entry& entry : entries) {
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
  for (const Entry& entry : entries) {
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

int fly_and_show(const TournamentOptions& options, TournamentStore& store, Entries& entries) {
  std::size_t reused = 0;
  for (Entry& entry : entries) {
    entry.summary = store.find(entry.scenario);
    reused += entry.summary ? 1 : 0;
  }
  if (reused > 0) {
    note(std::to_string(reused) + " of " + std::to_string(entries.size()) +
         " flights are known from before");
  }
  const Flown flown = fly_missing(options, store, entries);
  if (const std::optional<int> code = unfinished(flown)) {
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
  auto store = TournamentStore::open(out_folder(options) + "/tournament.db");
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
