// SPDX-License-Identifier: BSD-3-Clause
// tested-in: scenario

#include "scenario/scenario_reader.h"

#include "flyball/runtime/text/number_text.h"
#include "flyball/runtime/text/toml_text.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include <toml++/toml.h>

namespace flyball {
namespace {

std::string as_written(const toml::node& node) {
  std::ostringstream text;
  if (const auto* number = node.as_floating_point()) {
    return number_text(number->get());
  }
  if (const auto* words = node.as_string()) {
    return toml_text(words->get());
  }
  node.visit([&text](const auto& typed) { text << typed; });
  return text.str();
}

/// Empty for what no setting can be: a list, a date.
std::optional<GivenValue> scalar(const toml::node& node, const std::string& origin) {
  GivenValue given{0.0, origin, as_written(node)};
  if (const auto* whole = node.as_integer()) {
    given.value = whole->get();
  } else if (const auto* number = node.as_floating_point()) {
    given.value = number->get();
  } else if (const auto* flag = node.as_boolean()) {
    given.value = flag->get();
  } else if (const auto* text = node.as_string()) {
    given.value = text->get();
  } else {
    return std::nullopt;
  }
  return given;
}

/// `[[events]]`: a list that holds tables only.
const toml::array* tables_of(const toml::node& node) {
  const toml::array* list = node.as_array();
  return list != nullptr && list->is_array_of_tables() ? list : nullptr;
}

void flatten(const toml::table& table,
             const std::string& prefix,
             const std::string& file,
             ScenarioText& read);

/// The first one is `events.1`.
void flatten(const toml::array& tables,
             const std::string& prefix,
             const std::string& file,
             ScenarioText& read) {
  for (std::size_t i = 0; i < tables.size(); ++i) {
    flatten(*tables.get(i)->as_table(), prefix + std::to_string(i + 1) + ".", file, read);
  }
}

void flatten(const toml::table& table,
             const std::string& prefix,
             const std::string& file,
             ScenarioText& read) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string{name.str()};
    const std::string origin = file + ":" + std::to_string(node.source().begin.line);
    if (const toml::table* section = node.as_table()) {
      flatten(*section, std::string{key}.append("."), file, read);
    } else if (const toml::array* tables = tables_of(node)) {
      flatten(*tables, std::string{key}.append("."), file, read);
    } else if (std::optional<GivenValue> given = scalar(node, origin)) {
      read.values[key] = std::move(*given);
    } else {
      std::string sentence = key;
      sentence.append(" (").append(origin).append(") must be one number, text, true or false");
      read.errors.push_back({ErrorCode::invalid_input, std::move(sentence)});
    }
  }
}

/// One value on the right of `=`; the parser reads it as the only line of a file.
std::optional<GivenValue> toml_scalar(const std::string& text) {
  const std::string line = "value = " + text;
  if (fault_of_toml(line)) {
    return std::nullopt;
  }
  try {
    const toml::table table = toml::parse(line);
    const toml::node* node = table.get("value");
    return table.size() == 1 && node != nullptr ? scalar(*node, "--set") : std::nullopt;
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

}  // namespace

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  const std::size_t last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::string key_of(const std::string& key_and_value) {
  return trimmed(key_and_value.substr(0, key_and_value.find('=')));
}

std::string place_of(const std::string& key, const GivenValues& given) {
  const auto found = given.find(key);
  return found == given.end() ? "" : " (" + found->second.origin + ")";
}

ScenarioText read_scenario_file(const std::string& path) {
  const std::string file = std::filesystem::path{path}.filename().string();
  ScenarioText read;
  const auto complain = [&read, &file](std::uint64_t line, std::string_view what) {
    read.errors.push_back(
        {ErrorCode::invalid_input,
         file + ":" + std::to_string(line) + ": this is not TOML: " + std::string{what}});
  };
  std::ifstream in{path};
  if (!in) {  // An empty text would be a scenario of defaults.
    read.errors.push_back({ErrorCode::unavailable, "cannot read \"" + path + "\""});
    return read;
  }
  const std::string content{std::istreambuf_iterator<char>{in}, {}};
  if (const auto fault = fault_of_toml(content)) {
    complain(static_cast<std::uint64_t>(fault->line), fault->what);
    return read;
  }
  try {
    flatten(toml::parse(content), "", file, read);
  } catch (const toml::parse_error& broken) {
    complain(broken.source().begin.line, broken.description());
  }
  return read;
}

void read_override(const Override& override, ScenarioText& read) {
  const auto& [key_and_value, option] = override;
  const std::size_t equals = key_and_value.find('=');
  const std::string key = key_of(key_and_value);
  const std::string text =
      equals == std::string::npos ? "" : trimmed(key_and_value.substr(equals + 1));
  if (key.empty() || text.empty()) {
    read.errors.push_back(
        {ErrorCode::invalid_input,
         option + " " + key_and_value + " is not KEY=VALUE; for example: --set map.range_m=5"});
    return;
  }
  GivenValue given = toml_scalar(text).value_or(GivenValue{text, option, text});
  given.text = text;
  given.origin = option;
  read.values[key] = std::move(given);
}

}  // namespace flyball
