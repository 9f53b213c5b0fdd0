// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/report.h"
#include "flyball/studies/comparison.h"
#include "flyball/studies/tuning.h"

#include "claimed_folder.h"
#include "commands.h"
#include "seed_list.h"
#include "stored_flights.h"
#include <algorithm>
#include <filesystem>
#include <memory>
#include <thread>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct TuneOptions {
  FlightOptions flight{};
  std::string policy{"fixed"};
  std::vector<std::string> tried{};
  std::string seeds{"1001..1008"};
  std::string test_seeds{"1..1000"};
  std::string preset{};
  std::size_t jobs{std::max(1U, std::thread::hardware_concurrency())};
};

/// One candidate with one seed.
struct Heat : StoredFlight {
  std::size_t candidate{};
};

/// What the whole race needs.
struct Race {
  const TuneOptions& options;
  std::vector<std::uint64_t> seeds;
  std::string folder;
  FlightStore& store;
  std::vector<Candidate> candidates;
};

std::string out_folder(const TuneOptions& options) {
  const std::string stem = std::filesystem::path{options.flight.scenario}.stem().string();
  return options.flight.out.empty() ? "flights/tune_" + stem : options.flight.out;
}

/// Its preset, under a name that says its parameters: the same candidate has the same file.
std::string preset_file(const Race& race, const Candidate& candidate) {
  std::string name = race.options.policy;
  for (const auto& [parameter, value] : candidate.parameters) {
    std::string number = std::to_string(value);
    std::replace(number.begin(), number.end(), '.', '_');
    name += "-" + parameter + "-" + number;
  }
  return race.folder + "/candidates/" + name + ".toml";
}

std::variant<std::vector<Heat>, std::vector<Error>> plan_round(Race& race,
                                                               const TuningRound& round) {
  std::vector<Heat> heats;
  for (std::size_t i = 0; i < round.candidates; ++i) {
    const Candidate& candidate = race.candidates[i];
    const std::string file = preset_file(race, candidate);
    for (std::size_t k = candidate.flights.size(); k < round.seeds; ++k) {
      auto planned = plan_flight(race.options.flight, file, race.seeds[k], race.folder);
      if (auto* errors = std::get_if<std::vector<Error>>(&planned)) {
        return std::move(*errors);
      }
      heats.push_back({{std::move(std::get<PlannedFlight>(planned)), "", std::nullopt}, i});
    }
  }
  return heats;
}

Flown fly_round(Race& race, std::vector<Heat>& heats) {
  Flown flown = fly_stored({race.folder, race.options.jobs}, race.store, pointers_to(heats));
  if (flown.signal == 0 && flown.errors.empty()) {
    for (const Heat& heat : heats) {
      race.candidates[heat.candidate].flights.push_back(*heat.summary);
    }
  }
  return flown;
}

Status write_presets(const Race& race) {
  const auto prepared = prepare_folder(race.folder + "/candidates");
  if (!prepared) {
    return prepared.error();
  }
  for (const Candidate& candidate : race.candidates) {
    const std::string text = preset_text(race.options.policy, "A candidate of a race", candidate);
    if (Status written = write_file(preset_file(race, candidate), text); !written) {
      return written;
    }
  }
  return Done{};
}

/// Enough to run the race again: what it was on, and the values that were tried.
std::string told(const Race& race, const std::string& stem) {
  std::string text = "Tuned for " + stem;
  for (const std::string& setting : race.options.flight.settings) {
    text += " " + setting;
  }
  text += ": the least energy of " + std::to_string(race.candidates.size()) + " settings (";
  for (std::size_t i = 0; i < race.options.tried.size(); ++i) {
    text += (i == 0 ? "" : " ") + race.options.tried[i];
  }
  return text + ") on seeds " + seeds_text(race.seeds);
}

