// SPDX-License-Identifier: BSD-3-Clause
#include "scenario/computer_strain.h"

#include "flyball/runtime/text/number_text.h"

#include "scenario/scenario_fields.h"
#include <algorithm>
#include <set>

namespace flyball {
namespace {

Error impossible(std::size_t event, const std::string& why) {
  return {ErrorCode::invalid_input, "events." + std::to_string(event + 1) + why};
}

/// The most that co-runners take at one time: it can only grow when one of them begins.
double most_taken(const std::vector<ComputerEvent>& events) {
  double most = 0.0;
  for (const ComputerEvent& event : events) {
    most = std::max(most, strain_at(events, begin_of(event)).taken_cores);
  }
  return most;
}

/// The names between the commas, also empty ones.
std::vector<std::string> names_in(const std::string& list) {
  std::vector<std::string> names(1);
  for (const char c : list) {
    if (c == ',') {
      names.emplace_back();
    } else if (c != ' ' && c != '\t') {
      names.back() += c;
    }
  }
  return names;
}

/// @param place  Of the slowdown in the list of events.
void check_prices(const ComputerEvent& slowdown,
                  std::size_t place,
                  const PlatformModel& platform,
                  std::vector<Error>& errors) {
  std::set<std::string> known;
  for (const std::string& name : kernels_of(slowdown)) {
    if (name.empty() || !known.insert(name).second) {  // The factor would count twice.
      errors.push_back(
          impossible(place, ".kernels = \"" + slowdown.kernels + "\" has " +
                                (name.empty() ? "an empty name" : "\"" + name + "\" twice") +
                                "; name each kernel once, with commas between, or give all"));
      return;
    }
    if (platform.kernels.find(name) == platform.kernels.end()) {
      errors.push_back(impossible(place, ".kernels: " + platform.name +
                                             " has no price for a kernel \"" + name +
                                             "\" that could grow; try: flyball list kernels"));
    }
  }
}

}  // namespace

std::vector<std::string> kernels_of(const ComputerEvent& event) {
  std::vector<std::string> names = names_in(event.kernels);
  return names == std::vector<std::string>{"all"} ? std::vector<std::string>{} : names;
}

MissionTime begin_of(const ComputerEvent& event) {
  return MissionTime{from_seconds(event.at_s)};
}

std::optional<MissionTime> end_of(const ComputerEvent& event) {
  return event.until_s == 0.0 ? std::nullopt
                              : std::optional{MissionTime{from_seconds(event.until_s)}};
}

bool is_active(const ComputerEvent& event, MissionTime now) {
  const std::optional<MissionTime> end = end_of(event);
  return now >= begin_of(event) && (!end || now < *end);
}

Strain strain_at(const std::vector<ComputerEvent>& events, MissionTime now) {
  Strain strain;
  for (const ComputerEvent& event : events) {
    if (!is_active(event, now)) {
      continue;
    }
    if (event.kind == "slowdown") {
      const std::vector<std::string> names = kernels_of(event);
      strain.cost *= names.empty() ? event.factor : 1.0;
      for (const std::string& name : names) {
        strain.kernel_cost.try_emplace(name, 1.0).first->second *= event.factor;
      }
    } else if (event.kind == "co_runner") {
      strain.taken_cores += event.cores;
      strain.memory_cost /= 1.0 - event.memory_share;
    }
  }
  return strain;
}

std::vector<Error> impossible_events(const std::vector<ComputerEvent>& events,
                                     const PlatformModel& platform) {
  std::vector<Error> errors;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i].kind == "slowdown") {
      check_prices(events[i], i, platform, errors);
    } else if (events[i].kind == "cooling" && !platform.thermal) {
      errors.push_back(impossible(i, ": " + platform.name +
                                         " has no [thermal] table, so that nothing is known of " +
                                         "its heat; try: --set platform.name=jetson_tx2_passive"));
    }
  }
  const double left = platform.max_cores - most_taken(events);
  if (left < 1.0) {
    errors.push_back({ErrorCode::invalid_input,
                      "events: co-runners take " + number_text(most_taken(events)) + " of the " +
                          std::to_string(platform.max_cores) + " cores of " + platform.name +
                          " at one time; leave one to the mission"});
  }
  return errors;
}

std::string describe(const ComputerEvent& event, bool begins) {
  if (!begins) {
    return event.kind + " ends";
  }
  if (event.kind == "slowdown") {
    return "slowdown: " + number_text(event.factor) + " times the costs of " +
           (kernels_of(event).empty() ? "all kernels" : event.kernels);
  }
  if (event.kind == "co_runner") {
    return "co_runner: takes " + number_text(event.cores) + " cores and a share of " +
           number_text(event.memory_share) + " of the memory's bandwidth";
  }
  return "cooling: " + number_text(event.resistance_k_w) + " K/W to air of " +
         number_text(event.ambient_c) + " degrees Celsius";
}

}  // namespace flyball
