// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board/board_file.h"

#include "built_data.h"
#include "fake_trees.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

Result<BoardFile> load_text(const std::string& text) {
  const ScratchFolder folder;
  const auto loaded = load_board_file(folder.file("board.toml", text));
  if (loaded) {
    return loaded;
  }
  std::string message = loaded.error().message;
  message.erase(0, folder.path().size());
  return Error{loaded.error().code, message};
}

std::vector<BoardFile> shipped_boards() {
  std::vector<BoardFile> boards;
  for (const char* name : {"generic_x86", "jetson_orin", "jetson_tx2", "raspberry_pi_5"}) {
    const auto board = load_board_file(kit::built_data() + "/boards/" + name + ".toml");
    EXPECT_TRUE(board.ok()) << name;
    if (board) {
      EXPECT_EQ(board->name, name);
      boards.push_back(*board);
    }
  }
  return boards;
}

TEST(BoardFile, reads_every_shipped_file) {
  EXPECT_EQ(shipped_boards().size(), 4U);
}

TEST(BoardFile, knows_boards_by_their_models) {
  const std::vector<BoardFile> boards = shipped_boards();
  EXPECT_EQ(board_file_for(boards, "quill").name, "jetson_tx2");
  EXPECT_EQ(board_file_for(boards, "NVIDIA Jetson TX2 Developer Kit").name, "jetson_tx2");
  EXPECT_EQ(board_file_for(boards, "NVIDIA Jetson Orin NX Developer Kit").name, "jetson_orin");
  EXPECT_EQ(board_file_for(boards, "Raspberry Pi 5 Model B Rev 1.0").name, "raspberry_pi_5");
  EXPECT_EQ(board_file_for(boards, "NUC11TNKi5").name, "unknown");
  EXPECT_EQ(board_file_for(boards, "").name, "unknown");
}

TEST(BoardFile, keeps_cores_of_a_pi_5_plugged_in) {
  const BoardFile board = board_file_for(shipped_boards(), "Raspberry Pi 5 Model B");
  EXPECT_FALSE(board.may_unplug_cores);
  EXPECT_EQ(board.lowest_kept_clock, Hertz{1500e6});
}

TEST(BoardFile, takes_the_cores_of_a_tx2_in_their_order) {
  const BoardFile board = board_file_for(shipped_boards(), "quill");
  EXPECT_EQ(board.core_order, (std::vector<int>{0, 3, 4, 5}));
  EXPECT_EQ(board.cores_if_asked, (std::vector<int>{1, 2}));
}

TEST(BoardFile, orders_the_cores_that_are_present) {
  using Cores = std::vector<int>;
  const Cores present{0, 1, 2, 3, 4, 5};
  BoardFile board;
  EXPECT_EQ(cores_in_order(board, present), present);
  board.core_order = {3, 0, 4, 9};
  board.cores_if_asked = {2, 8};
  EXPECT_EQ(cores_in_order(board, present), (Cores{3, 0, 4}));
  EXPECT_EQ(cores_in_order(board, present, true), (Cores{3, 0, 4, 2}));
  EXPECT_EQ(cores_in_order(board, {1, 5}), Cores{}) << "another board's file";
}

TEST(BoardFile, says_everything_that_is_wrong_in_one_message) {
  const auto board = load_text(
      "name = \"\"\ncore_order = [0, 0]\nmay_unplug_cores = 1\nclock_step_hz = \"fast\"\n"
      "input_rails = \"VDD_IN\"\ncolour = 3\n");
  ASSERT_FALSE(board.ok());
  EXPECT_EQ(board.error().code, ErrorCode::invalid_input);
  EXPECT_EQ(board.error().message,
            "board.toml: name must be a text that is not empty; name is missing; core_order must "
            "be a list of numbers of cores, each of them once; may_unplug_cores must be true or "
            "false; input_rails must be a list; clock_step_hz must be a number from 1e+06 to "
            "1e+10; colour is no key of a board");
}

TEST(BoardFile, refuses_what_is_no_toml_with_its_line) {
  const auto board = load_text("name = \"a\"\nmodels = [\n");
  ASSERT_FALSE(board.ok());
  EXPECT_NE(board.error().message.find("board.toml, line "), std::string::npos);
  EXPECT_EQ(load_text("[=]").error().code, ErrorCode::invalid_input);
}

TEST(BoardFile, is_missing) {
  EXPECT_EQ(load_board_file("nowhere.toml").error().message,
            "no board file \"nowhere.toml\"; try: flyball list boards");
}

}  // namespace
}  // namespace flyball
