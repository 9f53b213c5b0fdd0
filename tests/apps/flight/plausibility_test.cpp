// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/plausibility.h"

#include "flyball/flight/navigation/plan_service.h"
#include "flyball/runtime/messages.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

struct Judged {
  explicit Judged(const Plausibility::Use& use) : plausibility{brief, use} {}

  static Brief in_a_field() {
    Brief brief;
    brief.site.bounds_W = {{-10.0, -50.0, 0.0}, {300.0, 50.0, 20.0}};
    return brief;
  }
  static Graph with_topics() {
    Graph graph{"judged"};
    (void)graph.topic<Setpoint>("setpoint");
    (void)graph.topic<PlanAnswer>("plan.response");
    (void)graph.topic<int>("number");
    return graph;
  }
  std::string of_setpoint(double at_s, double x_m) {
    Setpoint setpoint;
    setpoint.p_WB.x() = x_m;
    return plausibility.refused(graph.topics()[0], &setpoint, MissionTime{from_seconds(at_s)});
  }

  Brief brief{in_a_field()};
  Graph graph{with_topics()};
  Plausibility plausibility;
};

TEST(Plausibility, without_detectors_all_messages_pass) {
  Judged judged{{false, false}};
  EXPECT_EQ(judged.of_setpoint(0.0, 1e30), "");
}

TEST(Plausibility, a_number_out_of_its_range_is_named) {
  Judged judged{{true, false}};
  EXPECT_EQ(judged.of_setpoint(0.0, 299.0), "");
  EXPECT_EQ(judged.of_setpoint(0.02, 1e4), "x 10000 is out of its range");
  EXPECT_NE(judged.of_setpoint(0.04, std::numeric_limits<double>::quiet_NaN()), "");
  PlanAnswer answer;
  answer.waypoints_W = {Vec3{0.0, 0.0, 2.0}, Vec3{0.0, 0.0, -4000.0}};
  EXPECT_EQ(judged.plausibility.refused(judged.graph.topics()[1], &answer, MissionTime{}),
            "z -4000 is out of its range");
}

TEST(Plausibility, a_jump_in_a_stream_is_out_of_its_rate) {
  Judged judged{{false, true}};
  EXPECT_EQ(judged.of_setpoint(0.00, 10.0), "");
  EXPECT_EQ(judged.of_setpoint(0.02, 10.2), "");
  EXPECT_EQ(judged.of_setpoint(0.04, 20.4), "x 20.4 is out of its rate");
  EXPECT_EQ(judged.of_setpoint(0.06, 10.6), "");
}

TEST(Plausibility, a_jump_that_stays_is_believed_in_the_end) {
  Judged judged{{false, true}};
  EXPECT_EQ(judged.of_setpoint(0.0, 10.0), "");
  for (int i = 1; i <= Plausibility::most_in_row; ++i) {
    EXPECT_NE(judged.of_setpoint(0.001 * i, 60.0), "");
  }
  EXPECT_EQ(judged.of_setpoint(0.01, 60.0), "");
  EXPECT_EQ(judged.of_setpoint(0.03, 60.3), "");
}

TEST(Plausibility, what_does_not_tell_its_numbers_passes) {
  Judged judged{{true, true}};
  const int number = 1;
  EXPECT_EQ(judged.plausibility.refused(judged.graph.topics()[2], &number, MissionTime{}), "");
}

}  // namespace
}  // namespace flyball
