// SPDX-License-Identifier: BSD-3-Clause
// tested-in: run_folder

#include "records/trace_file.h"

#include "flyball/records/version.h"
#include "flyball/runtime/text/number_text.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

std::string json_text(std::string_view text) {
  return nlohmann::json(std::string{text})
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string number(double value) {
  if (!std::isfinite(value)) {
    return "null";
  }
  return short_number_text(value, 17);
}

std::string value_text(const FieldValue& value) {
  if (const double* real = std::get_if<double>(&value)) {
    return number(*real);
  }
  const auto* whole = std::get_if<std::int64_t>(&value);
  return whole != nullptr ? std::to_string(*whole) : json_text(std::get<std::string>(value));
}

}  // namespace

std::string trace_lines(const Scenario& scenario, const MemoryRecorder& trace) {
  std::string text = "{\"t_s\":0,\"channel\":\"mission\",\"version\":" + json_text(version()) +
                     ",\"policy\":" + json_text(scenario.governor.policy) +
                     ",\"seed\":" + std::to_string(scenario.seed) +
                     ",\"scenario\":" + json_text(to_toml(scenario)) + "}\n";
  for (const MemoryRecorder::Row& row : trace.rows()) {
    text += "{\"t_s\":" + number(to_seconds(row.at)) + ",\"channel\":" + json_text(row.channel);
    for (const Field& field : row.fields) {
      text += "," + json_text(field.name) + ":" + value_text(field.value);
    }
    text += "}\n";
  }
  return text;
}

}  // namespace flyball
