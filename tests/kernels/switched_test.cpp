// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/switched.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Says its name, and has a knob of its own.
class NamedPlanner final : public PathPlanner {
 public:
  explicit NamedPlanner(std::string name) : name_{std::move(name)} {}
  [[nodiscard]] std::vector<KnobSpec> knobs() const override {
    auto all = PathPlanner::knobs();
    all.push_back({name_ + ".care_m", "m", "plan", {}, 0.0, 9.0, 1.0, "kept from obstacles"});
    return all;
  }
  void apply(const KnobSettings& knobs) override { care_m_ = knobs.value(name_ + ".care_m"); }
  Plan plan(const PlanRequest&, const OccupancyView&) override {
    Plan plan;
    plan.failure = name_ + " " + std::to_string(care_m_);
    plan.work.add("iterations", 7.0);
    return plan;
  }

 private:
  std::string name_;
  double care_m_{};
};

class Nowhere final : public OccupancyView {
 public:
  [[nodiscard]] double resolution_m() const override { return 0.15; }
  [[nodiscard]] CellState state(const Vec3&) const override { return CellState::unknown; }
  [[nodiscard]] CellState body_state(const Vec3&, const Cylinder&) const override {
    return CellState::unknown;
  }
  [[nodiscard]] bool has_occupied(const Aabb&) const override { return false; }
  [[nodiscard]] bool segment_hits(const Vec3&, const Vec3&, const Cylinder&) const override {
    return false;
  }
  [[nodiscard]] double obstacle_density(const Vec3&, double, double) const override { return 0.0; }
  [[nodiscard]] double nearest_obstacle_m(const Vec3&, double limit_m, double) const override {
    return limit_m;
  }
};

class Switched : public testing::Test {
 protected:
  Switched() : planner{two()}, knobs{planner.knobs()} { planner.apply(knobs); }

  static std::vector<KernelKind<PathPlanner>> two() {
    std::vector<KernelKind<PathPlanner>> kinds;
    kinds.push_back({"near", std::make_unique<NamedPlanner>("near")});
    kinds.push_back({"far", std::make_unique<NamedPlanner>("far")});
    return kinds;
  }
  void choose(double kind) {
    EXPECT_TRUE(knobs.set("planner.kind", kind));
    planner.apply(knobs);
  }
  Plan plan() { return planner.plan({}, Nowhere{}); }

  SwitchedPlanner planner;
  KnobSettings knobs;
};

TEST_F(Switched, has_the_knobs_of_all_kinds_once_and_says_what_a_kind_is_called) {
  std::vector<std::string> names;
  for (const KnobSpec& spec : knobs.specs()) {
    EXPECT_TRUE(check_declaration(spec)) << check_declaration(spec).error().message;
    names.push_back(spec.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"planner.kind", "planner.budget", "near.care_m",
                                             "far.care_m"}));
  EXPECT_EQ(knobs.spec("planner.kind")->labels, (std::vector<std::string>{"near", "far"}));
  const Status refused = knobs.set("planner.kind", 2.0);
  ASSERT_FALSE(refused.ok());
  for (const char* part : {"planner.kind", "2", "0 (near)", "1 (far)"}) {
    EXPECT_NE(refused.error().message.find(part), std::string::npos) << refused.error().message;
  }
}

TEST_F(Switched, the_first_kind_works_until_the_knob_is_turned) {
  const Plan first = plan();
  EXPECT_EQ(first.failure.substr(0, 4), "near");
  EXPECT_EQ(first.work.charged_as(), "near");
  EXPECT_EQ(first.work.count("switches"), 0.0);
}

TEST_F(Switched, another_kind_works_for_its_own_prices_and_the_first_job_pays_the_switch) {
  choose(1.0);
  const Plan first = plan();
  EXPECT_EQ(first.failure.substr(0, 3), "far");
  EXPECT_EQ(first.work.charged_as(), "far");
  EXPECT_EQ(first.work.count("switches"), 1.0);
  EXPECT_EQ(first.work.count("iterations"), 7.0);
  EXPECT_EQ(plan().work.count("switches"), 0.0);
  choose(0.0);
  const Plan back = plan();
  EXPECT_EQ(back.failure.substr(0, 4), "near");
  EXPECT_EQ(back.work.charged_as(), "near");
  EXPECT_EQ(back.work.count("switches"), 1.0);
}

TEST_F(Switched, the_kind_that_works_is_told_its_own_knobs) {
  EXPECT_TRUE(knobs.set("far.care_m", 4.0));
  choose(1.0);
  EXPECT_EQ(plan().failure, "far " + std::to_string(4.0));
}

}  // namespace
}  // namespace flyball
