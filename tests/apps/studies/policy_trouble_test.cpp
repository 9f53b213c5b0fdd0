// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/policy_trouble.h"

#include "made_flights.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(PolicyTrouble, adds_up_all_flights_and_gives_the_first_reason) {
  Summary sound = made_summary("bad", 1);
  sound.policy_faults = 0;
  sound.policy_trouble.clear();
  Summary later = made_summary("bad", 3);
  later.policy_trouble = "a later one";
  PolicyTrouble trouble;
  trouble.add(sound);
  EXPECT_EQ(trouble.text("bad"), "");
  trouble.add(made_summary("bad", 2));
  trouble.add(later);
  EXPECT_EQ(trouble.text("bad"),
            "policy bad was replaced by safe settings in 20 of 1200 decisions (after some faults "
            "in a row it is not asked again): threw: <enough>");
}

}  // namespace
}  // namespace flyball
