// SPDX-License-Identifier: BSD-3-Clause
// tested-in: cli_sweep

#include "cli/sweep/stored_study.h"

#include "flyball/records/report.h"

#include "cli/claimed_folder.h"
#include "cli/commands.h"
#include "cli/sweep/on_slurm.h"
#include "cli/sweep/slurm.h"
#include <algorithm>
#include <thread>

#include <CLI/CLI.hpp>

namespace flyball {

void add_study_options(CLI::App& command, StudyOptions& options) {
  options.jobs = std::max(1U, std::thread::hardware_concurrency());
  add_jobs(command, options.jobs);
  CLI::Option* const on =
      command
          .add_option("--on", options.on,
                      "where to fly: `slurm` hands the flights to a cluster as one job array, "
                      "which shares the folder --out")
          ->check(CLI::IsMember({"slurm"}))
          ->type_name("slurm");
  on->excludes(command.get_option("--jobs"));
  command.add_flag("--keep-records", options.keeps_records,
                   "keeps the whole record of each flight, not only its summary");
  command.add_option("--part", options.part)->group("")->excludes(on);
}

std::optional<int> fly_study(const Study& study, const StudyOptions& options) {
  std::size_t processors = 0;
  if (!options.on.empty()) {
    const auto of_slurm = slurm_processors();
    if (!of_slurm) {
      return refuse({of_slurm.error()});
    }
    processors = *of_slurm;
  }
  const std::string& folder = study.batch.folder;
  const auto claimed = ClaimedFolder::claim(folder);
  if (!claimed) {
    return refuse({claimed.error()});
  }
  auto store = FlightStore::open(folder + "/" + study.store);
  if (!store) {
    remove_empty(claimed->made());
    return refuse({store.error()});
  }
  if (processors > 0) {
    return fly_on_slurm({folder, study.slurm_task, processors, study.batch.keeps_records}, *store,
                        study.flights);
  }
  return unfinished(fly_stored(study.batch, *store, study.flights));
}

}  // namespace flyball
