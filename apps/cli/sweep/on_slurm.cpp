// SPDX-License-Identifier: BSD-3-Clause

#include "cli/sweep/on_slurm.h"

#include "flyball/records/report.h"

#include "cli/claimed_folder.h"
#include "cli/sweep/slurm.h"
#include "studies/sweep/task_sizes.h"
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

namespace flyball {
namespace {

namespace fs = std::filesystem;

/// Where tasks and the waiting command meet.
struct Meeting {
  explicit Meeting(const std::string& shared) : folder{shared + "/slurm"} {}
  std::string folder;
  /// A line for each task: the numbers of its flights.
  [[nodiscard]] std::string missing() const { return folder + "/missing.txt"; }
  /// Holds the number of the array that was started last, until it has been awaited.
  [[nodiscard]] std::string array() const { return folder + "/array.txt"; }
  [[nodiscard]] std::string part(std::size_t number) const {
    return folder + "/part_" + std::to_string(number);
  }
};

constexpr const char* part_store = "/flights.db";

/// Numbers, a line each; empty when there is no such file.
std::vector<std::size_t> read_numbers(const std::string& path) {
  std::ifstream file{path};
  std::vector<std::size_t> numbers;
  for (std::size_t number = 0; file >> number;) {
    numbers.push_back(number);
  }
  return numbers;
}

/// The numbers in one line of that file, counted from 1; empty where there is none.
std::vector<std::size_t> read_share(const std::string& path, std::size_t task) {
  std::ifstream file{path};
  std::string line;
  for (std::size_t i = 0; i < task && std::getline(file, line); ++i) {
  }
  std::istringstream words{file ? line : ""};
  std::vector<std::size_t> numbers;
  for (std::size_t number = 0; words >> number;) {
    numbers.push_back(number);
  }
  return numbers;
}

std::string lines_of(const std::vector<std::size_t>& missing,
                     const std::vector<std::size_t>& sizes) {
  std::string lines;
  std::size_t next = 0;
  for (const std::size_t size : sizes) {
    for (std::size_t i = 0; i < size; ++i) {
      lines += (i == 0 ? "" : " ") + std::to_string(missing[next++]);
    }
    lines += "\n";
  }
  return lines;
}

/// False when a signal came meanwhile.
bool sleep_a_moment() {
  constexpr int slices = 20;
  for (int i = 0; i < slices && !was_interrupted(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds{100});
  }
  return !was_interrupted();
}

/// Until the array has ended. @return The code to end with, where that cannot be awaited.
std::optional<int> await(const std::string& array, std::size_t tasks) {
  std::size_t shown = 0;
  int failures = 0;
  constexpr int most_failures = 30;  // A minute without an answer: not just a busy controller.
  do {
    const Result<std::size_t> left = tasks_left(array);
    if (was_interrupted()) {
      break;
    }
    if (!left && ++failures > most_failures) {
      return refuse({left.error()});
    }
    if (!left) {
      continue;
    }
    failures = 0;
    if (*left == 0) {
      return std::nullopt;
    }
    const std::size_t ended = tasks > *left ? tasks - *left : 0;
    if (has_watcher() && ended > shown) {
      note("array " + array + ": " + std::to_string(ended) + " of " + std::to_string(tasks) +
           " tasks have ended");
      shown = ended;
    }
  } while (sleep_a_moment());
  note("interrupted; array " + array +
       " goes on, and the same command waits for it again; scancel " + array + " ends it");
  return interrupted_exit_code();
}

/// Adds what the tasks have flown to the sweep's store.
Status collect(const Meeting& meeting, FlightStore& store) {
  std::error_code ignored;
  std::vector<fs::path> parts;
  for (const fs::directory_entry& entry : fs::directory_iterator{meeting.folder, ignored}) {
    if (fs::exists(entry.path().string() + part_store, ignored)) {
      parts.push_back(entry.path());
    }
  }
  std::sort(parts.begin(), parts.end());
  for (const fs::path& part : parts) {
    if (Status added = store.add_all_of(part.string() + part_store); !added) {
      return added;
    }
    fs::remove_all(part, ignored);  // A part that stays would only be added twice.
  }
  fs::remove(meeting.array(), ignored);
  return Done{};
}

/// The array that was started last, if there is one. @return As `await`.
std::optional<int> await_and_collect(const Meeting& meeting, FlightStore& store) {
  if (const auto array = read_numbers(meeting.array()); array.size() == 2) {
    if (const auto code = await(std::to_string(array[0]), array[1])) {
      return code;
    }
  }
  if (const Status collected = collect(meeting, store); !collected) {
    return refuse({collected.error()});
  }
  return std::nullopt;
}

/// Starts an array for these flights. @return Its number.
Result<std::string> start_array(const FlightArray& flights,
                                const Meeting& meeting,
                                const std::vector<std::size_t>& missing) {
  constexpr std::size_t most_tasks = 1000;  // Slurm's MaxArraySize unless set otherwise.
  const std::vector<std::size_t> sizes = task_sizes(missing.size(), flights.processors, most_tasks);
  const std::size_t tasks = sizes.size();
  if (const Status written = write_file(meeting.missing(), lines_of(missing, sizes)); !written) {
    return written.error();
  }
  Result<std::string> array = submit({"flyball", flights.command, tasks, meeting.folder});
  if (array) {
    const Status written =
        write_file(meeting.array(), *array + "\n" + std::to_string(tasks) + "\n");
    if (!written) {
      return written.error();
    }
    note("Slurm has " + std::to_string(missing.size()) + " flights as array " + *array + " of " +
         std::to_string(tasks) + " tasks");
  }
  return array;
}

std::vector<std::size_t> numbers_missing(const FlightStore& store,
                                         const std::vector<StoredFlight*>& flights,
                                         bool with_records) {
  (void)missing_of(store, flights, with_records);
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < flights.size(); ++i) {
    if (!flights[i]->summary) {
      numbers.push_back(i);
    }
  }
  return numbers;
}

Error still_missing(const Meeting& meeting, std::size_t count) {
  return {ErrorCode::failed, std::to_string(count) +
                                 " flights are missing, and the last array brought none; " +
                                 meeting.folder + "/task_*.log says why"};
}

}  // namespace

