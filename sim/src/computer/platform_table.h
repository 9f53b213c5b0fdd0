// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One table of a platform file, checked key by key.

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <toml++/toml.h>

namespace flyball {

/// Reads keys of one table and remembers which were asked for: the rest is unknown. What is wrong
/// is added to `problems`.
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

  std::string text_or(const std::string& key, const std::string& fallback) {
    return table_.contains(key) ? text(key) : fallback;
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

  /// `[[thermal.trips]]`; none when the key is absent.
  std::vector<const toml::table*> tables_or_none(const std::string& key) {
    std::vector<const toml::table*> tables;
    if (!table_.contains(key)) {
      asked_.push_back(key);
      return tables;
    }
    const toml::array* list = require(key)->as_array();
    if (list == nullptr || !list->is_array_of_tables()) {
      complain(key, "is no list of tables");
      return tables;
    }
    for (const toml::node& item : *list) {
      tables.push_back(item.as_table());
    }
    return tables;
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

}  // namespace flyball
