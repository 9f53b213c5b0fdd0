// SPDX-License-Identifier: BSD-3-Clause

#include "stored_flights.h"

#include "flyball/records/report.h"

#include <chrono>
#include <filesystem>

namespace flyball {
namespace {

using Clock = std::chrono::steady_clock;

/// Removes the folders around records that are gone. Not while others fly, which make their folders
/// one inside the other. A folder that stays is no harm.
void remove_empty_folders(const StoredBatch& batch, const std::vector<StoredFlight*>& flights) {
  std::error_code ignored;
  const std::filesystem::path top{batch.folder};
  for (const StoredFlight* flight : flights) {
    for (std::filesystem::path folder = std::filesystem::path{flight->folder}.parent_path();
         folder != top && folder.has_relative_path(); folder = folder.parent_path()) {
      if (!std::filesystem::remove(folder, ignored)) {
        break;
      }
    }
  }
}

void show(const StoredFlight& flight, std::size_t done, std::size_t all, const std::string& left) {
  const Summary& s = *flight.summary;
  const bool failed = s.failure != MissionFailure::none;
  note("[" + std::to_string(done) + "/" + std::to_string(all) + "] " + s.scenario + " " +
       (flight.settings.empty() ? "" : flight.settings + " ") + name_of(flight) + ": " +
       (failed ? to_string(s.failure) : to_string(s.status)) + " after " +
       std::to_string(static_cast<long>(s.mission_time_s)) + " s, " +
       std::to_string(static_cast<long>(s.energy_total_j() * 1e-3)) + " kJ" +
       (left.empty() ? "" : "; " + left));
}

}  // namespace

std::string time_left(double elapsed_s, std::size_t done, std::size_t all) {
  if (done == 0 || done >= all) {
    return {};
  }
  const double left_s = elapsed_s * static_cast<double>(all - done) / static_cast<double>(done);
  const long minutes = static_cast<long>(left_s / 60.0);
  const long seconds = static_cast<long>(left_s) % 60;
  return (minutes > 0 ? std::to_string(minutes) + " min " : "") + std::to_string(seconds) +
         " s left";
}

std::vector<StoredFlight*> missing_of(const FlightStore& store,
                                      const std::vector<StoredFlight*>& flights,
                                      bool with_records) {
  std::vector<StoredFlight*> missing;
  for (StoredFlight* flight : flights) {
    const bool may_be_known = !with_records || finished_run(flight->folder, flight->scenario);
    if (!flight->summary && may_be_known) {
      flight->summary = store.find(flight->scenario, flight->settings);
    }
    if (!flight->summary) {
      missing.push_back(flight);
    }
  }
  return missing;
}

Flown fly_stored(const StoredBatch& batch,
                 FlightStore& store,
                 const std::vector<StoredFlight*>& flights) {
  const std::vector<StoredFlight*> missing = missing_of(store, flights, batch.keeps_records);
  const std::size_t known = flights.size() - missing.size();
  if (known > 0 && batch.shows_progress) {
    note(std::to_string(known) + " of " + std::to_string(flights.size()) +
         " flights are known from before");
  }
  const Clock::time_point start = Clock::now();
  std::size_t done = 0;
  std::vector<Error> unwritten;
  const std::vector<const PlannedFlight*> planned(missing.begin(), missing.end());
  Flown flown = fly_all(planned, batch.jobs, [&](std::size_t index) {
    StoredFlight& flight = *missing[index];
    const auto run = finished_run(flight.folder, flight.scenario);
    if (!run) {
      return false;
    }
    flight.summary = run->summary;
    if (const Status added = store.add(flight.scenario, *flight.summary, flight.settings); !added) {
      unwritten.push_back(added.error());
    } else if (!batch.keeps_records) {
      std::error_code ignored;  // A record that stays is no harm.
      std::filesystem::remove_all(flight.folder, ignored);
    }
    if (++done; batch.shows_progress && has_watcher()) {
      const std::chrono::duration<double> elapsed = Clock::now() - start;
      show(flight, known + done, flights.size(), time_left(elapsed.count(), done, missing.size()));
    }
    return true;
  });
  remove_empty_folders(batch, flights);
  if (!unwritten.empty()) {
    flown.errors.push_back(unwritten.front());
    flown.exit_code = exit_bad_input;
  }
  return flown;
}

}  // namespace flyball
