// SPDX-License-Identifier: BSD-3-Clause
#include "roborun/budget_ledger.h"

#include <chrono>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

MissionTime at(Duration since_start) {
  return MissionTime{since_start};
}

TEST(BudgetLedger, holds_a_result_against_the_budget_of_the_time_when_its_job_began) {
  BudgetLedger ledger{2, 8};
  ledger.set(at(1s), 0, 1.0);
  ledger.set(at(2s), 1, 0.3);
  ledger.came(at(2500ms), 800ms);  // Began at 1.7 s: .8 s of 1 s.
  EXPECT_EQ(ledger.levels()[0].results, 1U);
  EXPECT_EQ(ledger.levels()[0].late, 0U);
  ledger.came(at(2900ms), 400ms);  // Began at 2.5 s: .4 s of .3 s.
  EXPECT_EQ(ledger.levels()[1].results, 1U);
  EXPECT_EQ(ledger.levels()[1].late, 1U);
  ledger.came(at(3s), 290ms);
  EXPECT_EQ(ledger.levels()[1].late, 1U);
  EXPECT_EQ(ledger.all().results, 3U);
  EXPECT_EQ(ledger.all().late, 1U);
}

TEST(BudgetLedger, does_not_count_results_without_a_budget) {
  BudgetLedger ledger{1, 8};
  ledger.came(at(1s), 100ms);
  ledger.set(at(1s), 0, 0.0);
  ledger.came(at(2s), 100ms);
  ledger.set(at(2s), 0, -0.1);
  ledger.came(at(3s), 5s);  // Began before anything was set: the oldest counts.
  EXPECT_EQ(ledger.all().results, 0U);
}

TEST(BudgetLedger, forgets_all_but_the_newest) {
  BudgetLedger ledger{1, 2};
  ledger.set(at(1s), 0, 10.0);
  ledger.set(at(2s), 0, 1.0);
  ledger.set(at(3s), 0, 0.1);
  ledger.came(at(4s), 3s);  // Began at 1 s; the budget of 2 s is the oldest that is kept.
  EXPECT_EQ(ledger.all().late, 1U);
  ledger.came(at(4s), 1500ms);  // Began at 2.5 s.
  EXPECT_EQ(ledger.all().late, 2U);
  ledger.came(at(3s), 500ms);
  EXPECT_EQ(ledger.all().late, 2U);
}

}  // namespace
}  // namespace flyball
