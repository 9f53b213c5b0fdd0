// SPDX-License-Identifier: BSD-3-Clause

#include "scenario/scenario_events.h"

#include "flyball/runtime/text/listed.h"
#include "flyball/runtime/text/number_text.h"
#include "flyball/scenario/shipped_platform.h"

#include "scenario/computer_strain.h"
#include "scenario/scenario_keys.h"
#include <algorithm>
#include <set>
#include <variant>

namespace flyball {
namespace {

constexpr const char* prefix = "events.";
constexpr int most_events = 100;

struct EventField {
  std::string name;
  std::string kind;  ///< Empty: every event has it.
  std::variant<double ComputerEvent::*, std::string ComputerEvent::*> place;
  double min{};
  double max{};
  bool is_required{};
  std::string description;
};

/// In the order in which they are written.
const std::vector<EventField>& event_fields() {
  using E = ComputerEvent;
  static const std::vector<EventField> all{
      {"kind", "", &E::kind, 0, 0, true, "slowdown, co_runner, cooling or bit_flip"},
      {"at_s", "", &E::at_s, 0, 86400, true, "mission time at which it begins"},
      {"until_s", "", &E::until_s, 0, 86400, false, "mission time at which it ends; 0: it lasts"},
      {"factor", "slowdown", &E::factor, 0.1, 100, true, "times the cost in the platform's file"},
      {"kernels", "slowdown", &E::kernels, 0, 0, false, "all, or names with commas between them"},
      {"cores", "co_runner", &E::cores, 0, 256, true, "kept busy by somebody else"},
      {"memory_share", "co_runner", &E::memory_share, 0, 0.95, false,
       "of the memory's bandwidth that it takes"},
      {"resistance_k_w", "cooling", &E::resistance_k_w, 0.1, 1000, true,
       "from the computer to the air"},
      {"ambient_c", "cooling", &E::ambient_c, -60, 90, true, "of the air"},
      {"topic", "bit_flip", &E::topic, 0, 0, true, "the topic whose next message is hit"},
      {"variable", "bit_flip", &E::variable, 0, 0, false, "the name of the number, or any"},
      {"draw", "bit_flip", &E::draw, 0, 1e9, false, "settles, with the seed, which bit flips"},
  };
  return all;
}

bool belongs(const EventField& field, const std::string& kind) {
  return field.kind.empty() || field.kind == kind;
}

std::string key_of(std::size_t event, const std::string& name) {
  return prefix + std::to_string(event + 1) + "." + name;
}

/// `7` of `events.7.at_s`; 0 for what is no number.
int number_of(const std::string& key) {
  const std::string rest = key.substr(std::string{prefix}.size());
  const std::string digits = rest.substr(0, rest.find('.'));
  const bool is_number = !digits.empty() && digits.size() < 7 && digits.front() != '0' &&
                         digits.find_first_not_of("0123456789") == std::string::npos &&
                         digits.size() < rest.size();
  return is_number ? std::stoi(digits) : 0;
}

/// How many events there are.
int count(const GivenValues& given, std::vector<Error>& errors) {
  std::set<int> numbers;
  for (const auto& [key, value] : given) {
    if (!is_event_key(key)) {
      continue;
    }
    const int number = number_of(key);
    if (number == 0) {
      errors.push_back({ErrorCode::invalid_input,
                        "\"" + key + "\" (" + value.origin +
                            ") belongs to no event; events are tables [[events]], and the first " +
                            "one's keys begin with events.1"});
    } else if (number > most_events) {
      errors.push_back({ErrorCode::invalid_input, "\"" + key + "\" (" + value.origin +
                                                      "): there may be " +
                                                      std::to_string(most_events) + " events"});
    } else {
      numbers.insert(number);
    }
  }
  if (!numbers.empty() && *numbers.rbegin() != static_cast<int>(numbers.size())) {
    errors.push_back({ErrorCode::invalid_input,
                      "events are numbered from 1 without a gap, and the last one of " +
                          std::to_string(numbers.size()) + " is events." +
                          std::to_string(*numbers.rbegin())});
    return 0;
  }
  return static_cast<int>(numbers.size());
}

void set(ComputerEvent& event,
         const EventField& field,
         const std::string& key,
         const GivenValue& value,
         std::vector<Error>& errors) {
  const auto refuse = [&](const std::string& rule) {
    errors.push_back({ErrorCode::invalid_input,
                      key + " = " + value.text + " (" + value.origin + ") must be " + rule});
  };
  const std::string unit = parts_of(field.name).unit;
  if (const auto* text = std::get_if<std::string ComputerEvent::*>(&field.place)) {
    const auto given = as_text(value);
    given ? (void)(event.** text = *given) : refuse("a text");
    return;
  }
  const auto number = as_number(value);
  if (!number) {
    refuse("a number" + (unit.empty() ? "" : " in " + unit));
  } else if (*number < field.min || *number > field.max) {
    const std::string tail = unit.empty() ? "" : " " + unit;
    refuse("at least " + number_text(field.min) + tail + " and at most " + number_text(field.max) +
           tail);
  } else {
    event.*std::get<double ComputerEvent::*>(field.place) = *number;
  }
}

std::string keys_of(const std::string& kind) {
  return listed(event_fields(), [&kind](const EventField& field) {
    return belongs(field, kind) ? std::string{field.name} : "";
  });
}

/// Keys of this event that its kind does not have.
void refuse_strangers(std::size_t index,
                      const std::string& kind,
                      const GivenValues& given,
                      std::vector<Error>& errors) {
  const std::string start = key_of(index, "");
  for (const auto& [key, value] : given) {
    const auto is_this = [&, &name = key](const EventField& field) {
      return belongs(field, kind) && start + field.name == name;
    };
    if (key.rfind(start, 0) == 0 &&
        std::none_of(event_fields().begin(), event_fields().end(), is_this)) {
      errors.push_back({ErrorCode::invalid_input, "no setting \"" + key + "\" (" + value.origin +
                                                      "); a " + kind + " has: " + keys_of(kind)});
    }
  }
}

ComputerEvent read_event(std::size_t index, const GivenValues& given, std::vector<Error>& errors) {
  ComputerEvent event;
  const std::string kind_key = key_of(index, "kind");
  const auto kind = given.find(kind_key);
  const std::string named = kind == given.end() ? "" : as_text(kind->second).value_or("");
  if (named != "slowdown" && named != "co_runner" && named != "cooling" && named != "bit_flip") {
    errors.push_back(
        {ErrorCode::invalid_input, kind_key + (named.empty() ? "" : " = \"" + named + "\"") +
                                       place_of(kind_key, given) +
                                       " must be one of: slowdown, co_runner, cooling, bit_flip"});
    return event;
  }
  for (const EventField& field : event_fields()) {
    const std::string key = key_of(index, field.name);
    const auto found = given.find(key);
    if (!belongs(field, named)) {
      continue;
    }
    if (found != given.end()) {
      set(event, field, key, found->second, errors);
    } else if (field.is_required) {
      errors.push_back({ErrorCode::invalid_input,
                        key + " is missing: a " + named + " needs it, " + field.description});
    }
  }
  if (event.until_s != 0.0 && event.until_s <= event.at_s) {
    errors.push_back({ErrorCode::invalid_input,
                      key_of(index, "until_s") + " = " + number_text(event.until_s) +
                          place_of(key_of(index, "until_s"), given) +
                          " must be after its at_s = " + number_text(event.at_s) + ", or 0"});
  }
  refuse_strangers(index, named, given, errors);
  return event;
}

}  // namespace

bool is_event_key(const std::string& key) {
  return key.rfind(prefix, 0) == 0;
}

std::vector<Error> read_events(Scenario& scenario, const GivenValues& given) {
  std::vector<Error> errors;
  const int events = count(given, errors);
  for (int i = 0; i < events; ++i) {
    scenario.events.push_back(read_event(static_cast<std::size_t>(i), given, errors));
  }
  if (!errors.empty() || scenario.events.empty()) {
    return errors;
  }
  const Result<PlatformModel> platform = find_platform(scenario.platform.name);
  // An unknown platform is named elsewhere.
  return platform ? impossible_events(scenario.events, *platform) : std::vector<Error>{};
}

std::vector<ConfigEntry> event_entries(const Scenario& scenario) {
  const ComputerEvent defaults;
  const auto text_of = [](const ComputerEvent& event, const EventField& field) {
    const auto* text = std::get_if<std::string ComputerEvent::*>(&field.place);
    return text != nullptr ? toml_text(event.**text)
                           : number_text(event.*std::get<double ComputerEvent::*>(field.place));
  };
  std::vector<ConfigEntry> entries;
  for (std::size_t i = 0; i < scenario.events.size(); ++i) {
    for (const EventField& field : event_fields()) {
      if (belongs(field, scenario.events[i].kind)) {
        entries.push_back({key_of(i, field.name), text_of(scenario.events[i], field),
                           text_of(defaults, field), "", field.description});
      }
    }
  }
  return entries;
}

std::string events_toml(const Scenario& scenario) {
  std::string text;
  for (const ConfigEntry& entry : event_entries(scenario)) {
    const std::string name = entry.key.substr(entry.key.rfind('.') + 1);
    text += (name == "kind" ? "\n[[events]]\n" : "") + name + " = " + entry.value + "\n";
  }
  return text;
}

}  // namespace flyball
