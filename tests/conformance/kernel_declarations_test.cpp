// SPDX-License-Identifier: BSD-3-Clause
//
// What all kits check of any kernel: that it can be made, and that its parameters and knobs are
// declared as they must be. A path tracker stands for all families.

#include "flyball/kernels/conformance/kernel_conformance.h"
#include "flyball/kernels/path_planner.h"
#include "flyball/kernels/path_tracker.h"

#include "kernel_trials.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

template <class Family>
class Declarations : public KernelConformance<Family> {
 public:
  using KernelConformance<Family>::KernelConformance;
  std::vector<std::string> breaches() {
    return this->checked(knobs_of_family(), [] {});
  }

 private:
  static std::vector<std::string> knobs_of_family() {
    return std::is_same_v<Family, PathPlanner> ? std::vector<std::string>{"planner.budget"}
                                               : std::vector<std::string>{};
  }
};

KnobSpec margin(double fallback_m) {
  return {"mine.margin_m", "m", "follow", {}, 0.0, 1.0, fallback_m, "kept to the path"};
}

class DeclaringCulprit final : public PathTracker {
 public:
  explicit DeclaringCulprit(std::string crime) : crime_{std::move(crime)} {}

  [[nodiscard]] std::vector<ParameterSpec> parameters() const override {
    if (crime_ == "bounds") {
      return {{"gain", 9.0, 0.0, 1.0, "Out of its own bounds."}};
    }
    if (crime_ == "undescribed") {
      return {{"gain", 0.5, 0.0, 1.0, ""}};
    }
    return {{"gain", crime_ == "shifting" && is_configured_ ? 0.7 : 0.5, 0.0, 1.0, "Of what."}};
  }
  Status configure(const Parameters&, const FindModel& find_model) override {
    is_configured_ = true;
    if (crime_ == "needs_file") {
      return find_model("weights").error();
    }
    return Done{};
  }
  [[nodiscard]] std::vector<KnobSpec> knobs() const override {
    if (crime_ == "illegal_knob") {
      return {margin(7.0)};
    }
    return crime_ == "two_knobs" ? std::vector<KnobSpec>{margin(0.1), margin(0.2)}
                                 : std::vector<KnobSpec>{margin(0.1)};
  }
  Setpoint track(const Path&, const PathReference&, const PoseEstimate&, MissionTime) override {
    return {};
  }

 private:
  std::string crime_;
  bool is_configured_{};
};

TEST(KernelConformance, finds_what_is_declared_wrongly) {
  kit::expect_crimes_found<Declarations<PathTracker>, PathTracker>(
      [](const std::string& crime) {
        return crime == "nothing" ? nullptr : std::make_unique<DeclaringCulprit>(crime);
      },
      {{"nothing", "the factory makes nothing"},
       {"bounds", "out of its own bounds"},
       {"undescribed", "\"gain\" lacks a name or a description"},
       {"shifting", "declares other parameters once it is configured"},
       {"needs_file", "cannot be configured: no model files"},
       {"illegal_knob", "declares a knob wrongly"},
       {"two_knobs", "declares knob \"mine.margin_m\" twice"}});
}

class WithoutBudget final : public PathPlanner {
 public:
  [[nodiscard]] std::vector<KnobSpec> knobs() const override { return {}; }
  Plan plan(const PlanRequest&, const OccupancyView&) override { return {}; }
};

TEST(KernelConformance, finds_a_knob_of_the_family_that_is_missing) {
  Declarations<PathPlanner> conformance{{[] { return std::make_unique<WithoutBudget>(); }}};
  EXPECT_EQ(conformance.breaches(),
            std::vector<std::string>{"lacks the family's knob \"planner.budget\""});
}

TEST(KernelConformance, refuses_parameters_that_are_not_declared) {
  Declarations<PathTracker> conformance{
      {[] { return std::make_unique<DeclaringCulprit>("none"); }, {{"gian", 0.3}}}};
  ASSERT_EQ(conformance.breaches().size(), 1U);
  EXPECT_NE(conformance.breaches().front().find("no parameter \"gian\""), std::string::npos);
}

}  // namespace
}  // namespace flyball
