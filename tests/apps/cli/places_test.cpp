// SPDX-License-Identifier: BSD-3-Clause
//
// Places that a command would write to, and that it must not: before anything flies.

#include "flyball_program.h"
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace {

constexpr const char* platform = "like = \"jetson_tx2\"\nname = \"plat\"\n";
constexpr const char* scenario =
    "name = \"my\"\nworld.generator = \"empty\"\nplatform.name = \"./plat.toml\"\n";

class Places : public testing::Test {
 protected:
  Places() {
    (void)flyball.place.file("my.toml", scenario);
    (void)flyball.place.file("plat.toml", platform);
  }
  void expect_refused(const std::string& arguments, const std::string& sentence) const {
    const auto outcome = flyball.run(arguments + " --out o");
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_EQ(outcome.errors, "flyball: " + sentence + "\n") << arguments;
    EXPECT_EQ(outcome.output, "") << "it has flown: " << arguments;
    EXPECT_EQ(flyball.place.content("my.toml"), scenario) << arguments;
    EXPECT_EQ(flyball.place.content("plat.toml"), platform) << arguments;
    EXPECT_FALSE(std::filesystem::exists(flyball.place.path("o"))) << arguments;
  }
  FlyballProgram flyball;
};

TEST_F(Places, of_files_that_are_read_are_kept) {
  const auto sentence = [](const std::string& file) {
    return "the flight reads \"" + file +
           "\" and would overwrite it; choose another place for what it writes";
  };
  expect_refused("run my.toml --timeline ./plat.toml", sentence("./plat.toml"));
  const std::string tune = "tune my.toml --try resolution_m=0.3 --seeds 1001 --preset ";
  expect_refused(tune + "./my.toml", sentence("my.toml"));
  expect_refused(tune + "plat.toml", sentence("./plat.toml"));
}

TEST_F(Places, where_a_folder_is_take_no_file) {
  for (const char* folder : {"d", "d.bt", "d.toml"}) {
    std::filesystem::create_directory(flyball.place.path(folder));
  }
  const std::string why = "\": it is a folder; choose another place";
  expect_refused("run my.toml --timeline d", "cannot write \"d" + why);
  expect_refused("run my.toml --map d.bt", "cannot write \"d.bt" + why);
  expect_refused("tune my.toml --try resolution_m=0.3 --seeds 1001 --preset d.toml",
                 "cannot write \"d.toml" + why);
}

}  // namespace
