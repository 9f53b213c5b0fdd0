// SPDX-License-Identifier: BSD-3-Clause
// tested-in: sweep

#include "studies/plots/csv.h"

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) {
    return text;
  }
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c == '"' ? "\"\"" : std::string{c};
  }
  return quoted + "\"";
}

}  // namespace

std::string csv_number(double value) {
  return nlohmann::ordered_json(value).dump();
}

std::string csv_row(const std::vector<std::string>& fields) {
  std::string row;
  for (const std::string& field : fields) {
    row += (&field == &fields.front() ? "" : ",") + csv_field(field);
  }
  return row + "\n";
}

}  // namespace flyball
