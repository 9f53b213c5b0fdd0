// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/report.h"
#include "flyball/studies/comparison.h"

#include "claimed_folder.h"
#include "commands.h"
#include "flight_batch.h"
#include "seed_list.h"
#include <algorithm>
#include <filesystem>
#include <memory>
#include <thread>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct CompareOptions {
  FlightOptions flight{};
  std::vector<std::string> policies{};
  std::string seeds{"1..1"};
  std::size_t jobs{std::max(1U, std::thread::hardware_concurrency())};
};

/// One mission of the comparison.
struct Entry : PlannedFlight {
  std::optional<RunPicture> picture{};  ///< Empty until it has flown.
};
using Entries = std::vector<Entry>;

/// Every mission, read and checked before the first one flies.
std::variant<Entries, std::vector<Error>> plan(const CompareOptions& options,
                                               const std::vector<std::uint64_t>& seeds) {
  Entries entries;
  std::vector<Error> all;
  for (std::size_t i = 0; i < options.policies.size() * seeds.size(); ++i) {
    auto planned = plan_flight(options.flight, options.policies[i / seeds.size()],
                               seeds[i % seeds.size()], "");
    if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
      add_new(*errors, all);
    } else {
      entries.push_back({std::move(std::get<PlannedFlight>(planned)), std::nullopt});
    }
  }
  if (!all.empty()) {
    return all;
  }
  return entries;
}

void reuse_finished(Entries& entries, const std::string& folder) {
  std::size_t reused = 0;
  for (Entry& entry : entries) {
    entry.picture = finished_run(entry.folder, entry.scenario);
    reused += entry.picture ? 1 : 0;
  }
  if (reused > 0) {
    note(std::to_string(reused) + " of " + std::to_string(entries.size()) +
         " flights are taken from " + folder + ", where the same program flew them before");
  }
}

void show_progress(const Entry& entry, std::size_t done, std::size_t all) {
  const Summary& s = entry.picture->summary;
  const bool failed = s.failure != MissionFailure::none;
  note("[" + std::to_string(done) + "/" + std::to_string(all) + "] " + name_of(entry) + ": " +
       (failed ? to_string(s.failure) : to_string(s.status)) + " after " +
       std::to_string(static_cast<long>(s.mission_time_s)) + " s");
}

Flown fly_missing(Entries& entries, std::size_t jobs) {
  std::vector<Entry*> missing;
  std::vector<const PlannedFlight*> flights;
  for (Entry& entry : entries) {
    if (!entry.picture) {
      missing.push_back(&entry);
      flights.push_back(&entry);
    }
  }
  std::size_t done = entries.size() - missing.size();
  return fly_all(flights, jobs, [&](std::size_t index) {
    Entry& entry = *missing[index];
    entry.picture = finished_run(entry.folder, entry.scenario);
    if (entry.picture && has_watcher()) {
      show_progress(entry, ++done, entries.size());
    }
    return entry.picture.has_value();
  });
}

/// The folders in which nothing was written: each process removes its own, but not those it shares.
void remove_traces(const Entries& entries) {
  for (const Entry& entry : entries) {
    const std::filesystem::path of_policy = std::filesystem::path{entry.folder}.parent_path();
    remove_empty({of_policy.parent_path().string(), of_policy.string()});
  }
}

Status write_report(const std::string& path, const Comparison& comparison, const Entries& entries) {
  std::vector<RunPicture> pictures;
  for (const Entry& entry : entries) {
    pictures.push_back(*entry.picture);
  }
  return write_file(path,
                    report_page(comparison.scenario, pictures,
                                to_html(comparison) + scenario_html(entries.front().scenario)));
}

int show(const CompareOptions& options, const std::string& folder, const Entries& entries) {
  std::vector<Summary> flights;
  for (const Entry& entry : entries) {
    flights.push_back(entry.picture->summary);
  }
  const Comparison comparison = compare_flights(flights);
  const std::string report = folder + "/report.html";
  if (const Status written = write_report(report, comparison, entries); !written) {
    return refuse({written.error()});
  }
  if (options.flight.json) {
    print(to_json(comparison) + "\n");
    note("report: " + report);
  } else {
    print(to_text(comparison) + "report: " + report + "\n");
  }
  return exit_success;
}

int compare(const CompareOptions& options) {
  const Result<std::vector<std::uint64_t>> seeds = read_seeds(options.seeds);
  if (const auto errors = check_contest(options.flight, options.policies, seeds); !errors.empty()) {
    return refuse(errors);
  }
  auto planned = plan(options, *seeds);
  if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
    return refuse(*errors);
  }
  Entries& entries = std::get<Entries>(planned);
  remark_on_policies(entries);
  const std::string folder = comparison_folder(options.flight, entries.front().scenario);
  const auto claimed = ClaimedFolder::claim(folder);
  if (!claimed) {
    return refuse({claimed.error()});
  }
  reuse_finished(entries, folder);
  const Flown flown = fly_missing(entries, options.jobs);
  if (const std::optional<int> code = unfinished(flown)) {
    if (flown.signal == 0) {
      remove_traces(entries);
      remove_empty(claimed->made());
    }
    return *code;
  }
  return show(options, folder, entries);
}

}  // namespace

void add_compare(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("compare", "flies policies over the same seeds and compares them");
  const auto options = std::make_shared<CompareOptions>();  // Owners: the parser's callbacks.
  add_scenario(*command, options->flight);
  add_contest(*command, options->policies, options->seeds);
  add_jobs(*command, options->jobs);
  add_output(*command, options->flight);
  command->callback([options, &exit_code] { exit_code = compare(*options); });
}

}  // namespace flyball
