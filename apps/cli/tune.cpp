// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/mission_files.h"
#include "flyball/records/report.h"
#include "flyball/scenario/files.h"
#include "flyball/studies/comparison.h"
#include "flyball/studies/tuning.h"

#include "claimed_folder.h"
#include "commands.h"
#include "flight_batch.h"
#include "race.h"
#include "seed_list.h"
#include <algorithm>
#include <filesystem>
#include <memory>
#include <thread>
#include <utility>

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

std::string out_folder(const TuneOptions& options) {
  const std::string stem = std::filesystem::path{options.flight.scenario}.stem().string();
  return options.flight.out.empty() ? "flights/tune_" + stem : options.flight.out;
}

std::string preset_file(const TuneOptions& options) {
  return options.preset.empty() ? out_folder(options) + "/tuned.toml" : options.preset;
}

/// Enough to run the race again: what it was on, and the values that were tried.
std::string told(const TuneOptions& options,
                 const std::string& stem,
                 const std::vector<std::uint64_t>& seeds,
                 std::size_t candidates) {
  std::string text = "Tuned for " + stem;
  for (const std::string& setting : options.flight.settings) {
    text += " " + setting;
  }
  text += ": the least energy of " + std::to_string(candidates) + " settings (";
  for (std::size_t i = 0; i < options.tried.size(); ++i) {
    text += (i == 0 ? "" : " ") + options.tried[i];
  }
  return text + ") on seeds " + seeds_text(seeds);
}

int show(const TuneOptions& options, const Race& race, const std::vector<Candidate>& ranked) {
  const std::string stem = std::filesystem::path{options.flight.scenario}.stem().string();
  const std::string path = preset_file(options);
  const std::string description = told(options, stem, race.settings().seeds, ranked.size());
  print(options.flight.json ? to_json(stem, options.policy, ranked) + "\n"
                            : to_text(options.policy, ranked));
  const Status written = write_file(path, race.preset_of(ranked.front(), description));
  if (!written) {  // The table is there all the same.
    return refuse({written.error()});
  }
  if (options.flight.json) {
    note("preset: " + path);
  } else {
    print("preset: " + path + "\n");
  }
  const bool flies = ranked.front().failures() == 0;
  if (!flies) {
    note("no setting flew every seed; the best one is written all the same");
  }
  return flies ? exit_success : exit_mission_failed;
}

/// A preset is found by its ending: under another one, no command would take it.
Status check_preset(const std::string& path) {
  if (path.empty()) {
    return Done{};
  }
  if (std::filesystem::path{path}.extension() != ".toml") {
    return Error{ErrorCode::invalid_input,
                 "--preset " + path + " must end in .toml, or no policy can be read from it"};
  }
  return check_place(path);
}

/// The preset must not take the place of what it is tuned for. A scenario that cannot be read, and
/// names nothing, is refused elsewhere.
Status keep_what_is_tuned(const TuneOptions& options) {
  std::vector<std::string> settings = options.flight.settings;
  settings.push_back("governor.policy=" + options.policy);
  const auto loaded = load_scenario(options.flight.scenario, settings, options.flight.plugins);
  const auto* read = std::get_if<LoadedScenario>(&loaded);
  const Result<std::string> file = find_shipped("scenarios", options.flight.scenario);
  return keep_inputs(read != nullptr ? read->scenario : Scenario{}, {file ? *file : ""},
                     {preset_file(options)});
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

/// The seeds to train on.
/// @param errors  Every mistake in options other than `--try` and `--policy` is added to them.
std::vector<std::uint64_t> training_seeds(const TuneOptions& options, std::vector<Error>& errors) {
  const auto seeds = read_seeds(options.seeds);
  const auto test_seeds = read_seeds(options.test_seeds, "--test-seeds");
  for (const auto* read : {&seeds, &test_seeds}) {
    if (!*read) {
      errors.push_back(read->error());
    }
  }
  if (errors.empty()) {
    if (const auto shared = find_shared_seed(*seeds, *test_seeds)) {
      errors.push_back(*shared);
    }
  }
  add_new(check_settings(options.flight, "--policy"), errors);
  for (const Status& kept : {check_preset(options.preset), keep_what_is_tuned(options)}) {
    if (!kept) {
      errors.push_back(kept.error());
    }
  }
  return errors.empty() ? *seeds : std::vector<std::uint64_t>{};
}

/// @return The exit code.
int race(const TuneOptions& options,
         const RacedPolicy& policy,
         const std::vector<std::uint64_t>& seeds,
         std::vector<Candidate> candidates) {
  const std::string folder = out_folder(options);
  const auto claimed = ClaimedFolder::claim(folder);
  if (!claimed) {
    return refuse({claimed.error()});
  }
  const std::string store_file = folder + "/tune.db";
  const bool is_new = !std::filesystem::exists(store_file);
  auto store = FlightStore::open(store_file);
  if (!store) {
    return refuse({store.error()});
  }
  Race race{{options.flight, policy, seeds, folder + "/candidates", folder, {folder, options.jobs}},
            *store};
  const std::optional<int> code = race.halve(candidates, is_better);
  if (code && is_new && !race.has_begun()) {  // Nothing to go on with.
    std::error_code ignored;
    std::filesystem::remove(store_file, ignored);
    remove_empty(claimed->made());
  }
  return code ? *code : show(options, race, candidates);
}

int tune(const TuneOptions& options) {
  std::vector<Error> errors;
  const std::vector<std::uint64_t> seeds = training_seeds(options, errors);
  const auto tried = read_all_tried(options.tried);
  if (!tried) {
    errors.push_back(tried.error());
  }
  const auto policy = raced_policy(options.policy);
  if (!policy) {
    errors.push_back(policy.error());
  }
  return errors.empty() ? race(options, *policy, seeds, combinations(*tried)) : refuse(errors);
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
