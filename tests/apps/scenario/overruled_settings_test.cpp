// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/scenario/overruled_settings.h"

#include "scratch_folder.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::vector<std::string> overruled(const std::string& policy, const std::vector<Override>& given) {
  std::vector<Override> all = given;
  all.push_back({"governor.policy=" + policy});
  const auto loaded = load_overridden_scenario("delivery_forest", all);
  EXPECT_TRUE(std::holds_alternative<LoadedScenario>(loaded)) << policy;
  return overruled_settings(std::get<LoadedScenario>(loaded).scenario, given);
}

using Sentences = std::vector<std::string>;

TEST(OverruledSettings, are_those_that_a_preset_of_fixed_sets_itself) {
  EXPECT_EQ(overruled("fixed_coarse", {{"map.range_m=5"}, {"map.resolution_m = 0.3", "--over"}}),
            Sentences{"policy fixed_coarse sets map.resolution_m itself, so --over "
                      "map.resolution_m changes nothing; policy fixed leaves it to the scenario"});
  EXPECT_EQ(overruled("fixed_fine_schedutil_10ms", {{"map.resolution_m=0.3"}}).size(), 1U);
  const ScratchFolder folder;
  const std::string slow =
      folder.file("slow.toml", "policy = 'fixed'\n[parameters]\nfrequency_hz = 345.6e6\n");
  EXPECT_EQ(overruled(slow, {{"platform.frequency_hz=806.4e6"}}).size(), 1U);
}

TEST(OverruledSettings, are_none_where_the_setting_counts_or_is_the_same) {
  EXPECT_EQ(overruled("fixed_coarse", {{"map.range_m=5"}}), Sentences{});
  EXPECT_EQ(overruled("fixed_coarse", {{"map.resolution_m=0.8"}}), Sentences{});
  EXPECT_EQ(overruled("fixed", {{"map.resolution_m=0.3"}}), Sentences{});
  EXPECT_EQ(overruled("two_level", {{"map.resolution_m=0.3"}}), Sentences{});
}

}  // namespace
}  // namespace flyball