int show(const Race& race) {
  const TuneOptions& options = race.options;
  const std::string stem = std::filesystem::path{options.flight.scenario}.stem().string();
  const std::string path = options.preset.empty() ? race.folder + "/tuned.toml" : options.preset;
  const Status written =
      write_file(path, preset_text(options.policy, told(race, stem), race.candidates.front()));
  if (!written) {
    return refuse({written.error()});
  }
  if (options.flight.json) {
    print(to_json(stem, options.policy, race.candidates) + "\n");
    note("preset: " + path);
  } else {
    print(to_text(race.candidates) + "preset: " + path + "\n");
  }
  const bool flies = race.candidates.front().failures() == 0;
  if (!flies) {
    note("no setting flew every seed; the best one is written all the same");
  }
  return flies ? exit_success : exit_mission_failed;
}

int run(Race& race) {
  if (const Status written = write_presets(race); !written) {
    return refuse({written.error()});
  }
  for (const TuningRound& round : tuning_rounds(race.candidates.size(), race.seeds.size())) {
    note("round: " + std::to_string(round.candidates) + " settings, " +
         std::to_string(round.seeds) + " seeds");
    auto planned = plan_round(race, round);
    if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
      return refuse(*errors);
    }
    const Flown flown = fly_round(race, std::get<std::vector<Heat>>(planned));
    if (const std::optional<int> code = unfinished(flown)) {
      return *code;
    }
    std::stable_sort(race.candidates.begin(),
                     race.candidates.begin() + static_cast<std::ptrdiff_t>(round.candidates),
                     is_better);
  }
  return show(race);
}

/// A setting that was tuned on the seeds that it is tested with proves nothing.
std::optional<Error> find_shared_seed(const std::vector<std::uint64_t>& training,
                                      const std::vector<std::uint64_t>& test) {
  for (const std::uint64_t seed : training) {
    if (std::find(test.begin(), test.end(), seed) != test.end()) {
      return Error{ErrorCode::invalid_input, "--seeds and --test-seeds both have " +
                                                 std::to_string(seed) +
                                                 "; what is tuned on a seed must not be tested "
                                                 "with it"};
    }
  }
  return std::nullopt;
}

int tune(const TuneOptions& options) {
  const auto seeds = read_seeds(options.seeds);
  const auto test_seeds = read_seeds(options.test_seeds);
  if (!seeds || !test_seeds) {
    return refuse({seeds ? test_seeds.error() : seeds.error()});
  }
  if (const auto shared = find_shared_seed(*seeds, *test_seeds)) {
    return refuse({*shared});
  }
  std::vector<TriedParameter> tried;
  for (const std::string& text : options.tried) {
    auto parameter = read_tried(text);
    if (!parameter) {
      return refuse({parameter.error()});
    }
    tried.push_back(std::move(*parameter));
  }
  const std::string folder = out_folder(options);
  const auto claimed = ClaimedFolder::claim(folder);
  if (!claimed) {
    return refuse({claimed.error()});
  }
  auto store = FlightStore::open(folder + "/tune.db");
  if (!store) {
    return refuse({store.error()});
  }
  Race race{options, *seeds, folder, *store, combinations(tried)};
  return run(race);
}

}  // namespace

void add_tune(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "tune", "finds the parameters of a policy that cost a scenario the least energy");
  const auto options = std::make_shared<TuneOptions>();  // Owners: the parser's callbacks.
  add_scenario(*command, options->flight);
  refuse_empty(*command->add_option("--policy", options->policy, "policy to tune (default: fixed)")
                    ->type_name("NAME"));
  refuse_empty(*command
                    ->add_option("--try", options->tried,
                                 "values for a parameter; with several, every combination")
                    ->type_name("NAME=A,B")
                    ->expected(1)
                    ->required()
                    ->take_all());
  command->add_option("--seeds", options->seeds, "to train on (default: 1001..1008)")
      ->type_name("A..B");
  command
      ->add_option("--test-seeds", options->test_seeds,
                   "kept for tests, so never trained on (default: 1..1000)")
      ->type_name("A..B");
  refuse_empty(*command
                    ->add_option("--preset", options->preset,
                                 "file for the best one (default: tuned.toml in --out)")
                    ->type_name("FILE"));
  add_jobs(*command, options->jobs);
  add_output(*command, options->flight);
  command->callback([options, &exit_code] { exit_code = tune(*options); });
}

}  // namespace flyball
