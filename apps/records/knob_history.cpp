// SPDX-License-Identifier: BSD-3-Clause
#include "records/knob_history.h"

#include "flyball/flight/governing/choice_text.h"

#include "records/report_world.h"
#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

namespace flyball {
namespace {

using Json = nlohmann::ordered_json;

struct Step {
  double at_s{};
  double value{};
};
using Steps = std::vector<Step>;

// The plot has about a thousand pixels across; so many steps weigh no more than the other series.
constexpr std::size_t most_steps = 4'000;
constexpr std::size_t intervals = 2'000;

template <typename Value>
const Value* field_in(const MemoryRecorder::Row& row, std::string_view name) {
  for (const Field& field : row.fields) {
    if (field.name == name) {
      return std::get_if<Value>(&field.value);
    }
  }
  return nullptr;
}

/// What is set twice at one moment counts as set once: at take-off, a policy replaces the default.
void add(Steps& steps, const Step& next) {
  if (!steps.empty() && steps.back().at_s == next.at_s) {
    steps.pop_back();
  }
  if (steps.empty() || steps.back().value != next.value) {
    steps.push_back(next);
  }
}

Steps steps_of(const KnobSpec& spec, double at_start, const MemoryRecorder& trace) {
  Steps steps{{0.0, at_start}};
  for (const MemoryRecorder::Row& row : trace.rows()) {
    if (row.channel != "decision") {
      continue;
    }
    const auto* knob = field_in<std::string>(row, "knob");
    const auto* value = field_in<double>(row, "value");
    if (knob != nullptr && value != nullptr && *knob == spec.name) {
      add(steps, {to_seconds(row.at), *value});
    }
  }
  return steps;
}

/// The first, lowest, highest and last of these steps, each of them once, in order of time.
void add_outline(Steps::const_iterator begin, Steps::const_iterator end, Steps& thin) {
  const auto by_value = [](const Step& a, const Step& b) { return a.value < b.value; };
  std::vector<Steps::const_iterator> kept{begin, std::min_element(begin, end, by_value),
                                          std::max_element(begin, end, by_value), end - 1};
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  for (const auto& step : kept) {
    thin.push_back(*step);
  }
}

Steps thinned(const Steps& steps) {
  if (steps.size() <= most_steps) {
    return steps;
  }
  const double interval_s = steps.back().at_s / intervals;
  Steps thin;
  for (auto begin = steps.begin(); begin != steps.end();) {
    const double end_s = begin->at_s + interval_s;
    const auto end = std::find_if(begin + 1, steps.end(),
                                  [end_s](const Step& step) { return step.at_s >= end_s; });
    add_outline(begin, end, thin);
    begin = end;
  }
  return thin;
}

/// Six significant digits: some knobs are shares, and some count cycles.
double short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::strtod(text, nullptr);
}

Json short_numbers(const std::vector<double>& values) {
  Json numbers = Json::array();
  for (const double value : values) {
    numbers.push_back(short_number(value));
  }
  return numbers;
}

Json knob_json(const KnobSpec& spec, const Steps& steps) {
  Json json{{"name", spec.name},
            {"unit", spec.unit},
            {"description", spec.description},
            {"min", short_number(spec.min)},
            {"max", short_number(spec.max)},
            {"changes", steps.size() - 1},
            {"t", Json::array()},
            {"v", Json::array()}};
  if (!spec.legal.empty()) {
    json["legal"] = short_numbers(spec.legal);
  }
  if (!spec.labels.empty()) {
    json["labels"] = spec.labels;
  }
  for (const Step& step : thinned(steps)) {
    json["t"].push_back(json_number(step.at_s));
    json["v"].push_back(short_number(step.value));
  }
  return json;
}

}  // namespace

Json knobs_json(const MissionRecord& record) {
  Json knobs = Json::array();
  for (const KnobSpec& spec : record.knobs.specs()) {
    knobs.push_back(knob_json(spec, steps_of(spec, record.knobs.value(spec.name), *record.trace)));
  }
  return knobs;
}

Json fallback_json(const MemoryRecorder& trace) {
  Json steps = Json::array();
  for (const MemoryRecorder::Row& row : trace.rows()) {
    const auto* what = row.channel == "event" ? field_in<std::string>(row, "what") : nullptr;
    if (const auto step = what == nullptr ? std::nullopt : fallback_in(*what)) {
      steps.push_back({json_number(to_seconds(row.at)), step->name, step->why});
    }
  }
  return steps;
}

}  // namespace flyball
