// SPDX-License-Identifier: BSD-3-Clause
#include "flyball_program.h"
#include "scratch_folder.h"

#include <gtest/gtest.h>

namespace {

void expect_refused(const std::string& arguments, const std::string& sentence) {
  const auto done = FlyballProgram{}.run("calibrate " + arguments);
  EXPECT_EQ(done.exit_code, 2) << done.output;
  EXPECT_NE(done.errors.find(sentence), std::string::npos) << done.errors;
}

TEST(CalibrateCommand, overwrites_no_file) {
  const ScratchFolder place;
  const std::string file = place.file("mine.toml", "name = \"mine\"\n");
  expect_refused("--out '" + file + "'", "exists; remove it, or give --out another name");
  EXPECT_EQ(place.content("mine.toml"), "name = \"mine\"\n");
}

TEST(CalibrateCommand, says_what_it_needs) {
  expect_refused("", "--out");
  expect_refused("--out board.txt", "\"board.txt\" does not end in .toml");
  expect_refused("--out a.toml --like nowhere", "nowhere");
  expect_refused("--out a.toml --board nowhere", "nowhere");
  expect_refused("--out nowhere/a.toml --seconds 2", "nowhere/");
}

}  // namespace
