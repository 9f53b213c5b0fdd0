// SPDX-License-Identifier: BSD-3-Clause
//
// A mission whose map forgets what is far: the file that it leaves has it all the same.

#include "flyball/kernels/mapper.h"
#include "flyball/scenario/plugins.h"

#include "scratch_folder.h"
#include "short_delivery.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// The map's file of a flight that is stopped far from its start, as a mapper has it.
std::unique_ptr<Mapper> map_left_by(const Scenario& scenario) {
  const ScratchFolder scratch;
  double now_s = 0.0;
  MissionHooks hooks;
  hooks.progress = [&now_s](double mission_s, const std::string&) { now_s = mission_s; };
  hooks.stop = [&] { return now_s >= 15.0; };
  hooks.final_map = scratch.path("map.bt");
  const auto record = fly(scenario, hooks);
  EXPECT_TRUE(record.ok());
  auto mapper = Plugins{}.make<Mapper>("flyball");
  EXPECT_TRUE(mapper->read(hooks.final_map).ok());
  return mapper;
}

TEST(ForgottenMap, is_in_the_file_that_the_flight_leaves) {
  Scenario scenario = kit::short_delivery(60.0);
  scenario.kernels.mapper = "flyball";
  scenario.governor.policy = "fixed_fine";
  scenario.map.resolution_m = 0.15;
  const auto all = map_left_by(scenario);
  scenario.kernels.mapper_parameters = {{"keep_radius_m", 8.0}};
  const auto near = map_left_by(scenario);
  EXPECT_GT(all->contents().levels[0].known_cells, 100000U);
  // A governor that does not see the far places any more decides a little differently.
  EXPECT_NEAR(static_cast<double>(near->contents().levels[0].known_cells),
              static_cast<double>(all->contents().levels[0].known_cells),
              0.01 * static_cast<double>(all->contents().levels[0].known_cells));
}

}  // namespace
}  // namespace flyball
