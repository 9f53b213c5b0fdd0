// SPDX-License-Identifier: BSD-3-Clause
#include "board/sysfs_text.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Numbers = std::vector<int>;

TEST(SysfsText, reads_both_forms_of_lists_of_cores) {
  EXPECT_EQ(cpu_list_of("0,3-5\n"), (Numbers{0, 3, 4, 5}));
  EXPECT_EQ(cpu_list_of("0 3 4 5 \n"), (Numbers{0, 3, 4, 5}));
  EXPECT_EQ(cpu_list_of("7"), (Numbers{7}));
  EXPECT_EQ(cpu_list_of("3,1,3"), (Numbers{1, 3}));
}

TEST(SysfsText, takes_what_is_no_list_as_empty) {
  for (const char* text : {"", "\n", "0-", "-1", "5-3", "a", "0,b", "0-99999999999", "1-2-3"}) {
    EXPECT_TRUE(cpu_list_of(text).empty()) << text;
  }
}

TEST(SysfsText, reads_whole_numbers_and_nothing_else) {
  EXPECT_EQ(integer_of("-256"), -256);
  for (const char* text : {"", "12 ", "1.5", "0x10", "99999999999999999999", "<unsupported>"}) {
    EXPECT_FALSE(integer_of(text)) << text;
  }
}

TEST(SysfsText, cuts_newlines_and_the_nul_of_device_trees) {
  EXPECT_EQ(trimmed(std::string_view{" quill\n\0", 8}), "quill");
  EXPECT_EQ(trimmed("\n"), "");
}

TEST(SysfsText, finds_numbers_behind_names) {
  EXPECT_EQ(number_behind("cpu", "cpu12"), 12);
  EXPECT_FALSE(number_behind("cpu", "cpufreq"));
  EXPECT_FALSE(number_behind("cpu", "cpu"));
  EXPECT_FALSE(number_behind("policy", "cpu0"));
}

TEST(SysfsText, writes_clocks_in_whole_khz) {
  EXPECT_EQ(khz_of(Hertz{1420.8e6}), "1420800");
  EXPECT_EQ(mhz_of(Hertz{1420.8e6}), "1420.8 MHz");
}

}  // namespace
}  // namespace flyball
