// SPDX-License-Identifier: BSD-3-Clause

#include "experiments/framework/evidence.h"

#include "made_flights.h"
#include "made_sweep.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

Evidence made_evidence() {
  return Evidence{{{"made", made_sweep()}}};
}

TEST(Evidence, finds_the_flights_of_a_point) {
  const Evidence evidence = made_evidence();
  const Point point = evidence.at("made", {"2"});
  ASSERT_EQ(point.flights.size(), 2U);
  EXPECT_EQ(median(point, flight_figure("mission_time_s")).value->median, 201.5);
  EXPECT_EQ(median(point, flight_figure("mission_time_s")).n, 2);
  EXPECT_EQ(evidence.sweep("made").plan.axes.front().key, "a");
}

TEST(Evidence, finds_the_value_with_the_least_energy_among_those_that_succeed_most_often) {
  for (const bool cheaper_fails : {false, true}) {
    Sweep sweep = made_sweep();
    for (SweepFlight& flight : sweep.flights) {
      const bool is_cheaper = flight.point == 1;
      flight.summary.energy_rotor_j = is_cheaper ? 100.0 : 200.0;
      flight.summary.policy_faults = 0;
      flight.summary.status =
          is_cheaper && cheaper_fails ? MissionStatus::failed : MissionStatus::succeeded;
    }
    const Evidence evidence{{{"made", sweep}}};
    EXPECT_EQ(best_in_hindsight(evidence, "made", {"1", "2"}), cheaper_fails ? "1" : "2");
  }
}

TEST(Evidence, pairs_flights_by_their_seeds) {
  const Evidence evidence = made_evidence();
  const Measured found = ratio(evidence.at("made", {"2"}), evidence.at("made", {"1"}),
                               flight_figure("mission_time_s"));
  EXPECT_EQ(found.n, 2);
  EXPECT_NEAR(found.value->median, 0.5 * (201.0 / 101.0 + 202.0 / 102.0), 1e-12);
  EXPECT_LT(found.value->lo, found.value->hi);
}

// By hand: 340 s with one loss over 220 s with two; a factor of exp(1.96 sqrt(1 + 1/2)) each way.
TEST(Evidence, counts_a_flight_that_ended_without_a_loss_as_a_part_of_a_longer_one) {
  std::vector<Summary> flights(6);
  const std::vector<double> seconds{120.0, 120.0, 100.0, 57.0, 43.0, 120.0};
  Point above;
  Point below;
  for (std::size_t i = 0; i < flights.size(); ++i) {
    flights[i].mission_time_s = seconds[i];
    (i < 3 ? above : below).flights.push_back(&flights[i]);
  }
  const auto is_lost = [](const Summary& flight) { return flight.mission_time_s < 119.0; };
  const auto time_s = flight_figure("mission_time_s");
  const Measured found = mean_life_ratio(above, below, time_s, is_lost);
  ASSERT_TRUE(found.value);
  EXPECT_EQ(found.n, 3);
  EXPECT_NEAR(found.value->median, 340.0 / 110.0, 1e-12);
  EXPECT_NEAR(found.value->hi / found.value->median, 11.03, 0.01);
  above.flights.pop_back();
  EXPECT_FALSE(mean_life_ratio(above, below, time_s, is_lost).value) << "nobody was lost";
}

TEST(Evidence, leaves_failed_flights_out_unless_they_count) {
  Sweep sweep = made_sweep();
  for (SweepFlight& flight : sweep.flights) {
    if (flight.point == 1 && flight.summary.seed == 1) {
      flight.summary.status = MissionStatus::failed;
    }
  }
  const Evidence evidence{{{"made", sweep}}};
  Point point = evidence.at("made", {"2"});
  EXPECT_EQ(success_percent(point).value->median, 50.0);
  EXPECT_EQ(success_percent(point).n, 2);
  EXPECT_EQ(share_percent(point, [](const Summary& /*flight*/) { return false; }).value->median,
            0.0);
  // Wilson's interval of 1 in 2.
  EXPECT_NEAR(success_percent(point).value->lo, 9.45, 0.01);
  EXPECT_NEAR(success_percent(point).value->hi, 90.55, 0.01);
  EXPECT_EQ(median(point, flight_figure("mission_time_s")).n, 1);
  EXPECT_EQ(ratio(evidence.at("made", {"1"}), point, flight_figure("mission_time_s")).n, 1);
  point.counts_failed = true;
  EXPECT_EQ(median(point, flight_figure("mission_time_s")).n, 2);
}

TEST(Evidence, has_no_number_where_no_flight_has_it) {
  const Evidence evidence = made_evidence();
  const Measured none = median(evidence.at("made", {"1"}), flight_figure("quality.of_life"));
  EXPECT_FALSE(none.value);
  EXPECT_EQ(none.n, 0);
}

TEST(EvidenceDeathTest, refuses_a_sweep_or_point_that_nobody_declared) {
  const Evidence evidence = made_evidence();
  EXPECT_DEATH((void)evidence.sweep("other"), "no sweep \"other\"");
  EXPECT_DEATH((void)evidence.at("made", {"3"}), "no such point");
}

}  // namespace
}  // namespace flyball
