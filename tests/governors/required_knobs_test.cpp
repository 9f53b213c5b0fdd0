// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/required_knobs.h"

#include "flyball/governors/policy_conformance.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(RequiredKnobs, that_are_there_are_fine) {
  EXPECT_TRUE(require_knobs("policy \"mine\"", conformance_knobs(), {}).ok());
  EXPECT_TRUE(require_knobs("policy \"mine\"", conformance_knobs(), {"cpu.cores"}).ok());
}

TEST(RequiredKnobs, that_are_missing_are_named_all_at_once) {
  const Status refused = require_knobs("policy \"mine\"", conformance_knobs(),
                                       {"map.zoom", "cpu.cores", "map.colour"});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ("policy \"mine\": there is no knob map.zoom, map.colour; try: flyball list knobs",
            refused.error().message);
}

}  // namespace
}  // namespace flyball
