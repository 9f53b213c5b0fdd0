// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/preset.h"

#include "flyball/runtime/text/toml_text.h"

#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#define TOML_HEADER_ONLY 1  // NOLINT: toml++'s own switch
#include <toml++/toml.h>

namespace flyball {
namespace {

/// Builds a preset from a parsed file and remembers what was wrong with it.
class Reader {
 public:
  explicit Reader(std::string path) : path_{std::move(path)} {}

  Result<Preset> read(const toml::table& file) {
    for (const auto& [key, node] : file) {
      read_top(key, node);
    }
    if (problems_.empty()) {
      problems_ = missing();
    }
    if (!problems_.empty()) {
      return Error{ErrorCode::invalid_input, problems_};
    }
    return std::move(preset_);
  }

  /// The file has nothing but parameters.
  Result<Preset> read_parameters(const toml::table& file) {
    for (const auto& [name, value] : file) {
      read_parameter(name, value);
    }
    if (!problems_.empty()) {
      return Error{ErrorCode::invalid_input, problems_};
    }
    return std::move(preset_);
  }

 private:
  [[nodiscard]] std::string missing() const {
    const bool both = !preset_.application.empty() && !preset_.clock.empty();
    const bool one = !preset_.application.empty() || !preset_.clock.empty();
    if (one && !preset_.policy.empty()) {
      return path_ + ": either a policy, or an application and a clock";
    }
    if (one && !both) {
      return path_ + ": application and clock go together; write both";
    }
    if (both && !preset_.parameters.empty()) {
      return path_ + ": a combination has no [parameters]; they stand in the presets that it names";
    }
    return one || !preset_.policy.empty()
               ? ""
               : path_ + ": no policy; write policy = \"NAME\" (flyball list policies)";
  }

  void read_top(const toml::key& key, const toml::node& node) {
    if (key == "policy") {
      read_text(key, node, preset_.policy);
    } else if (key == "description") {
      read_text(key, node, preset_.description);
    } else if (key == "application") {
      read_text(key, node, preset_.application);
    } else if (key == "clock") {
      read_text(key, node, preset_.clock);
    } else if (key != "parameters") {
      complain(node,
               quoted(key) +
                   " is no key of a preset; known: policy, description, [parameters], application, "
                   "clock");
    } else if (const toml::table* parameters = node.as_table()) {
      for (const auto& [name, value] : *parameters) {
        read_parameter(name, value);
      }
    } else {
      complain(node, "parameters is a table; write [parameters] on a line of its own");
    }
  }

  void read_text(const toml::key& key, const toml::node& node, std::string& text) {
    if (const auto value = node.value_exact<std::string>(); value && !value->empty()) {
      text = *value;
    } else {
      complain(node, std::string{key.str()} + " must be a text in quotes that is not empty");
    }
  }

  void read_parameter(const toml::key& name, const toml::node& node) {
    if (const auto text = node.value_exact<std::string>()) {
      preset_.parameters[std::string{name.str()}] = *text;
    } else if (const auto number = node.value<double>(); number && node.is_number()) {
      preset_.parameters[std::string{name.str()}] = *number;
    } else if (node.is_number()) {
      complain(node, "parameter " + quoted(name) + " is a whole number beyond 2^53; write 1.0e16");
    } else {
      complain(node, "parameter " + quoted(name) + " must be a number or a text");
    }
  }

  static std::string quoted(const toml::key& key) { return "\"" + std::string{key.str()} + "\""; }

  void complain(const toml::node& node, const std::string& what) {
    problems_ += (problems_.empty() ? "" : "\n") + path_ + ":" +
                 std::to_string(node.source().begin.line) + ": " + what;
  }

  std::string path_;
  Preset preset_;
  std::string problems_;
};

std::optional<std::string> content_of(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) {
    return std::nullopt;
  }
  std::ifstream file{path};
  std::string text{std::istreambuf_iterator<char>{file}, {}};
  return file.good() || file.eof() ? std::optional{std::move(text)} : std::nullopt;
}

using ReaderFunction = Result<Preset> (Reader::*)(const toml::table& file);

Result<Preset> parsed(const std::string& origin, const std::string& text, ReaderFunction read) {
  if (const auto fault = fault_of_toml(text)) {
    return Error{ErrorCode::invalid_input,
                 origin + ":" + std::to_string(fault->line) + ": " + fault->what};
  }
  try {
    Reader reader{origin};
    return (reader.*read)(toml::parse(text));
  } catch (const toml::parse_error& error) {
    return Error{ErrorCode::invalid_input, origin + ":" +
                                               std::to_string(error.source().begin.line) + ": " +
                                               std::string{error.description()}};
  } catch (const std::exception& error) {
    return Error{ErrorCode::failed, origin + ": " + error.what()};
  }
}

}  // namespace

Result<Preset> load_preset(const std::string& path) {
  const auto text = content_of(path);
  if (!text) {
    return Error{ErrorCode::not_found, "no preset file " + path + "; try: flyball list policies"};
  }
  return parsed(path, *text, &Reader::read);
}

Result<std::map<std::string, ParameterValue>> read_parameters(const std::string& text) {
  auto preset = parsed("parameters", text, &Reader::read_parameters);
  if (!preset) {
    return preset.error();
  }
  return std::move(preset->parameters);
}

}  // namespace flyball
