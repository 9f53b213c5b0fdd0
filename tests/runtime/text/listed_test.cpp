// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/text/listed.h"

#include <array>
#include <map>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Listed, puts_commas_between_texts_and_between_integers) {
  EXPECT_EQ(listed(std::vector<std::string>{"rrt", "prm", "bit_star"}), "rrt, prm, bit_star");
  EXPECT_EQ(listed(std::array<const char*, 2>{"rrt", "prm"}), "rrt, prm");
  EXPECT_EQ(listed(std::vector<std::uint64_t>{3, 12}), "3, 12");
}

TEST(Listed, of_one_item_is_that_item_and_of_none_is_empty) {
  EXPECT_EQ(listed(std::vector<int>{-7}), "-7");
  EXPECT_EQ(listed(std::vector<std::string>{}), "");
}

TEST(Listed, writes_an_item_as_it_is_told_and_leaves_out_what_has_no_text) {
  const std::map<std::string, int> counts{{"a", 0}, {"b", 2}, {"c", 0}, {"d", 1}, {"e", 0}};
  const auto text = listed(counts, [](const auto& one) {
    return one.second == 0 ? "" : one.first + " " + std::to_string(one.second);
  });
  EXPECT_EQ(text, "b 2, d 1");
}

}  // namespace
}  // namespace flyball
