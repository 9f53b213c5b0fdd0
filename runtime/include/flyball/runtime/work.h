// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a kernel did: named counts of the operations that dominate it. A platform prices them.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flyball {

struct WorkItem {
  std::string_view name;  ///< Static storage: a string literal.
  double count{};
};

class Work {
 public:
  /// Adds to the count of this name.
  void add(std::string_view name, double count) {
    for (auto& item : items_) {
      if (item.name == name) {
        item.count += count;
        return;
      }
    }
    items_.push_back({name, count});
  }
  /// Zero for a name that was never added.
  [[nodiscard]] double count(std::string_view name) const {
    for (const auto& item : items_) {
      if (item.name == name) {
        return item.count;
      }
    }
    return 0.0;
  }
  [[nodiscard]] const std::vector<WorkItem>& items() const { return items_; }

  /// The kernel whose price list counts, where a node's kernel may change between two jobs. Empty:
  /// the one that the node names (`NodeSpec::cost`).
  [[nodiscard]] const std::string& charged_as() const { return charged_as_; }
  void charge_as(std::string kernel) { charged_as_ = std::move(kernel); }

 private:
  std::vector<WorkItem> items_;
  std::string charged_as_{};
};

}  // namespace flyball
