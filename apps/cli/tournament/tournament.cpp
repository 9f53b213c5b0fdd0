// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/tournament.h"

#include "flyball/records/report.h"
#include "flyball/studies/energy_bound.h"
#include "flyball/studies/part_gains.h"

#include "cli/claimed_folder.h"
#include "cli/commands.h"
#include "cli/seed_list.h"
#include "cli/tournament/ablations.h"
#include "cli/tournament/hindsight.h"
#include "cli/tournament/tournament_flights.h"
#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <set>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

/// What is flown, and what came of it.
struct Tournament {
  const TournamentOptions& options;
  const std::vector<std::uint64_t>& seeds;
  FlightStore& store;
  TournamentFlights entries;
  Ablations ablations;  ///< Without variants: none.
};

/// Of each world and seed once; where none is known, of none.
KnownBounds bounds_of(const TournamentFlights& entries) {
  KnownBounds bounds;
  std::set<std::string> told;
  for (const TournamentFlight& entry : entries) {
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
/// @param errors  Every pair that is none is added to them.
std::vector<PolicyPair> read_pairs(const TournamentOptions& options,
                                   const Ablations& ablations,
                                   std::vector<Error>& errors) {
  std::set<std::string> rows{options.policies.begin(), options.policies.end()};
  for (const AblatedPolicy& variant : ablations.variants) {
    rows.insert(variant.policy);
  }
  if (options.has_hindsight) {
    rows.insert(fixed_best);
  }
  std::vector<PolicyPair> pairs;
  for (const std::string& text : options.pair_texts) {
    const std::size_t colon = std::min(text.find(':'), text.size());
    const PolicyPair pair{text.substr(0, colon), text.substr(std::min(colon + 1, text.size()))};
    if (rows.count(pair.policy) == 0 || rows.count(pair.to) == 0 || pair.policy == pair.to) {
      errors.push_back(
          {ErrorCode::invalid_input,
           "--pairs has \"" + text + "\"; give two of --policies with a colon between"});
    }
    pairs.push_back(pair);
  }
  return pairs;
}

/// The results of all flights, each under its policy's name in tables.
std::vector<Summary> summaries_of(const TournamentFlights& entries) {
  std::vector<Summary> flights;
  for (const TournamentFlight& entry : entries) {
    flights.push_back(*entry.summary);
    flights.back().policy = entry.row;
  }
  return flights;
}

/// By the name of the world.
using BestSettings = std::map<std::string, BestSetting>;

std::vector<WorldResult> results_of(const Tournament& held, const BestSettings& best) {
  std::vector<Summary> flights = summaries_of(held.entries);
  for (const auto& [world, setting] : best) {
    flights.insert(flights.end(), setting.flights.begin(), setting.flights.end());
  }
  std::vector<WorldResult> worlds =
      tournament_of(flights, held.options.shows_bound ? bounds_of(held.entries) : KnownBounds{},
                    held.options.pairs);
  for (WorldResult& world : worlds) {
    if (const auto found = best.find(world.comparison.scenario); found != best.end()) {
      world.hindsight = found->second.told;
    }
  }
  return worlds;
}

int show(const Tournament& held, const BestSettings& best) {
  const std::vector<WorldResult> worlds = results_of(held, best);
  const std::string& whole = held.ablations.whole;
  const bool ablates = !held.ablations.variants.empty();
  const std::vector<PartGain> gains =
      part_gains(summaries_of(held.entries), whole, held.ablations.variants);
  const std::string report = out_folder(held.options) + "/tournament.html";
  const std::string page =
      tournament_page("Tournament", worlds, ablates ? to_html(whole, gains) : std::string{});
  if (const Status written = write_file(report, page); !written) {
    return refuse({written.error()});
  }
  if (held.options.flight.json) {
    print((ablates ? "{\"worlds\": " + to_json(worlds) + ", \"parts\": " + to_json(gains) + "}"
                   : to_json(worlds)) +
          "\n");
    note("report: " + report);
  } else {
    print(to_text(worlds) + (ablates ? "\n" + to_text(whole, gains) : "") + "report: " + report +
          "\n");
  }
  return exit_success;
}

/// @return The exit code, where not all flew.
std::variant<BestSettings, int> find_best_settings(const Tournament& held) {
  BestSettings best;
  for (const std::string& world : held.options.worlds) {
    const RaceSettings settings{flight_in(held.options, world),
                                {"fixed", {}},
                                held.seeds,
                                out_folder(held.options) + "/candidates",
                                folder_of(held.options, world),
                                batch_of(held.options)};
    note("the best single setting of " + world);
    auto found = find_best_setting(settings, held.store);
    if (const int* code = std::get_if<int>(&found)) {
      return *code;
    }
    BestSetting& setting = std::get<BestSetting>(found);
    const std::string name = setting.flights.front().scenario;
    best.emplace(name, std::move(setting));
  }
  return best;
}

int fly_and_show(Tournament& held) {
  const Flown flown = fly_stored(batch_of(held.options), held.store, pointers_to(held.entries));
  if (const std::optional<int> code = unfinished(flown)) {
    return *code;
  }
  std::variant<BestSettings, int> best{BestSettings{}};
  if (held.options.has_hindsight) {
    best = find_best_settings(held);
  }
  const int* const code = std::get_if<int>(&best);
  return code != nullptr ? *code : show(held, std::get<BestSettings>(best));
}

/// The presets of the variants must be there before their flights can be planned.
std::vector<Error> add_ablations(Tournament& held) {
  if (held.ablations.variants.empty()) {
    return {};
  }
  if (const Status written = write_presets(held.ablations); !written) {
    return {written.error()};
  }
  std::vector<Flier> fliers;
  for (const AblatedPolicy& variant : held.ablations.variants) {
    fliers.push_back({held.ablations.file_of(variant), variant.policy});
  }
  auto planned = plan_flights(held.options, fliers, held.seeds);
  if (auto* errors = std::get_if<std::vector<Error>>(&planned)) {
    return std::move(*errors);
  }
  TournamentFlights& more = std::get<TournamentFlights>(planned);
  std::move(more.begin(), more.end(), std::back_inserter(held.entries));
  return {};
}

int hold(const TournamentOptions& options,
         const std::vector<std::uint64_t>& seeds,
         const Ablations& ablations) {
  std::vector<Flier> fliers;
  for (const std::string& policy : options.policies) {
    fliers.push_back({policy, policy});
  }
  auto planned = plan_flights(options, fliers, seeds);
  if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
    return refuse(*errors);
  }
  remark_on_policies(std::get<TournamentFlights>(planned));
  const auto claimed = ClaimedFolder::claim(out_folder(options));
  if (!claimed) {
    return refuse({claimed.error()});
  }
  auto store = FlightStore::open(out_folder(options) + "/tournament.db");
  if (!store) {
    remove_empty(claimed->made());
    return refuse({store.error()});
  }
  Tournament held{options, seeds, *store, std::move(std::get<TournamentFlights>(planned)),
                  ablations};
  if (const std::vector<Error> errors = add_ablations(held); !errors.empty()) {
    return refuse(errors);
  }
  return fly_and_show(held);
}

/// The policy that flies without its parts flies whole, too.
Result<Ablations> read_ablations(TournamentOptions& options) {
  if (options.ablated.empty()) {
    return Ablations{};
  }
  auto& policies = options.policies;
  if (std::find(policies.begin(), policies.end(), options.ablated) == policies.end()) {
    policies.push_back(options.ablated);
  }
  return find_ablations(options.ablated, options.flight.plugins,
                        out_folder(options) + "/ablations");
}

int hold_tournament(TournamentOptions options) {
  const Result<std::vector<std::uint64_t>> seeds = read_seeds(options.seeds);
  const Result<Ablations> ablations = read_ablations(options);
  std::vector<Error> errors = check_contest(options.flight, options.policies, seeds);
  if (!ablations) {
    errors.push_back(ablations.error());
  } else if (options.policies.empty()) {
    errors.push_back(
        {ErrorCode::invalid_input, "no policy flies; give --policies A,B,C, or --ablate"});
  } else {
    options.pairs = read_pairs(options, *ablations, errors);
  }
  if (!errors.empty()) {
    return refuse(errors);
  }
  return hold(options, *seeds, *ablations);
}

}  // namespace

