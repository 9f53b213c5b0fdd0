// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/studies/drift.h"

#include "flyball/runtime/text/number_text.h"
#include "flyball/scenario/shipped_platform.h"

#include "records/json_counts.h"
#include <fstream>
#include <utility>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

std::vector<std::string> event(std::size_t number,
                               double at_s,
                               const std::string& kind,
                               const std::vector<std::string>& rest) {
  const std::string key = "events." + std::to_string(number) + ".";
  std::vector<std::string> settings{key + "kind=" + kind, key + "at_s=" + number_text(at_s)};
  for (const std::string& setting : rest) {
    settings.push_back(key + setting);
  }
  return settings;
}

DriftCase heat_case(std::vector<std::string> settings, const Scenario& flown) {
  DriftCase heat{"heat", "the heat sink gets bad (20 K/W, air of 45 degrees Celsius)", {}, {}};
  const std::string& name = flown.platform.name;
  const Result<PlatformModel> platform = find_platform(name);
  if (platform && !platform->thermal) {
    settings.emplace_back("platform.name=jetson_tx2_passive");
    heat.caveat =
        "event heat flies on jetson_tx2_passive, because nothing is known of the heat of " + name +
        ": it has no [thermal] table";
  }
  if (flown.platform.start_temperature_c == 0.0) {  // A flight ends before a cold one gets hot.
    settings.emplace_back("platform.start_temperature_c=78");
  }
  heat.settings = std::move(settings);
  return heat;
}

void take_row(const nlohmann::json& row, DriftRecord& record) {
  const auto& channel = row.at("channel").get_ref<const std::string&>();
  if (channel == "latency_bound") {
    record.push_back(
        {MissionTime{seconds_in(row, "t_s")}, count_in(row, "issued"), count_in(row, "late")});
  }
}

}  // namespace

std::vector<DriftCase> drift_cases(double at_s, const Scenario& flown) {
  const std::size_t number = flown.events.size() + 1;  // Behind the scenario's own ones.
  return {
      {"none", "nothing happens", {}},
      {"slowdown", "all kernels cost 3 times what the platform's file says",
       event(number, at_s, "slowdown", {"factor=3"})},
      {"co_runner", "somebody takes 3 of 4 cores and half of the memory's bandwidth",
       event(number, at_s, "co_runner", {"cores=3", "memory_share=0.5"})},
      heat_case(event(number, at_s, "cooling", {"resistance_k_w=20", "ambient_c=45"}), flown),
  };
}

DriftRecord drift_record(const MemoryRecorder& trace) {
  DriftRecord record;
  for (const MemoryRecorder::Row& row : trace.rows()) {
    const auto count = [&row](std::size_t field) {
      return static_cast<std::uint64_t>(std::get<std::int64_t>(row.fields[field].value));
    };
    if (row.channel == "latency_bound") {
      record.push_back({row.at, count(0), count(1)});
    }
  }
  return record;
}

Result<DriftRecord> read_drift_record(const std::string& run_folder) {
  const std::string path = run_folder + "/trace.jsonl";
  std::ifstream file{path};
  if (!file) {
    return Error{ErrorCode::not_found, "no record \"" + path + "\""};
  }
  DriftRecord record;
  try {
    for (std::string line; std::getline(file, line);) {
      take_row(nlohmann::json::parse(line), record);
    }
  } catch (const std::exception& broken) {
    return Error{ErrorCode::invalid_input, "record \"" + path + "\": " + broken.what()};
  }
  return record;
}

DriftCount count_bounds(const DriftRecord& record,
                        MissionTime event,
                        std::uint64_t first,
                        std::uint64_t last) {
  // Bounds that were issued before the event and were still open then count as well.
  BoundRow before;
  DriftCount count;
  BoundRow previous;
  for (const BoundRow& row : record) {
    if (row.at < event) {
      before = row;
    } else if (row.issued >= before.issued + first && row.issued <= before.issued + last) {
      count.decisions += row.issued - previous.issued;
      count.late += row.late - previous.late;
    }
    previous = row;
  }
  return count;
}

}  // namespace flyball
