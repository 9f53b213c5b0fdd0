// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/scenario/models.h"

#include "models.h"
#include "scenario/sha256.h"
#include "scratch_folder.h"
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

namespace flyball {
namespace {

// The test program lies beside the program, so that it finds the same shipped list.
TEST(Models, that_are_known_say_where_they_come_from_and_how_to_tell_them) {
  const auto models = known_models();
  ASSERT_TRUE(models.ok()) << models.error().message;
  ASSERT_GE(models->size(), 4U);
  for (const KnownModel& model : *models) {
    EXPECT_EQ(model.sha256.size(), 64U) << model.file;
    EXPECT_GT(model.bytes, 0U) << model.file;
    EXPECT_FALSE(model.source.empty()) << model.file;
  }
}

TEST(Models, are_looked_for_first_in_the_folder_of_the_scenario) {
  EXPECT_EQ(model_folders("mine").front(), "mine");
  const auto shipped = model_folders("shipped");
  EXPECT_EQ(std::count(shipped.begin(), shipped.end(), "shipped"), 0);
}

TEST(Models, that_are_nowhere_are_named_with_the_project_that_has_them) {
  const ScratchFolder empty;
  const auto path = find_model("yolo-fastest-1.1.nowhere", empty.path());
  ASSERT_FALSE(path.ok());
  EXPECT_EQ(path.error().code, ErrorCode::not_found);
  EXPECT_NE(path.error().message.find("flyball models"), std::string::npos);
}

TEST(Models, that_were_changed_are_refused) {
  const ScratchFolder folder;
  const std::string file = "yolo-fastest-1.1.weights";
  const std::string wrong = folder.file(file, "no weights");
  const auto path = find_model(file, folder.path());
  ASSERT_FALSE(path.ok());
  EXPECT_EQ(path.error().code, ErrorCode::invalid_input);
  EXPECT_NE(path.error().message.find(wrong), std::string::npos);
  EXPECT_NE(path.error().message.find(sha256_of("no weights")), std::string::npos);
}

TEST(Models, that_are_right_are_found) {
  const auto real = find_test_model("yolo-fastest-1.1.cfg");
  if (!real) {
    GTEST_SKIP() << "skipped: no model";
  }
  const std::string folder = std::filesystem::path{*real}.parent_path().string();
  const auto models = known_models();
  ASSERT_TRUE(models.ok());
  for (const KnownModel& model : *models) {
    const auto path = find_model(model.file, folder);
    ASSERT_TRUE(path.ok()) << path.error().message;
    EXPECT_EQ(std::filesystem::file_size(*path), model.bytes);
  }
}

}  // namespace
}  // namespace flyball
