// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/text/number_text.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(NumberText, reads_back_as_the_same_number) {
  for (const double value : {0.0, 0.1, 0.1 + 0.2, -1.0 / 3.0, 1e-4, 2.04e9, 2.3e-308,
                             -std::numeric_limits<double>::max()}) {
    EXPECT_EQ(std::stod(number_text(value)), value) << number_text(value);
  }
}

TEST(NumberText, is_the_shortest_text) {
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(260.0), "260");
}

TEST(NumberText, of_people_has_six_digits) {
  EXPECT_EQ(short_number_text(0.1 + 0.2), "0.3");
  EXPECT_EQ(short_number_text(346.3), "346.3");
  EXPECT_EQ(short_number_text(1.0 / 3.0), "0.333333");
  EXPECT_EQ(short_number_text(-250.0), "-250");
}

TEST(NumberText, has_words_for_what_is_no_number) {
  EXPECT_EQ(short_number_text(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(number_text(std::abs(std::nan(""))), "nan");
}

}  // namespace
}  // namespace flyball
