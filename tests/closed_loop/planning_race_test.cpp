// SPDX-License-Identifier: BSD-3-Clause
//
// Searches that race each other on idle cores, in a whole flight.

#include "flyball/scenario/scenario.h"
#include "flyball/simulation/mission.h"

#include <string>

#include <gtest/gtest.h>

namespace flyball {
namespace {

Summary through_a_town(int searches) {
  auto loaded = load_scenario(
      "delivery_city", {"governor.policy=fixed_fine", "kernels.mapper=flyball",
                        "kernels.mapper_parameters.cost_of=octomap", "vehicle.physics_step_s=0.008",
                        "planner.searches=" + std::to_string(searches)});
  FLYBALL_ASSERT(std::holds_alternative<LoadedScenario>(loaded), "%d searches", searches);
  auto record = fly(std::get<LoadedScenario>(loaded).scenario, {});
  FLYBALL_ASSERT(record.ok(), "%s", record.error().message.c_str());
  return record->summary;
}

TEST(PlanningRace, flies_through_a_town_and_repeats_itself) {
  const Summary raced = through_a_town(2);
  EXPECT_EQ(raced.status, MissionStatus::succeeded) << to_string(raced.failure);
  EXPECT_EQ(through_a_town(2).trace_hash, raced.trace_hash);
}

}  // namespace
}  // namespace flyball
