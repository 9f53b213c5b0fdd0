// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/text_table.h"

#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(TextTable, columns_line_up_and_the_last_one_ends_where_it_ends) {
  EXPECT_EQ(aligned({{"a", "bb", "c"}, {"aaa", "b"}, {}, {"x", "", "long"}}),
            "a    bb  c\naaa  b\n\nx        long\n");
}

TEST(TextTable, counts_letters_and_not_their_bytes) {
  EXPECT_EQ(letters_in("f\xc3\xbcr"), 3U);
  EXPECT_EQ(aligned({{"\xc3\xbc", "b"}, {"ab", "c"}}), "\xc3\xbc   b\nab  c\n");
}

TEST(TextTable, numbers_are_rounded_to_their_digits) {
  EXPECT_EQ(rounded(1.25, 1), "1.2") << "ties go to even";
  EXPECT_EQ(rounded(-0.0312, 2), "-0.03");
  EXPECT_EQ(rounded(-std::numeric_limits<double>::max(), 3).size(), 314U)
      << "sign, 309 digits, point, 3 digits";
}

TEST(TextTable, markup_shows_as_text) {
  EXPECT_EQ(html_text("<b a=\"1\">&</b>"), "&lt;b a=&quot;1&quot;&gt;&amp;&lt;/b&gt;");
}

}  // namespace
}  // namespace flyball
