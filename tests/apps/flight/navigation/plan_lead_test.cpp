// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/plan_lead.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(PlanLead, is_short_until_a_plan_has_taken_long) {
  PlanLead lead;
  EXPECT_EQ(lead.lead_s(), least_plan_lead_s);
  EXPECT_EQ(lead.last_s(), 0.0);
  lead.took(0.4, 1.0);
  EXPECT_NEAR(lead.lead_s(), 0.6, 1e-12);
  lead.took(100.0, 1.0);
  EXPECT_EQ(lead.lead_s(), 3.0);
  EXPECT_EQ(lead.last_s(), 100.0);
}

TEST(PlanLead, forgets_all_but_five) {
  PlanLead lead;
  lead.took(2.0, 1.0);
  for (int i = 0; i < 4; ++i) {
    lead.took(0.2, 1.0);
  }
  EXPECT_GT(lead.lead_s(), 0.3);
  lead.took(0.2, 1.0);
  EXPECT_NEAR(lead.lead_s(), 0.3, 1e-12);
}

TEST(PlanLead, knows_an_iteration_once_there_were_some) {
  PlanLead lead;
  EXPECT_EQ(lead.iteration_s(), 0.0);
  lead.took(0.5, 10.0);
  EXPECT_EQ(lead.iteration_s(), 0.0);
  lead.took(1.5, 390.0);
  EXPECT_NEAR(lead.iteration_s(), 2.0 / 400.0, 1e-12);
  lead.took(0.3, 0.0);
  EXPECT_NEAR(lead.iteration_s(), 2.0 / 400.0, 1e-12) << "a way that was known took no search";
}

}  // namespace
}  // namespace flyball
