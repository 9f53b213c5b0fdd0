// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which results came later than the budget that was in force when their job began.

#include "flyball/runtime/time.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace flyball {

/// One indicator for each result that a budget stood for, as RoboRun's logs count overruns (DAC
/// 2021): a result of a job that began while there was no budget to keep is not counted.
/// Nothing allocates after construction.
class BudgetLedger {
 public:
  struct Count {
    std::uint64_t results{};  ///< Of jobs with a budget.
    std::uint64_t late{};     ///< Of them.
  };

  /// @param levels  What is counted apart, at least 1.
  /// @param kept    Budgets remembered, at least 1: as many as can be set while one job runs.
  BudgetLedger(std::size_t levels, std::size_t kept);

  /// From `now` on jobs have so much time; none (not above zero): there is no budget to keep.
  /// @pre `level < levels`.
  void set(MissionTime now, std::size_t level, double budget_s);
  /// A result that came at `now` or shortly before and took `latency`. The budget is the last one
  /// set by the time its job began; the oldest one kept when all are younger.
  void came(MissionTime now, Duration latency);

  [[nodiscard]] const std::vector<Count>& levels() const { return counts_; }
  [[nodiscard]] Count all() const;

 private:
  struct Entry {
    MissionTime from{};
    std::size_t level{};
    double budget_s{};
  };

  std::vector<Entry> entries_;  ///< A ring.
  std::size_t next_{};
  std::size_t known_{};
  std::vector<Count> counts_;
};

}  // namespace flyball
