// SPDX-License-Identifier: BSD-3-Clause
//
// Searches that race each other on idle cores: a vehicle in a town waits less for its plans.

#include "flyball/scenario/scenario.h"
#include "flyball/simulation/mission.h"

#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

Summary through_a_town(int searches, int cores = 4) {
  auto loaded = load_scenario(
      "delivery_city",
      {"governor.policy=fixed_fine", "kernels.mapper=flyball",
       "kernels.mapper_parameters.cost_of=octomap", "vehicle.physics_step_s=0.008",
       "planner.searches=" + std::to_string(searches), "platform.cores=" + std::to_string(cores)});
  FLYBALL_ASSERT(std::holds_alternative<LoadedScenario>(loaded), "%d searches", searches);
  auto record = fly(std::get<LoadedScenario>(loaded).scenario, {});
  FLYBALL_ASSERT(record.ok(), "%s", record.error().message.c_str());
  return record->summary;
}

TEST(PlanningRace, shortens_the_time_in_which_a_vehicle_waits_for_plans) {
  const Summary alone = through_a_town(1);
  const Summary raced = through_a_town(3);
  EXPECT_EQ(raced.status, MissionStatus::succeeded) << to_string(raced.failure);
  EXPECT_LT(raced.hover_time_s, 0.7 * alone.hover_time_s);
  EXPECT_EQ(through_a_town(3).trace_hash, raced.trace_hash);
}

}  // namespace
}  // namespace flyball
