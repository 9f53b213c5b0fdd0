// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/sweep.h"

#include "flyball/records/report.h"
#include "flyball/runtime/program.h"

#include "cli/claimed_folder.h"
#include "cli/commands.h"
#include "cli/seed_list.h"
#include "cli/sweep/on_slurm.h"
#include "cli/sweep/slurm.h"
#include "cli/sweep/sweep_flights.h"
#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <thread>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct SweepOptions {
  FlightOptions flight{};
  std::vector<std::string> over{};
  std::vector<std::string> policies{};  ///< Empty: that of the scenario.
  std::string seeds{"1..3"};
  std::size_t jobs{std::max(1U, std::thread::hardware_concurrency())};
  bool keeps_records{};
  std::string on{};    ///< `slurm`, or empty: here.
  std::string part{};  ///< `2/8`: the second of eight tasks of an array.
};

Error bad(const std::string& sentence) {
  return {ErrorCode::invalid_input, sentence};
}

/// Each setting once, and none that has an option of its own.
Result<std::vector<SweepAxis>> read_axes(const SweepOptions& options) {
  std::vector<SweepAxis> axes;
  std::set<std::string> keys;
  for (const std::string& text : options.over) {
    Result<SweepAxis> axis = read_axis(text);
    if (!axis) {
      return axis.error();
    }
    if (axis->key == "seed" || axis->key == "governor.policy") {
      return bad("--over " + text + " has an option of its own; give " +
                 (axis->key == "seed" ? "--seeds" : "--policies"));
    }
    if (!keys.insert(axis->key).second) {
      return bad("--over names " + axis->key + " twice; give all its values at once");
    }
    axes.push_back(std::move(*axis));
  }
  for (const std::string& setting : options.flight.settings) {
    const std::string key = setting.substr(0, setting.find('='));
    if (keys.count(key) > 0) {
      return bad("--set " + setting + " is one of --over, too; leave it out");
    }
  }
  return axes;
}

/// The scenario's name and, where none was asked for, its policy.
std::variant<SweepRequest, std::vector<Error>> request_of(const SweepOptions& options) {
  auto axes = read_axes(options);
  auto seeds = read_seeds(options.seeds);
  std::vector<Error> errors;
  if (!axes) {
    errors.push_back(axes.error());
  }
  if (!seeds) {
    errors.push_back(seeds.error());
  }
  if (const Status distinct = check_distinct(options.policies); !distinct) {
    errors.push_back(distinct.error());
  }
  auto loaded =
      load_scenario(options.flight.scenario, options.flight.settings, options.flight.plugins);
  if (auto* wrong = std::get_if<std::vector<Error>>(&loaded)) {
    errors.insert(errors.end(), wrong->begin(), wrong->end());
  }
  if (!errors.empty()) {
    return errors;
  }
  const Scenario& scenario = std::get<LoadedScenario>(loaded).scenario;
  SweepRequest request{
      options.flight, {scenario.name, std::move(*axes), options.policies, std::move(*seeds)}, {}};
  if (request.plan.policies.empty()) {
    request.plan.policies.push_back(scenario.governor.policy);
  }
  request.batch = {
      options.flight.out.empty() ? "flights/sweep_" + scenario.name : options.flight.out,
      options.jobs, options.keeps_records, true};
  return request;
}

Status write_results(const std::string& folder, const Sweep& sweep) {
  Status written = write_file(folder + "/cells.csv", cells_csv(sweep));
  written = written ? write_file(folder + "/flights.csv", flights_csv(sweep)) : written;
  return written ? write_file(folder + "/sweep.html", sweep_page(sweep)) : written;
}

