// SPDX-License-Identifier: BSD-3-Clause
#include "budget_ledger.h"

#include "flyball/runtime/assert.h"

namespace flyball {

BudgetLedger::BudgetLedger(std::size_t levels, std::size_t kept) : entries_(kept), counts_(levels) {
  FLYBALL_ASSERT(levels > 0 && kept > 0, "levels=%zu, kept=%zu", levels, kept);
}

void BudgetLedger::set(MissionTime now, std::size_t level, double budget_s) {
  FLYBALL_ASSERT(level < counts_.size(), "level=%zu", level);
  entries_[next_] = {now, level, budget_s};
  next_ = (next_ + 1) % entries_.size();
  known_ = known_ < entries_.size() ? known_ + 1 : known_;
}

void BudgetLedger::came(MissionTime now, Duration latency) {
  if (known_ == 0) {
    return;
  }
  const MissionTime began = now - latency;
  const auto back = [this](std::size_t i) -> const Entry& {  // 1: the newest.
    return entries_[(next_ + entries_.size() - i) % entries_.size()];
  };
  std::size_t i = 1;
  while (i < known_ && back(i).from > began) {
    ++i;
  }
  const Entry& entry = back(i);
  if (!(entry.budget_s > 0.0)) {
    return;
  }
  Count& count = counts_[entry.level];
  ++count.results;
  count.late += to_seconds(latency) > entry.budget_s ? 1 : 0;
}

BudgetLedger::Count BudgetLedger::all() const {
  Count sum;
  for (const Count& one : counts_) {
    sum.results += one.results;
    sum.late += one.late;
  }
  return sum;
}

}  // namespace flyball
