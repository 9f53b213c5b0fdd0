// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/text/printable.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::string_literals;

TEST(Printable, leaves_text_as_it_is) {
  for (const std::string& text : {""s, "no policy \"x\"; try: flyball list policies"s,
                                  "\u00e4 \u20ac \u65e5\u672c \U0001f600 30\u00b0 m\u00b3"s}) {
    EXPECT_EQ(text, printable(text));
  }
}

TEST(Printable, shows_what_would_steer_a_terminal) {
  EXPECT_EQ("\\x1b[2J\\x07\\x0d\\x0a\\x7f", printable("\x1b[2J\a\r\n\x7f"));
  EXPECT_EQ("\\x00", printable("\0"s));
  EXPECT_EQ("\\xc2\\x9b31m", printable("\u009b31m")) << "a control sequence in two bytes";
  EXPECT_EQ("\\xe2\\x80\\xaeabc", printable("\u202eabc")) << "writes from right to left";
}

TEST(Printable, shows_what_is_no_text) {
  EXPECT_EQ("\\x9b31m", printable("\x9b"s + "31m"));
  EXPECT_EQ("\\xff\\xfe", printable("\xff\xfe"));
  EXPECT_EQ("\\xe2\\x82", printable("\xe2\x82")) << "cut off";
  EXPECT_EQ("\\xc0\\x9b", printable("\xc0\x9b")) << "an escape in more bytes than it takes";
  EXPECT_EQ("\\xed\\xa0\\x80", printable("\xed\xa0\x80")) << "half of a pair";
}

TEST(Printable, keeps_what_is_asked_for) {
  EXPECT_EQ("a\tb\nc\\x1b", printable("a\tb\nc\x1b", "\n\t"));
}

}  // namespace
}  // namespace flyball
