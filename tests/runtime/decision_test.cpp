// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/decision.h"

#include <set>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Decision, keeps_wishes_in_order) {
  Decision decision;
  decision.set("map.resolution_m", 0.3);
  decision.set("cpu.cores", 2.0);
  ASSERT_EQ(decision.size(), 2U);
  EXPECT_EQ(decision.begin()[0].knob, "map.resolution_m");
  EXPECT_EQ(decision.begin()[1].value, 2.0);
  EXPECT_EQ(decision.end() - decision.begin(), 2);
}

TEST(Decision, says_so_when_it_holds_no_more) {
  Decision decision;
  for (std::size_t i = 0; i < Decision::capacity; ++i) {
    decision.set("knob", 1.0);
  }
  EXPECT_FALSE(decision.overflowed());
  decision.set("knob", 2.0);
  EXPECT_TRUE(decision.overflowed());
  EXPECT_EQ(decision.size(), Decision::capacity);
}

TEST(Reason, has_a_word_for_each_value) {
  std::set<std::string_view> words;
  for (const Reason reason : {Reason::fixed, Reason::density, Reason::deadline, Reason::energy,
                              Reason::load, Reason::fallback}) {
    words.insert(to_string(reason));
  }
  EXPECT_EQ(words, (std::set<std::string_view>{"fixed", "density", "deadline", "energy", "load",
                                               "fallback"}));
}

}  // namespace
}  // namespace flyball