void add_tournament(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "tournament", "flies policies over several worlds and seeds; continues where it was stopped");
  const auto options = std::make_shared<TournamentOptions>();  // Owners: the parser's callbacks.
  add_names(*command, "--worlds", options->worlds, "scenarios, by name or file").required();
  add_contest(*command, options->policies, options->seeds);
  add_jobs(*command, options->jobs);
  add_names(*command, "--pairs", options->pair_texts,
            "pairs of policies to compare beside those with the first one")
      .type_name("A:B,C:D");
  command->add_option("--set", options->flight.settings, "changes one setting in every world")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  add_kernels(*command, options->flight.plugins);
  command->add_flag("--keep-records", options->keeps_records,
                    "keeps the whole record of each flight, not only its summary");
  command->add_flag("--bound", options->shows_bound,
                    "compares the energy with the lower bound of flyball bound");
  command->add_flag("--hindsight", options->has_hindsight,
                    "finds the single setting of cells, range and planner budget that is best on "
                    "these seeds, world by world, and shows it as fixed_best");
  command
      ->add_option("--ablate", options->ablated,
                   "flies a policy without each of its parts (default: mission_energy), and says "
                   "what each part earns")
      ->expected(0, 1)
      ->default_str("mission_energy")
      ->type_name("[POLICY]");
  command->get_option("--policies")->required(false);
  add_output(*command, options->flight);
  command->callback([options, command, &exit_code] {
    // The option may stand alone, so that no check of its own would see an empty name.
    if (command->count("--ablate") > 0 && options->ablated.empty()) {
      throw CLI::ValidationError{"--ablate", "is empty"};
    }
    exit_code = hold_tournament(*options);
  });
}

}  // namespace flyball