std::optional<int> fly_on_slurm(const FlightArray& array,
                                FlightStore& store,
                                const std::vector<StoredFlight*>& flights) {
  const Meeting meeting{array.folder};
  if (const auto prepared = prepare_folder(meeting.folder); !prepared) {
    return refuse({prepared.error()});
  }
  catch_interrupt();
  std::size_t missing_before = flights.size() + 1;
  while (true) {
    if (const auto code = await_and_collect(meeting, store)) {
      return code;
    }
    const std::vector<std::size_t> missing = numbers_missing(store, flights, array.keeps_records);
    if (missing.empty()) {
      return std::nullopt;
    }
    if (missing.size() == missing_before) {
      (void)refuse({still_missing(meeting, missing.size())});
      return exit_mission_failed;
    }
    missing_before = missing.size();
    if (const auto started = start_array(array, meeting, missing); !started) {
      return refuse({started.error()});
    }
  }
}

int fly_part(const StoredBatch& batch, const std::string& part, const PlanFlight& plan) {
  unsigned long task = 0;
  unsigned long tasks = 0;
  int end = 0;
  const bool is_read =
      std::sscanf(part.c_str(), "%6lu/%6lu%n", &task, &tasks, &end) == 2 &&  // NOLINT(cert-err34-c)
      static_cast<std::size_t>(end) == part.size() && task >= 1 && task <= tasks;
  if (!is_read) {
    return refuse(
        {{ErrorCode::invalid_input, "--part " + part + " is no part; give for example 2/8"}});
  }
  const Meeting meeting{batch.folder};
  StoredBatch own = batch;
  own.jobs = 1;
  // Tasks that removed each other's empty folders would get in each other's way.
  own.folder = batch.keeps_records ? batch.folder : meeting.part(task);
  std::vector<StoredFlight> flights;
  for (const std::size_t number : read_share(meeting.missing(), task)) {
    auto planned = plan(number, own.folder);
    if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
      return refuse(*errors);
    }
    flights.push_back(std::move(std::get<StoredFlight>(planned)));
  }
  const auto claimed = ClaimedFolder::claim(meeting.part(task));  // Slurm may run a task twice.
  if (!claimed) {
    return refuse({claimed.error()});
  }
  auto store = FlightStore::open(meeting.part(task) + part_store);
  if (!store) {
    return refuse({store.error()});
  }
  return unfinished(fly_stored(own, *store, pointers_to(flights))).value_or(exit_success);
}

}  // namespace flyball
