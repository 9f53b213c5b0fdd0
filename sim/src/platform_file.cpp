// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/platform_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <toml++/toml.h>

namespace flyball {
namespace {

// Reads keys of one table and remembers which were asked for: the rest is unknown.
class TableReader {
 public:
  TableReader(const toml::table& table, std::string where, std::vector<std::string>& problems)
      : table_{table}, where_{std::move(where)}, problems_{problems} {}

  double number(const std::string& key, double min, double max) {
    const toml::node* node = require(key);
    if (node == nullptr) {
      return min;
    }
    return checked(*node, key, min, max);
  }

  double number_or(const std::string& key, double fallback, double min, double max) {
    return table_.contains(key) ? number(key, min, max) : fallback;
  }

  std::string text(const std::string& key) {
    const toml::node* node = require(key);
    if (node != nullptr && !node->is_string()) {
      complain(key, "is no text");
    }
    return node != nullptr ? node->value<std::string>().value_or("") : "";
  }

  std::vector<double> numbers(const std::string& key, double min, double max) {
    std::vector<double> values;
    const toml::node* node = require(key);
    if (node == nullptr) {
      return values;
    }
    if (!node->is_array() || node->as_array()->empty()) {
      complain(key, "is no list of numbers");
      return values;
    }
    for (const toml::node& item : *node->as_array()) {
      values.push_back(checked(item, key, min, max));
    }
    return values;
  }

  const toml::table* table(const std::string& key) {
    const toml::node* node = require(key);
    if (node != nullptr && !node->is_table()) {
      complain(key, "is no table");
    }
    return node != nullptr ? node->as_table() : nullptr;
  }

  [[nodiscard]] std::string path(const std::string& key) const {
    return where_.empty() ? key : where_ + "." + key;
  }

  void reject_unknown() {
    for (const auto& [key, node] : table_) {
      const std::string name{key.str()};
      if (std::find(asked_.begin(), asked_.end(), name) == asked_.end()) {
        complain(name, "is unknown");
      }
    }
  }

  void complain(const std::string& key, const std::string& what) {
    problems_.push_back(path(key) + " " + what);
  }

 private:
  const toml::node* require(const std::string& key) {
    asked_.push_back(key);
    const toml::node* node = table_.get(key);
    if (node == nullptr) {
      complain(key, "is missing");
    }
    return node;
  }

  double checked(const toml::node& node, const std::string& key, double min, double max) {
    if (!node.is_number()) {
      complain(key, "is no number");
      return min;
    }
    const double value = node.value<double>().value_or(min);
    if (!std::isfinite(value) || value < min || value > max) {
      std::ostringstream what;
      what << "= " << value << " is not between " << min << " and " << max;
      complain(key, what.str());
      return min;
    }
    return value;
  }

  const toml::table& table_;
  std::string where_;
  std::vector<std::string>& problems_;
  std::vector<std::string> asked_;
};

PowerCost read_power(TableReader& reader) {
  PowerCost power;
  power.board_w = reader.number("board_w", 0.0, 1000.0);
  power.converter = reader.number("converter", 1.0, 10.0);
  power.soc_w = reader.number("soc_w", 0.0, 1000.0);
  power.memory_w = reader.number("memory_w", 0.0, 1000.0);
  power.cpu_constant_w = reader.number("cpu_constant_w", 0.0, 1000.0);
  power.cpu_linear_w = reader.number("cpu_linear_w", 0.0, 1000.0);
  power.core_linear_w = reader.number("core_linear_w", 0.0, 1000.0);
  power.core_cubic_w = reader.number("core_cubic_w", 0.0, 1000.0);
  reader.reject_unknown();
  return power;
}

KernelCost read_kernel(TableReader& reader, std::vector<std::string>& problems) {
  KernelCost cost;
  cost.scale = reader.number_or("scale", 1.0, 0.0, 1e9);
  cost.a = reader.number_or("a", 1.0, 0.0, 1e3);
  cost.b = reader.number_or("b", 0.0, 0.0, 1e3);
  cost.parallel_fraction = reader.number_or("parallel_fraction", 0.0, 0.0, 1.0);
  if (const toml::table* prices = reader.table("seconds_per")) {
    TableReader items{*prices, reader.path("seconds_per"), problems};
    for (const auto& [key, node] : *prices) {
      const std::string name{key.str()};
      cost.seconds_per[name] = items.number(name, 0.0, 1e6);
    }
    if (prices->empty()) {
      reader.complain("seconds_per", "names no work");
    }
  }
  // Both zero would make every job free without anybody noticing.
  if (cost.a + cost.b <= 0.0 || cost.scale <= 0.0) {
    reader.complain("scale, a + b", "must be positive");
  }
  reader.reject_unknown();
  return cost;
}

std::map<std::string, KernelCost, std::less<>> read_kernels(const toml::table& table,
                                                            TableReader& reader,
                                                            std::vector<std::string>& problems) {
  std::map<std::string, KernelCost, std::less<>> kernels;
  for (const auto& [key, node] : table) {
    const std::string name{key.str()};
    if (const toml::table* kernel = reader.table(name)) {
      TableReader items{*kernel, reader.path(name), problems};
      kernels[name] = read_kernel(items, problems);
    }
  }
  return kernels;
}

PlatformModel read_model(const toml::table& file, std::vector<std::string>& problems) {
  TableReader reader{file, "", problems};
  PlatformModel model;
  model.name = reader.text("name");
  const double cores = reader.number("max_cores", 1.0, 1024.0);
  if (cores != std::floor(cores)) {
    reader.complain("max_cores", "is no whole number");
  }
  model.max_cores = static_cast<int>(cores);
  for (const double hz : reader.numbers("frequencies_hz", 1e6, 1e11)) {
    if (!model.frequencies.empty() && !(model.frequencies.back() < Hertz{hz})) {
      reader.complain("frequencies_hz", "is not ascending");
    }
    model.frequencies.emplace_back(hz);
  }
  model.switching_time = from_seconds(reader.number("switching_time_s", 0.0, 10.0));
  if (const toml::table* power = reader.table("power")) {
    TableReader items{*power, "power", problems};
    model.power = read_power(items);
  }
  if (const toml::table* kernels = reader.table("kernels")) {
    TableReader items{*kernels, "kernels", problems};
    model.kernels = read_kernels(*kernels, items, problems);
  }
  reader.reject_unknown();
  return model;
}

std::string joined(const std::vector<std::string>& problems) {
  std::string all;
  for (const std::string& problem : problems) {
    all += (all.empty() ? "" : "; ") + problem;
  }
  return all;
}

}  // namespace

Result<PlatformModel> load_platform(const std::string& path) {
  std::ifstream stream{path};
  if (!stream) {
    return Error{ErrorCode::not_found,
                 "no platform file \"" + path + "\"; try: flyball list platforms"};
  }
  try {
    const toml::table file = toml::parse(stream, path);
    std::vector<std::string> problems;
    PlatformModel model = read_model(file, problems);
    if (!problems.empty()) {
      return Error{ErrorCode::invalid_input, "platform file \"" + path + "\": " + joined(problems)};
    }
    return model;
  } catch (const toml::parse_error& error) {
    std::ostringstream what;
    what << "platform file \"" << path << "\", line " << error.source().begin.line << ": "
         << error.description();
    return Error{ErrorCode::invalid_input, what.str()};
  } catch (const std::exception& error) {
    return Error{ErrorCode::failed, "platform file \"" + path + "\": " + error.what()};
  }
}

}  // namespace flyball
