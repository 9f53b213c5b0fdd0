// SPDX-License-Identifier: BSD-3-Clause
#include "../../runtime/board/fake_trees.h"
#include "flyball_program.h"

#include <gtest/gtest.h>

namespace {

namespace fake = flyball::fake;

TEST(BoardCommand, knows_a_tx2_by_its_device_tree) {
  const fake::Tree tree;
  fake::plant_tx2_r32(tree);
  const auto done = FlyballProgram{}.run("board --root '" + tree.root() + "'");
  EXPECT_EQ(done.exit_code, 0) << done.errors;
  EXPECT_EQ(done.output.rfind("board        jetson_tx2 (NVIDIA Jetson TX2 Developer Kit), ", 0), 0U)
      << done.output;
  EXPECT_NE(done.output.find("12 from 345.6 MHz to 2035.2 MHz"), std::string::npos);
  EXPECT_NE(done.output.find("order 0, 3, 4, 5; a program of your own may ask for 1, 2"),
            std::string::npos);
  EXPECT_NE(done.output.find("heat         MCPU-therm 43 C"), std::string::npos);
}

TEST(BoardCommand, takes_the_board_that_it_is_told) {
  const fake::Tree tree;
  fake::plant_pi5(tree);
  const auto done = FlyballProgram{}.run("board --board generic_x86 --root '" + tree.root() + "'");
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_EQ(done.output.rfind("board        generic_x86 (Raspberry Pi 5", 0), 0U) << done.output;
}

TEST(BoardCommand, looks_at_the_machine_that_it_runs_on) {
  const auto done = FlyballProgram{}.run("board");
  EXPECT_EQ(done.exit_code, 0) << done.errors;
  EXPECT_NE(done.output.find("\nclock meter  "), std::string::npos) << done.output;
}

TEST(BoardCommand, refuses_folders_and_boards_that_are_not_there) {
  const auto nowhere = FlyballProgram{}.run("board --root nowhere");
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_EQ(nowhere.errors,
            "flyball: no folder \"nowhere/sys/devices/system/cpu\" to look for a board in; --root "
            "names a "
            "folder that has sys and proc\n");
  const auto unknown = FlyballProgram{}.run("board --board abacus");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.errors.find("abacus"), std::string::npos);
  EXPECT_NE(unknown.errors.find("flyball list boards"), std::string::npos) << unknown.errors;
}

TEST(BoardCommand, prints_the_setup_and_does_nothing) {
  const auto printed = FlyballProgram{}.run("board setup --print");
  EXPECT_EQ(printed.exit_code, 0) << printed.errors;
  EXPECT_EQ(printed.output.rfind("#!/bin/sh\n", 0), 0U);
  const auto bare = FlyballProgram{}.run("board setup");
  EXPECT_EQ(bare.exit_code, 2);
  EXPECT_NE(bare.errors.find("try: flyball board setup --print"), std::string::npos);
}

TEST(BoardCommand, refuses_to_restore_from_a_folder_in_which_nothing_was_left) {
  const FlyballProgram flyball;
  const std::string folder = flyball.place.path("typo");
  const auto refused = flyball.run("board restore --run-folder '" + folder + "'");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("no session has left anything in"), std::string::npos)
      << refused.errors;
  EXPECT_TRUE(flyball.place.is_empty());
}

TEST(BoardCommand, restores_what_was_left) {
  const fake::Tree tree;
  fake::plant_pi5(tree);
  const std::string file = "/sys/devices/system/cpu/cpufreq/policy0/scaling_governor";
  tree.put(file, "userspace\n");
  tree.put("/run/board.journal", std::to_string(file.size()) + "\n" + file + "\n9\nondemand\n\n");
  const auto done = FlyballProgram{}.run("board --root '" + tree.root() +
                                         "' restore --run-folder '" + tree.root() + "run'");
  EXPECT_EQ(done.exit_code, 0) << done.errors;
  EXPECT_EQ(done.output, "1 of 1 settings that an earlier session left are restored\n");
  EXPECT_EQ(tree.get(file), "ondemand\n");
  EXPECT_EQ(tree.get("/run/board.journal"), "");
}

TEST(BoardCommand, lists_the_boards_that_are_known) {
  const std::string output = FlyballProgram{}.run("list boards").output;
  for (const char* name : {"generic_x86 ", "jetson_orin ", "jetson_tx2 ", "raspberry_pi_5 "}) {
    EXPECT_NE(output.find(name), std::string::npos) << output;
  }
}

}  // namespace