int show(const SweepRequest& request, const std::vector<StoredFlight>& flights) {
  std::vector<SweepFlight> flown;
  for (std::size_t i = 0; i < flights.size(); ++i) {
    flown.push_back({i / request.plan.seeds.size(), command_of(flights[i]), *flights[i].summary});
  }
  const Sweep sweep = sweep_of(request.plan, point_commands(request), std::move(flown));
  const std::string& folder = request.batch.folder;
  if (const Status written = write_results(folder, sweep); !written) {
    return refuse({written.error()});
  }
  const std::string files = "report: " + folder + "/sweep.html, with cells.csv and flights.csv";
  if (request.flight.json) {
    print(to_json(sweep) + "\n");
    note(files);
  } else {
    print(to_text(sweep) + files + "\n");
  }
  return exit_success;
}

int fly_and_show(const SweepRequest& request,
                 FlightStore& store,
                 std::vector<StoredFlight>& flights,
                 std::optional<std::size_t> slurm_processors) {
  const std::vector<StoredFlight*> all = pointers_to(flights);
  if (slurm_processors) {
    std::vector<std::string> task = sweep_words(request);
    task.front() = program_file();
    task.insert(task.end(), {"--out", request.batch.folder, "--part"});
    const FlightArray array{request.batch.folder, std::move(task), *slurm_processors};
    if (const auto code = fly_on_slurm(array, store, all)) {
      return *code;
    }
  } else if (const auto code = unfinished(fly_stored(request.batch, store, all))) {
    return *code;
  }
  return show(request, flights);
}

int sweep(const SweepOptions& options) {
  auto read = request_of(options);
  if (const auto* errors = std::get_if<std::vector<Error>>(&read)) {
    return refuse(*errors);
  }
  const SweepRequest& request = std::get<SweepRequest>(read);
  if (!options.part.empty()) {
    return fly_part(request.batch, options.part,
                    [&](std::size_t number, const std::string& folder) {
                      SweepRequest part = request;
                      part.batch.folder = folder;
                      return plan_sweep_flight(part, number);
                    });
  }
  auto planned = plan_sweep(request);
  if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
    return refuse(*errors);
  }
  std::optional<std::size_t> processors;
  if (!options.on.empty()) {
    const auto of_slurm = slurm_processors();
    if (!of_slurm) {
      return refuse({of_slurm.error()});
    }
    processors = *of_slurm;
  }
  const auto claimed = ClaimedFolder::claim(request.batch.folder);
  if (!claimed) {
    return refuse({claimed.error()});
  }
  auto store = FlightStore::open(request.batch.folder + "/sweep.db");
  if (!store) {
    remove_empty(claimed->made());
    return refuse({store.error()});
  }
  return fly_and_show(request, *store, std::get<std::vector<StoredFlight>>(planned), processors);
}

}  // namespace

void add_sweep(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "sweep",
      "flies every combination of values of some settings; continues where it was stopped");
  const auto options = std::make_shared<SweepOptions>();  // Owners: the parser's callbacks.
  add_scenario(*command, options->flight);
  refuse_empty(
      *command
           ->add_option("--over", options->over,
                        "a setting and its values; with several, every combination of them")
           ->type_name("KEY=A,B,C")
           ->expected(1)
           ->required()
           ->take_all());
  add_contest(*command, options->policies, options->seeds);
  command->get_option("--policies")
      ->required(false)
      ->description("names from `flyball list policies`, or files (default: the scenario's own)");
  add_jobs(*command, options->jobs);
  CLI::Option* const on =
      command
          ->add_option("--on", options->on,
                       "where to fly: `slurm` hands the flights to a cluster as one job array, "
                       "which shares the folder --out")
          ->check(CLI::IsMember({"slurm"}))
          ->type_name("slurm");
  on->excludes(command->get_option("--jobs"));
  command->add_flag("--keep-records", options->keeps_records,
                    "keeps the whole record of each flight, not only its summary");
  // What the tasks of an array are started with.
  command->add_option("--part", options->part)->group("")->excludes(on);
  add_output(*command, options->flight);
  command->callback([options, &exit_code] { exit_code = sweep(*options); });
}

}  // namespace flyball
