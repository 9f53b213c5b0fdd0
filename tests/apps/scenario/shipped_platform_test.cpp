// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/scenario/shipped_platform.h"

#include "flyball/scenario/files.h"

#include "scratch_folder.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(ShippedPlatform, is_found_by_its_name) {
  const auto model = find_platform("jetson_tx2");
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ(model->name, "jetson_tx2");
}

TEST(ShippedPlatform, names_what_is_unknown_and_what_cannot_be_read) {
  EXPECT_EQ(find_platform("jetson_tx9").error().code, ErrorCode::not_found);
  const ScratchFolder scratch;
  const std::string file = scratch.file("mine.toml", "cores = \"many\"\n");
  EXPECT_NE(find_platform(file).error().message.find(file), std::string::npos);
}

std::string refused(const std::string& text) {
  const ScratchFolder scratch;
  const auto model = find_platform(scratch.file("mine.toml", "like = \"jetson_tx2\"\n" + text));
  return model ? "" : model.error().message;
}

TEST(ShippedPlatform, refuses_prices_under_which_work_would_be_free) {
  const std::string misspelt = refused("[kernels.lawnmower.seconds_per]\nwaypoint = 1e-5\n");
  EXPECT_NE(misspelt.find("mine.toml\": kernels.lawnmower.seconds_per.waypoint prices what no "
                          "kernel counts; did you mean waypoints?"),
            std::string::npos)
      << misspelt;
  EXPECT_NE(misspelt.find("kernels.lawnmower.seconds_per has no price of waypoints; give it one"),
            std::string::npos)
      << misspelt;
  EXPECT_NE(refused("[kernels.nbvp.seconds_per]\niterations = 1e-6\n").find("no price of cells"),
            std::string::npos);
}

TEST(ShippedPlatform, may_price_what_only_a_plug_in_counts) {
  EXPECT_EQ(refused("[kernels.mine.seconds_per]\nants = 1e-6\n"), "");
  EXPECT_EQ(refused("[kernels.lawnmower.seconds_per]\nwaypoints = 0.0\n"), "");
}

TEST(ShippedPlatform, each_one_prices_all_that_its_kernels_count) {
  for (const std::string& name : shipped("platforms")) {
    const auto model = find_platform(name);
    EXPECT_TRUE(model) << (model ? "" : model.error().message);
  }
}

}  // namespace
}  // namespace flyball
