// SPDX-License-Identifier: BSD-3-Clause

#include "studies/sweep/flight_figures.h"

#include "made_flights.h"
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace flyball {
namespace {

double figure(const Summary& summary, const std::string& name) {
  for (const auto& [each, value] : figures_of(summary)) {
    if (each == name) {
      return value;
    }
  }
  return std::nan("");
}

TEST(FlightFigures, are_those_of_the_summary) {
  const Summary summary = made_summary("fixed", 1);
  EXPECT_DOUBLE_EQ(figure(summary, "mission_time_s"), 100.0);
  EXPECT_DOUBLE_EQ(figure(summary, "energy_total_kj"), 31.00075);
  EXPECT_DOUBLE_EQ(figure(summary, "battery_used_percent"), 20.0);
  EXPECT_DOUBLE_EQ(figure(summary, "hover_time_s"), 12.5);
  EXPECT_DOUBLE_EQ(figure(summary, "replans"), 7.0);
  EXPECT_DOUBLE_EQ(figure(summary, "policy_faults"), 10.0);
  EXPECT_DOUBLE_EQ(figure(summary, "latency_p50_s"), 0.11);
  EXPECT_DOUBLE_EQ(figure(summary, "late_maps_percent"), 100.0 * 3.0 / 55.0);
  EXPECT_DOUBLE_EQ(figure(summary, "kernel.octomap.mean_ms"), 45.6);
  EXPECT_DOUBLE_EQ(figure(summary, "quality.area_covered_percent"), 97.25);
}

TEST(FlightFigures, leave_out_what_is_no_number) {
  Summary summary = made_summary("fixed", 1);
  summary.min_clearance_m = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(std::isnan(figure(summary, "min_clearance_m")));
  EXPECT_FALSE(std::isnan(figure(summary, "replans")));
}

TEST(FlightFigures, leave_out_the_latency_of_a_flight_without_maps) {
  Summary summary = made_summary("fixed", 1);
  summary.maps = 0;
  for (const char* name : {"latency_p50_s", "latency_p95_s", "late_maps_percent"}) {
    EXPECT_TRUE(std::isnan(figure(summary, name))) << name;
  }
}

TEST(FlightFigures, are_named_once_and_in_one_order_whoever_has_them) {
  const Summary first = made_summary("fixed", 1);
  Summary second = first;
  second.kernels["hog"] = {1, 2.0, 3.0, 4.0};
  second.quality["coverage_percent"] = 5.0;
  const auto names = figure_names({&first, &second});
  EXPECT_EQ(names, figure_names({&second, &first}));
  EXPECT_EQ(std::count(names.begin(), names.end(), "replans"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "kernel.hog.calls"), 1);
  EXPECT_EQ(names.front(), "mission_time_s");
  EXPECT_TRUE(figure_names({}).empty());
}

}  // namespace
}  // namespace flyball
