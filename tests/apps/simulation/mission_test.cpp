// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/simulation/mission.h"

#include "flyball/kernels/mapper.h"

#include "records/knob_history.h"
#include "scratch_folder.h"
#include "short_delivery.h"
#include <filesystem>
#include <string_view>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// The field's value in the last row of the flight's state.
double last_of(const MemoryRecorder& trace, std::string_view name) {
  double last = 0.0;
  for (const MemoryRecorder::Row& row : trace.rows()) {
    for (const Field& field : row.fields) {
      if (row.channel == "state" && field.name == name) {
        last = std::get<double>(field.value);
      }
    }
  }
  return last;
}

TEST(Mission, ends_as_time_limit_when_the_time_is_over) {
  Scenario scenario = kit::short_delivery(200.0);
  scenario.mission.time_limit_s = 3.0;
  const Summary summary = kit::flown(scenario).summary;
  EXPECT_EQ(summary.status, MissionStatus::failed);
  EXPECT_EQ(summary.failure, MissionFailure::time_limit);
  EXPECT_NEAR(summary.mission_time_s, 3.0, 0.02);
}

TEST(Mission, ends_as_battery_empty_when_the_battery_is) {
  Scenario scenario = kit::short_delivery(200.0);
  scenario.vehicle.battery_charge = 0.012;
  const Summary summary = kit::flown(scenario).summary;
  EXPECT_EQ(summary.failure, MissionFailure::battery_empty);
  EXPECT_LT(summary.battery_end_percent, 1.2);
}

TEST(Mission, is_interrupted_when_asked_to_stop) {
  int asked = 0;
  MissionHooks hooks;
  hooks.stop = [&] { return ++asked > 2000; };
  const auto record = fly(kit::short_delivery(), hooks);
  ASSERT_TRUE(record.ok());
  EXPECT_EQ(record->summary.status, MissionStatus::interrupted);
}

TEST(Mission, says_once_that_it_is_over_before_its_map_is_written) {
  const ScratchFolder folder;
  int told = 0;
  MissionHooks hooks;
  hooks.final_map = folder.path("map.bt");
  hooks.over = [&] {
    ++told;
    EXPECT_FALSE(std::filesystem::exists(hooks.final_map));
  };
  const auto record = fly(kit::short_delivery(), hooks);
  ASSERT_TRUE(record.ok());
  EXPECT_EQ(told, 1);
  EXPECT_TRUE(std::filesystem::exists(hooks.final_map));
}

TEST(Mission, a_start_map_whose_cells_are_not_the_missions_is_refused) {
  const ScratchFolder folder;
  MissionHooks hooks;
  hooks.start_map = folder.path("start.bt");
  hooks.stop = [] { return true; };
  Scenario scenario = kit::short_delivery();
  scenario.kernels.mapper = "flyball";
  const auto fly_from_cells_of = [&](double cell_m) {
    const auto mapper = Plugins{}.make<Mapper>("flyball");
    PointCloud cloud;
    cloud.hits_C = {{0.0F, 0.0F, 3.0F}};
    EXPECT_TRUE(mapper->prepare(cloud, Pose::Identity(), {cell_m, 5.0}));
    mapper->commit();
    EXPECT_TRUE(mapper->write(hooks.start_map, cell_m));
    return fly(scenario, hooks);
  };
  EXPECT_TRUE(fly_from_cells_of(0.15).ok());
  const auto refused = fly_from_cells_of(0.1);
  ASSERT_FALSE(refused.ok());
  const std::string& why = refused.error().message;
  EXPECT_NE(why.find("has cells of 0.1, 0.2, 0.4, 0.8 m"), std::string::npos) << why;
  EXPECT_NE(why.find("kernels.mapper_parameters.finest_m to 0.1"), std::string::npos) << why;
  scenario.kernels.mapper_parameters = {{"finest_m", 0.1}};
  scenario.map.resolution_m = 0.4;
  EXPECT_TRUE(fly(scenario, hooks).ok()) << "the way out that it names";
}

TEST(Mission, the_record_tells_how_the_knobs_stood_from_start_to_end) {
  Scenario scenario = kit::short_delivery();
  scenario.governor.policy = "mission_energy";
  const MissionRecord record = kit::flown(scenario);
  const auto knobs = knobs_json(record);
  ASSERT_FALSE(knobs.empty());
  EXPECT_EQ(knobs[0]["name"], "map.resolution_m");
  EXPECT_EQ(knobs[0]["v"].front(), scenario.map.resolution_m);
  EXPECT_EQ(knobs[0]["v"].back(), last_of(*record.trace, "resolution_m"));
  std::uint64_t changes = 0;
  for (const auto& knob : knobs) {
    changes += knob["changes"].get<std::uint64_t>();
  }
  EXPECT_GT(changes, 0U);
  EXPECT_LE(changes, record.summary.knob_changes) << "what changes at one moment counts once";
}

TEST(Mission, an_unknown_workload_is_an_error_with_the_way_out) {
  Scenario scenario;
  scenario.mission.workload = "laundry";
  const auto record = fly(scenario, {});
  ASSERT_FALSE(record.ok());
  EXPECT_NE(record.error().message.find("flyball list workloads"), std::string::npos);
}

TEST(Mission, graph_is_described_as_text_and_for_graphviz) {
  const auto text = describe_graph(Scenario{}, false);
  const auto dot = describe_graph(Scenario{}, true);
  ASSERT_TRUE(text.ok() && dot.ok());
  for (const char* node : {"points", "map", "check", "plan", "smooth", "follow", "mission"}) {
    EXPECT_NE(text->find(node), std::string::npos) << node;
    EXPECT_NE(dot->find(node), std::string::npos) << node;
  }
  EXPECT_EQ(dot->rfind("digraph", 0), 0U);
}

}  // namespace
}  // namespace flyball
