// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/scenario/files.h"

#include "scratch_folder.h"
#include <algorithm>

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

TEST(Files, a_kind_that_is_not_shipped_is_empty) {
  EXPECT_TRUE(shipped("nonsense").empty());
}

}  // namespace
}  // namespace flyball
