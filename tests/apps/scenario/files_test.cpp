// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/scenario/files.h"

#include "flyball/scenario/scenario.h"

#include "scratch_folder.h"
#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Files, shipped_names_are_sorted_and_each_is_found) {
  for (const char* kind : {"scenarios", "airframes", "platforms", "presets"}) {
    const std::vector<std::string> names = shipped(kind);
    EXPECT_FALSE(names.empty()) << kind;
    EXPECT_TRUE(std::is_sorted(names.begin(), names.end())) << kind;
    for (const std::string& name : names) {
      EXPECT_TRUE(find_shipped(kind, name).ok()) << kind << " " << name;
    }
  }
}

TEST(Files, a_path_is_taken_as_it_is) {
  const ScratchFolder scratch;
  const std::string path = scratch.file("mine.toml", "");
  EXPECT_EQ(*find_shipped("scenarios", path), path);
}

TEST(Files, what_is_missing_is_named_with_the_way_out) {
  EXPECT_EQ(find_shipped("platforms", "abacus").error().message,
            "no platform \"abacus\"; try: flyball list platforms");
  EXPECT_EQ(find_shipped("presets", "abacus").error().message,
            "no policy \"abacus\"; try: flyball list policies");
  EXPECT_EQ(find_shipped("scenarios", "./abacus.toml").error().code, ErrorCode::not_found);
  EXPECT_FALSE(find_shipped("scenarios", "").ok());
  EXPECT_FALSE(find_shipped("scenarios", "./").ok()) << "a folder is no file";
}

/// The environment of one test.
struct GivenData {
  explicit GivenData(const std::string& folder) { setenv("FLYBALL_DATA", folder.c_str(), 1); }
  GivenData(const GivenData&) = delete;
  GivenData& operator=(const GivenData&) = delete;
  ~GivenData() { unsetenv("FLYBALL_DATA"); }
};

TEST(Files, are_those_of_the_folder_that_the_environment_names_and_no_others) {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch.path("scenarios"));
  const std::string mine = scratch.file("scenarios/mine.toml", "");
  {
    const GivenData given{scratch.path()};
    EXPECT_EQ(shipped("scenarios"), std::vector<std::string>{"mine"});
    EXPECT_TRUE(find_shipped("scenarios", "mine").ok());
    EXPECT_EQ(find_shipped("scenarios", "delivery_open").error().message,
              "no scenario \"delivery_open\"; try: flyball list scenarios");
  }
  {
    const GivenData empty{""};
    EXPECT_TRUE(find_shipped("scenarios", "delivery_open").ok()) << "nothing is named";
  }
}

TEST(Files, that_cannot_be_there_are_named_with_the_folder_and_the_way_out) {
  const ScratchFolder scratch;
  const GivenData given{scratch.path("nowhere")};
  EXPECT_EQ(find_shipped("scenarios", "delivery_open").error().message,
            "no scenario \"delivery_open\", because there is no folder \"" +
                scratch.path("nowhere/scenarios") +
                "\"; set FLYBALL_DATA to the folder share/flyball of the install, or of the build");
  const auto loaded = load_scenario(scratch.file("mine.toml", ""), {});
  ASSERT_TRUE(std::holds_alternative<std::vector<Error>>(loaded));
  EXPECT_NE(std::get<std::vector<Error>>(loaded).front().message.find("set FLYBALL_DATA"),
            std::string::npos);
}

TEST(Files, that_are_there_and_cannot_be_read_are_not_called_missing) {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch.path("folder.toml"));
  std::filesystem::create_symlink("loop.toml", scratch.path("loop.toml"));  // Root, too, may not.
  for (const auto& [name, why] :
       {std::pair{"folder.toml", "Is a directory"}, {"loop.toml", "Too many levels"}}) {
    const std::string path = scratch.path(name);
    for (const char* kind : {"scenarios", "presets", "platforms"}) {
      const auto found = find_shipped(kind, path);
      ASSERT_FALSE(found.ok());
      EXPECT_EQ(found.error().code, ErrorCode::unavailable);
      EXPECT_EQ(found.error().message.find("cannot read \"" + path + "\": " + why), 0U)
          << found.error().message;
    }
    EXPECT_TRUE(std::holds_alternative<std::vector<Error>>(load_scenario(path, {})));
  }
}

TEST(Files, of_nearly_that_name_are_suggested) {
  EXPECT_EQ(
      find_shipped("scenarios", "scaning_farm").error().message,
      "no scenario \"scaning_farm\"; did you mean scanning_farm? try: flyball list scenarios");
  EXPECT_NE(find_shipped("presets", "fixed_fin").error().message.find("did you mean fixed_fine?"),
            std::string::npos);
}

TEST(Files, a_kind_that_is_not_shipped_is_empty) {
  EXPECT_TRUE(shipped("nonsense").empty());
}

}  // namespace
}  // namespace flyball
