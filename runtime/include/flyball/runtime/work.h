// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a kernel did: named counts of the operations that dominate it. A platform prices them.

#include <optional>
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
  void add(std::string_view name, double count) { add_to(items_, name, count); }
  /// The same, of work that several cores can do side by side. Once something was added so, even
  /// nothing, all that was added by `add` is done one after the other; before, the price list's
  /// `parallel_fraction` holds for the whole.
  void add_shared(std::string_view name, double count) {
    add(name, count);
    shared_ = shared_.value_or(std::vector<WorkItem>{});
    add_to(*shared_, name, count);
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
  /// Whether the work says which part of it several cores can do side by side ...
  [[nodiscard]] bool tells_shared() const { return shared_.has_value(); }
  /// ... and that part, which `items` counts too.
  [[nodiscard]] Work shared() const {
    Work part;
    part.charged_as_ = charged_as_;
    part.items_ = shared_.value_or(std::vector<WorkItem>{});
    return part;
  }

  /// How many threads have shared it, where the node does not always use all that it may
  /// (`NodeSpec::threads`); empty: so many.
  [[nodiscard]] std::optional<int> threads() const { return threads_; }
  void shared_among(int threads) { threads_ = threads; }

  /// The kernel whose price list counts, where a node's kernel may change between two jobs. Empty:
  /// the one that the node names (`NodeSpec::cost`).
  [[nodiscard]] const std::string& charged_as() const { return charged_as_; }
  void charge_as(std::string kernel) { charged_as_ = std::move(kernel); }

 private:
  static void add_to(std::vector<WorkItem>& items, std::string_view name, double count) {
    for (auto& item : items) {
      if (item.name == name) {
        item.count += count;
        return;
      }
    }
    items.push_back({name, count});
  }

  std::vector<WorkItem> items_;
  std::optional<std::vector<WorkItem>> shared_{};
  std::optional<int> threads_{};
  std::string charged_as_{};
};

}  // namespace flyball
