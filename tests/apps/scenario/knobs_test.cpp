// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/scenario/knobs.h"

#include "flyball/kernels/collision_check.h"
#include "flyball/runtime/decision.h"
#include "flyball/scenario/plugins.h"

#include <algorithm>
#include <string>
#include <vector>

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

Scenario one_gigahertz() {
  Scenario scenario;
  scenario.platform.cores = 2;
  scenario.platform.frequency_hz = 1e9;
  return scenario;
}

std::string refusal(const Scenario& scenario) {
  const auto knobs = standard_knobs(scenario, two_clocks());
  return knobs ? "" : knobs.error().message;
}

TEST(StandardKnobs, every_default_is_legal_for_the_default_scenario) {
  const auto knobs = standard_knobs(one_gigahertz(), two_clocks());
  ASSERT_TRUE(knobs.ok()) << knobs.error().message;
  EXPECT_LE(knobs->size(), Decision::capacity);
  for (const auto& spec : *knobs) {
    EXPECT_TRUE(check_declaration(spec)) << check_declaration(spec).error().message;
  }
}

TEST(StandardKnobs, clocks_and_cores_are_the_platforms) {
  const KnobSettings knobs{standard_knobs(one_gigahertz(), two_clocks()).value()};
  EXPECT_EQ(knobs.spec("cpu.frequency_hz")->legal, (std::vector<double>{1e9, 2e9}));
  EXPECT_EQ(knobs.spec("cpu.cores")->legal, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(knobs.value("cpu.cores"), 2.0);
}

TEST(StandardKnobs, a_platform_that_lacks_the_clock_or_the_cores_is_refused) {
  Scenario scenario = one_gigahertz();
  scenario.platform.cores = 9;
  EXPECT_NE(refusal(scenario).find("cpu.cores"), std::string::npos) << refusal(scenario);
}

TEST(StandardKnobs, begin_with_what_the_scenario_says) {
  Scenario scenario = one_gigahertz();
  scenario.map = {0.6, 5.0, 12.0};
  scenario.planner.budget = 700;
  scenario.detector.scale = 2.0;
  scenario.mission.max_speed_m_s = 3.0;
  const KnobSettings knobs{standard_knobs(scenario, two_clocks()).value()};
  EXPECT_EQ(knobs.value("map.resolution_m"), 0.6);
  EXPECT_EQ(knobs.value("map.range_m"), 5.0);
  EXPECT_EQ(knobs.value("map.rate_hz"), 12.0);
  EXPECT_EQ(knobs.value("planner.budget"), 700.0);
  EXPECT_EQ(knobs.value("detector.scale"), 2.0);
  EXPECT_EQ(knobs.value("mission.max_speed_m_s"), 3.0);
}

/// Two clocks, and prices of a switch to these kernels.
ModeledPlatform with_switches(const std::vector<std::string>& kernels) {
  PlatformModel model;
  model.name = "with_switches";
  model.max_cores = 3;
  model.frequencies = {Hertz{1e9}, Hertz{2e9}};
  for (const std::string& kernel : kernels) {
    model.kernels[kernel].seconds_per["switches"] = 0.25;
  }
  return ModeledPlatform{model};
}

bool says(const std::string& sentence, const std::vector<std::string>& parts) {
  return std::all_of(parts.begin(), parts.end(), [&sentence](const std::string& part) {
    return sentence.find(part) != std::string::npos;
  });
}

TEST(StandardKnobs, that_exist_only_on_demand_are_not_there_by_default) {
  const KnobSettings knobs{standard_knobs(one_gigahertz(), two_clocks()).value()};
  for (const char* name :
       {"planner.kind", "detector.kind", "camera.rate_hz", "localizer.rate_hz"}) {
    EXPECT_EQ(knobs.spec(name), nullptr) << name;
  }
}

TEST(StandardKnobs, choose_among_the_kinds_that_a_scenario_allows) {
  const ModeledPlatform platform = with_switches({"rrt_star", "rrt_connect", "prm", "hog", "haar"});
  Scenario scenario = one_gigahertz();
  scenario.knobs.planner_kinds = "rrt_star, rrt_connect,prm";
  scenario.knobs.detector_kinds = "haar";
  const KnobSettings knobs{standard_knobs(scenario, platform).value()};
  EXPECT_EQ(knobs.spec("planner.kind")->labels,
            (std::vector<std::string>{"rrt_connect", "rrt_star", "prm"}));
  EXPECT_EQ(knobs.value("planner.kind"), 0.0);
  EXPECT_EQ(knobs.spec("detector.kind")->labels, (std::vector<std::string>{"hog", "haar"}));
}

TEST(StandardKnobs, that_choose_a_kernel_that_there_is_not_name_those_that_there_are) {
  Scenario scenario = one_gigahertz();
  scenario.knobs.planner_kinds = "crayon";
  EXPECT_TRUE(says(refusal(scenario), {"knobs.planner_kinds = \"crayon\"", "planner.kind",
                                       "bit_star, prm, rrt, rrt_connect, rrt_star"}))
      << refusal(scenario);
}

TEST(StandardKnobs, whose_switch_has_no_price_are_refused) {
  Scenario scenario = one_gigahertz();
  scenario.knobs.planner_kinds = "prm";
  const auto knobs = standard_knobs(scenario, with_switches({"rrt_connect"}));
  ASSERT_FALSE(knobs.ok());
  EXPECT_TRUE(says(knobs.error().message,
                   {"knobs.planner_kinds = \"prm\"", "with_switches", "[kernels.prm.seconds_per]"}))
      << knobs.error().message;
}

TEST(StandardKnobs, that_choose_a_detector_need_each_detectors_own_price) {
  Scenario scenario = one_gigahertz();
  scenario.knobs.detector_kinds = "haar";
  scenario.detector.cost_of = "yolov2";
  const auto knobs = standard_knobs(scenario, with_switches({"hog", "haar"}));
  ASSERT_FALSE(knobs.ok());
  EXPECT_TRUE(says(knobs.error().message, {"detector.cost_of = \"yolov2\"", "\"own\""}))
      << knobs.error().message;
}

TEST(StandardKnobs, of_rates_leave_out_whole_frames_of_the_camera) {
  Scenario scenario = one_gigahertz();
  scenario.knobs.camera_rate = scenario.knobs.localizer_rate = true;
  const KnobSettings knobs{standard_knobs(scenario, two_clocks()).value()};
  for (const char* name : {"camera.rate_hz", "localizer.rate_hz"}) {
    const KnobSpec& spec = *knobs.spec(name);
    EXPECT_EQ(spec.fallback, scenario.camera.rate_hz) << name;
    EXPECT_EQ(spec.nearest(0.4 * spec.fallback), spec.fallback / 3) << name;
    EXPECT_EQ(spec.min, spec.fallback / 8) << name;
  }
  KnobSettings turned = knobs;
  const Status refused = turned.set("camera.rate_hz", 19.0);
  ASSERT_FALSE(refused.ok());
  EXPECT_TRUE(says(refused.error().message, {"camera.rate_hz", "19", "2.5", "20"}))
      << refused.error().message;
}

TEST(StandardKnobs, of_rates_keep_a_localizer_that_sees_from_losing_its_place) {
  Scenario scenario = one_gigahertz();
  scenario.knobs.camera_rate = scenario.knobs.localizer_rate = true;
  scenario.kernels.localizer = "visual_slam";
  const KnobSettings knobs{standard_knobs(scenario, two_clocks()).value()};
  EXPECT_EQ(knobs.spec("localizer.rate_hz")->min, 4.0) << "two frames in half a second";
  EXPECT_EQ(knobs.spec("camera.rate_hz")->min, 4.0);
}

TEST(StandardKnobs, of_a_localizer_that_takes_no_frames_are_refused) {
  Scenario scenario = one_gigahertz();
  scenario.knobs.localizer_rate = true;
  scenario.kernels.localizer = "truth";
  scenario.kernels.slam_load = false;
  EXPECT_TRUE(says(refusal(scenario), {"knobs.localizer_rate = true", "\"truth\""}))
      << refusal(scenario);
}

TEST(StandardKnobs, a_mapper_may_have_levels_of_its_own) {
  Scenario scenario = one_gigahertz();
  const KnobSettings any{standard_knobs(scenario, two_clocks()).value()};
  EXPECT_TRUE(any.spec("map.resolution_m")->legal.empty()) << "stock takes any";
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters["finest_m"] = 0.075;
  const KnobSettings knobs{standard_knobs(scenario, two_clocks()).value()};
  const KnobSpec& spec = *knobs.spec("map.resolution_m");
  EXPECT_EQ(spec.legal, (std::vector<double>{0.075, 0.15, 0.3, 0.6}));
  EXPECT_EQ(spec.nearest(0.8), 0.6);
}

/// A collision check with a parameter and a knob of its own, or with knobs that cannot be.
class KnobbyCheck final : public CollisionChecker {
 public:
  [[nodiscard]] std::vector<ParameterSpec> parameters() const override {
    return {{"first_m", 0.5, 0.0, 10.0, "First value of the knob."},
            {"copies", 1.0, 1.0, 30.0, "How many knobs."},
            {"name", std::string{"knobby.margin_m"}, 0.0, 0.0, "Of the knob."}};
  }
  Status configure(const Parameters& chosen, const FindModel&) override {
    const double first_m = chosen.number("first_m");
    for (int i = 0; i < chosen.number("copies"); ++i) {
      const std::string name = chosen.text("name") + (i == 0 ? "" : std::to_string(i));
      knobs_.push_back({name, "m", "check", {}, 0.0, 1.0, first_m, "kept from obstacles"});
    }
    return Done{};
  }
  [[nodiscard]] std::vector<KnobSpec> knobs() const override { return knobs_; }
  PathCheck check(const OccupancyView&, const PathSpan&, const Cylinder&, Work&) override {
    return {};
  }

 private:
  std::vector<KnobSpec> knobs_{};
};

class OwnKnobs : public testing::Test {
 protected:
  static Scenario with(const std::string& parameter, ParameterValue value) {
    Scenario scenario = one_gigahertz();
    scenario.plugins = Plugins{}.with([](Registry& registry) {
      registry.add<CollisionChecker>("knobby", [] { return std::make_unique<KnobbyCheck>(); });
    });
    scenario.kernels.collision_check = "knobby";
    scenario.kernels.collision_check_parameters = {{parameter, std::move(value)}};
    return scenario;
  }
};

TEST_F(OwnKnobs, of_a_kernel_are_the_missions) {
  const KnobSettings knobs{standard_knobs(with("first_m", 0.25), two_clocks()).value()};
  EXPECT_EQ(knobs.value("knobby.margin_m"), 0.25) << "as its parameter says";
}

TEST_F(OwnKnobs, that_cannot_be_are_refused_in_one_sentence) {
  EXPECT_NE(refusal(with("first_m", 5.0))
                .find("collision_check \"knobby\": knob "
                      "\"knobby.margin_m\" cannot be 5 m at first"),
            std::string::npos);
  EXPECT_NE(refusal(with("name", "map.range_m")).find("is there already"), std::string::npos);
  EXPECT_NE(refusal(with("copies", 30.0)).find("a decision holds 24"), std::string::npos);
}

}  // namespace
}  // namespace flyball
