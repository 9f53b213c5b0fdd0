// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/program.h"

#include <cstdlib>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Program, is_the_one_that_runs) {
  ASSERT_EQ(unsetenv("FLYBALL_PROGRAM"), 0);
  EXPECT_EQ(program_to_start(), "/proc/self/exe");
  EXPECT_NE(program_file().find("/test_runtime"), std::string::npos);
}

TEST(Program, is_the_launcher_that_started_it) {
  ASSERT_EQ(setenv("FLYBALL_PROGRAM", "/opt/flyball/bin/flyball", 1), 0);
  EXPECT_EQ(program_to_start(), "/opt/flyball/bin/flyball");
  EXPECT_EQ(program_file(), "/opt/flyball/bin/flyball");
  unsetenv("FLYBALL_PROGRAM");
}

}  // namespace
}  // namespace flyball
