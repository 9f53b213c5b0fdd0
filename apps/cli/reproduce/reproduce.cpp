// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/report.h"
#include "flyball/runtime/program.h"

#include "cli/commands.h"
#include "cli/reproduce/experiment_flights.h"
#include "cli/sweep/on_slurm.h"
#include "cli/sweep/stored_study.h"
#include "scenario/scenario_keys.h"
#include <algorithm>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct ReproduceOptions {
  std::vector<std::string> experiments{};  ///< Empty: all.
  std::size_t seeds{3};
  std::string out{"flights/reproduce"};
  StudyOptions study{};
};

/// Those that were asked for, in the order of their names.
std::variant<std::vector<NamedExperiment>, std::vector<Error>> chosen(
    const std::vector<std::string>& names) {
  const std::vector<NamedExperiment> all = all_experiments();
  std::vector<std::string> known;
  known.reserve(all.size());
  for (const NamedExperiment& each : all) {
    known.push_back(each.name);
  }
  std::vector<Error> errors;
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      errors.push_back({ErrorCode::not_found, "no experiment \"" + name + "\"; " +
                                                  name_meant(name, known) +
                                                  "try: flyball list experiments"});
    }
  }
  if (!errors.empty()) {
    return errors;
  }
  std::vector<NamedExperiment> wanted;
  std::copy_if(all.begin(), all.end(), std::back_inserter(wanted), [&](const auto& each) {
    return names.empty() || std::find(names.begin(), names.end(), each.name) != names.end();
  });
  return wanted;
}

Status write_result(const std::string& folder, const ExperimentResult& result) {
  const std::string own = folder + "/" + result.named.name;
  if (auto made = prepare_folder(own); !made) {
    return made.error();
  }
  Status written = Done{};
  for (const Figure& figure : result.findings.figures) {
    written = written ? write_file(own + "/" + figure.file + ".csv", to_csv(figure)) : written;
  }
  for (const auto& [name, sweep] : result.sweeps) {
    written = written ? write_file(own + "/" + name + "_cells.csv", cells_csv(sweep)) : written;
    written = written ? write_file(own + "/" + name + "_flights.csv", flights_csv(sweep)) : written;
  }
  return written;
}

Status write_results(const ReproduceRequest& request,
                     const std::vector<ExperimentResult>& results) {
  const std::string& folder = request.batch.folder;
  Status written = write_file(folder + "/claims.csv", claims_csv(results));
  written = written ? write_file(folder + "/RESULTS.md", experiments_markdown(results)) : written;
  for (const ExperimentResult& result : results) {
    written = written ? write_result(folder, result) : written;
  }
  return written ? write_file(folder + "/reproduce.html", experiments_page(results, request.seeds))
                 : written;
}

int show(const ReproduceRequest& request, const ExperimentFlights& flown) {
  const std::vector<ExperimentResult> results = results_of(request, flown);
  if (const Status written = write_results(request, results); !written) {
    return refuse({written.error()});
  }
  print(to_text(results) + "report: " + request.batch.folder +
        "/reproduce.html, with RESULTS.md, claims.csv and a folder of CSV files for each "
        "experiment\n");
  const bool has_all = std::all_of(results.begin(), results.end(),
                                   [](const auto& result) { return result.trouble.empty(); });
  return has_all ? exit_success : exit_mission_failed;
}

/// What a task of an array is started with, up to its part.
std::vector<std::string> task_command(const ReproduceRequest& request) {
  std::vector<std::string> words{program_file(), "reproduce"};
  for (const NamedExperiment& each : request.experiments) {
    words.push_back(each.name);
  }
  words.insert(words.end(),
               {"--seeds", std::to_string(request.seeds), "--out", request.batch.folder});
  if (request.batch.keeps_records) {
    words.emplace_back("--keep-records");
  }
  words.emplace_back("--part");
  return words;
}

/// One task of an array: the flight of a number, with its record in the task's own folder.
int fly_own_part(const ReproduceRequest& request, const std::string& part) {
  std::optional<std::variant<ExperimentFlights, std::vector<Error>>> planned;
  const auto plan =
      [&](std::size_t number,
          const std::string& folder) -> std::variant<StoredFlight, std::vector<Error>> {
    if (!planned) {
      ReproduceRequest own = request;
      own.batch.folder = folder;
      planned = plan_experiments(own);
    }
    if (const auto* errors = std::get_if<std::vector<Error>>(&*planned)) {
      return *errors;
    }
    const auto& flights = std::get<ExperimentFlights>(*planned).flights;
    if (number >= flights.size()) {
      return std::vector<Error>{
          {ErrorCode::invalid_input, "the array is of other experiments, or of more seeds"}};
    }
    return flights[number];
  };
  return fly_part(request.batch, part, plan);
}

int reproduce(const ReproduceOptions& options) {
  auto experiments = chosen(options.experiments);
  if (const auto* errors = std::get_if<std::vector<Error>>(&experiments)) {
    return refuse(*errors);
  }
  const ReproduceRequest request{
      std::move(std::get<std::vector<NamedExperiment>>(experiments)),
      options.seeds,
      {options.out, options.study.jobs, options.study.keeps_records, true}};
  if (!options.study.part.empty()) {
    return fly_own_part(request, options.study.part);
  }
  auto planned = plan_experiments(request);
  if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
    return refuse(*errors);
  }
  auto& flown = std::get<ExperimentFlights>(planned);
  const Study study{request.batch, "reproduce.db", task_command(request),
                    pointers_to(flown.flights)};
  const auto code = fly_study(study, options.study);
  return code ? *code : show(request, flown);
}

}  // namespace

void add_reproduce(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "reproduce", "puts our figures beside those of papers; continues where it was stopped");
  const auto options = std::make_shared<ReproduceOptions>();  // Owners: the parser's callbacks.
  command->add_option("EXPERIMENT", options->experiments,
                      "names from `flyball list experiments` (default: all)");
  command->add_option("--seeds", options->seeds, "flights of each point, with seeds 1 to N")
      ->capture_default_str()
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  add_study_options(*command, options->study);
  refuse_empty(*command
                    ->add_option("--out", options->out,
                                 "folder for the results (default: flights/reproduce)")
                    ->type_name("DIR"));
  command->callback([options, &exit_code] { exit_code = reproduce(*options); });
}

}  // namespace flyball
