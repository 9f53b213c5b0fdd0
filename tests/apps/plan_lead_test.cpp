// SPDX-License-Identifier: BSD-3-Clause
#include "plan_lead.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(PlanLead, is_short_until_a_plan_has_taken_long) {
  PlanLead lead;
  EXPECT_EQ(lead.lead_s(), least_plan_lead_s);
  lead.took(0.4);
  EXPECT_NEAR(lead.lead_s(), 0.6, 1e-12);
  lead.took(100.0);
  EXPECT_EQ(lead.lead_s(), 3.0);
}

TEST(PlanLead, forgets_all_but_five) {
  PlanLead lead;
  lead.took(2.0);
  for (int i = 0; i < 4; ++i) {
    lead.took(0.2);
  }
  EXPECT_GT(lead.lead_s(), 0.3);
  lead.took(0.2);
  EXPECT_NEAR(lead.lead_s(), 0.3, 1e-12);
}

}  // namespace
}  // namespace flyball
