// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/scenario/knobs.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

ModeledPlatform two_clocks() {
  PlatformModel model;
  model.name = "two_clocks";
  model.max_cores = 3;
  model.frequencies = {Hertz{1e9}, Hertz{2e9}};
  return ModeledPlatform{model};
}

TEST(StandardKnobs, every_default_is_legal_for_the_default_scenario) {
  const ModeledPlatform platform = two_clocks();
  Scenario scenario;
  scenario.platform.cores = 2;
  scenario.platform.frequency_hz = 1e9;
  for (const auto& spec : standard_knobs(scenario, platform)) {
    EXPECT_TRUE(spec.is_legal(spec.fallback)) << spec.name << " = " << spec.fallback;
    EXPECT_FALSE(spec.description.empty()) << spec.name;
    EXPECT_FALSE(spec.unit.empty()) << spec.name;
  }
}

TEST(StandardKnobs, clocks_and_cores_are_the_platforms) {
  const ModeledPlatform platform = two_clocks();
  Scenario scenario;
  scenario.platform.cores = 3;
  scenario.platform.frequency_hz = 2e9;
  const KnobSettings knobs{standard_knobs(scenario, platform)};
  EXPECT_EQ(knobs.spec("cpu.frequency_hz")->legal, (std::vector<double>{1e9, 2e9}));
  EXPECT_EQ(knobs.spec("cpu.cores")->legal, (std::vector<double>{1, 2, 3}));
}

TEST(StandardKnobs, a_mapper_may_have_levels_of_its_own) {
  const ModeledPlatform platform = two_clocks();
  Scenario scenario;
  scenario.platform.cores = 2;
  scenario.platform.frequency_hz = 1e9;
  const KnobSettings knobs{standard_knobs(scenario, platform, {0.15, 0.3, 0.6})};
  const KnobSpec& spec = *knobs.spec("map.resolution_m");
  EXPECT_EQ(spec.legal, (std::vector<double>{0.15, 0.3, 0.6}));
  EXPECT_EQ(spec.nearest(0.8), 0.6);
  EXPECT_TRUE(standard_knobs(scenario, platform).front().legal.empty()) << "stock takes any";
}

}  // namespace
}  // namespace flyball
