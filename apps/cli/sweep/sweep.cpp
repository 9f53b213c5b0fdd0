// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/sweep.h"

#include "flyball/records/report.h"
#include "flyball/runtime/program.h"

#include "cli/commands.h"
#include "cli/seed_list.h"
#include "cli/sweep/on_slurm.h"
#include "cli/sweep/stored_study.h"
#include "cli/sweep/sweep_flights.h"
#include <memory>
#include <set>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct SweepOptions {
  FlightOptions flight{};
  std::vector<std::string> over{};
  std::vector<std::string> policies{};  ///< Empty: that of the scenario.
  std::string seeds{"1..3"};
  StudyOptions study{};
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
    const std::string key = key_of(setting);
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
  const auto contest = check_contest(options.flight, options.policies, seeds);
  errors.insert(errors.end(), contest.begin(), contest.end());
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
      options.study.jobs, options.study.keeps_records, true};
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

/// What a task of an array is started with, up to its part.
std::vector<std::string> task_command(const SweepRequest& request) {
  std::vector<std::string> words = sweep_words(request);
  words.front() = program_file();
  words.insert(words.end(), {"--out", request.batch.folder, "--part"});
  return words;
}

int sweep(const SweepOptions& options) {
  auto read = request_of(options);
  if (const auto* errors = std::get_if<std::vector<Error>>(&read)) {
    return refuse(*errors);
  }
  const SweepRequest& request = std::get<SweepRequest>(read);
  if (!options.study.part.empty()) {
    return fly_part(request.batch, options.study.part,
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
  auto& flights = std::get<std::vector<StoredFlight>>(planned);
  remark_on_policies(flights);
  const Study study{request.batch, "sweep.db", task_command(request), pointers_to(flights)};
  const auto code = fly_study(study, options.study);
  return code ? *code : show(request, flights);
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
  add_study_options(*command, options->study);
  add_output(*command, options->flight);
  command->callback([options, &exit_code] { exit_code = sweep(*options); });
}

}  // namespace flyball
