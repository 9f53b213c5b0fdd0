// SPDX-License-Identifier: BSD-3-Clause
//
// A mission whose map changes its resolution every 5 s.

#include "flyball/kernels/mapper.h"
#include "flyball/runtime/registry.h"
#include "flyball/scenario/plugins.h"

#include "scratch_folder.h"
#include "short_delivery.h"
#include <cmath>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Cells = std::set<std::tuple<long, long, long>>;

Scenario among_trees() {
  Scenario scenario = kit::short_delivery();
  scenario.world.generator = "forest";
  scenario.world.parameters = {{"goal_distance_m", 30.0}};
  scenario.governor.policy = "cycle";  // .15 and .60 m in turns, 5 s each
  scenario.kernels.mapper = "flyball";
  scenario.kernels.mapper_parameters = {{"cost_of", std::string{"octomap"}}};
  scenario.mission.time_limit_s = 300.0;
  return scenario;
}

Scenario in_rooms() {
  Scenario scenario = among_trees();
  scenario.world.generator = "office";
  scenario.world.parameters = {};
  scenario.mission.workload = "mapping";  // A delivery there would land where it starts.
  return scenario;
}

/// The keys of occupied cells.
Cells finest_cells(const Mapper& mapper) {
  Cells cells;
  for (const OccupiedCell& cell : mapper.occupied()) {
    const Eigen::Array3d key = (cell.centre_W.array() / cell.size_m).floor();
    cells.emplace(std::lround(key.x()), std::lround(key.y()), std::lround(key.z()));
  }
  return cells;
}

/// The finest cells that are occupied when the mission has lasted so long.
Cells occupied_after(const Scenario& scenario, double time_s) {
  const ScratchFolder scratch;
  double now_s = 0.0;
  MissionHooks hooks;
  hooks.progress = [&now_s](double mission_s, const std::string&) { now_s = mission_s; };
  hooks.stop = [&] { return now_s >= time_s; };
  hooks.final_map = scratch.path("map.bt");
  const auto record = fly(scenario, hooks);
  EXPECT_TRUE(record.ok());
  const auto mapper = Plugins{}.make<Mapper>("flyball");
  EXPECT_TRUE(mapper->read(hooks.final_map).ok());
  return finest_cells(*mapper);
}

TEST(LevelChanges, every_5_s_cost_no_collision) {
  const Summary summary = kit::flown(among_trees()).summary;
  EXPECT_NE(summary.failure, MissionFailure::collision);
  EXPECT_GT(summary.min_clearance_m, 0.0);
  EXPECT_GT(summary.knob_changes, 3U);
}

TEST(LevelChanges, keep_what_was_seen_at_the_finest_level) {
  for (const Scenario& scenario : {among_trees(), in_rooms()}) {
    const Cells before = occupied_after(scenario, 10.0);  // fine, coarse
    const Cells after = occupied_after(scenario, 20.0);   // and both once more
    std::size_t kept = 0;
    for (const auto& cell : before) {
      kept += after.count(cell);
    }
    ASSERT_GT(before.size(), 200U);
    EXPECT_GE(static_cast<double>(kept), 0.98 * static_cast<double>(before.size()))
        << scenario.world.generator;
  }
}

/// At the end of a fine period: cells that are occupied in a map of the same scans that always was
/// fine, how many of them the mission's map has, and how many others it has.
struct FinePeriod {
  std::size_t expected{};
  std::size_t kept{};
  std::size_t added{};
};

/// Mapper flyball, and beside it one that takes the same scans at .15 m.
class Accompanied final : public Mapper {
 public:
  /// @param periods  Outlives this; each fine period that has ended is added to it.
  explicit Accompanied(std::vector<FinePeriod>& periods)
      : periods_{periods},
        flown_{Plugins{}.make<Mapper>("flyball")},
        fine_{Plugins{}.make<Mapper>("flyball")} {}
  [[nodiscard]] std::vector<ParameterSpec> parameters() const override {
    return flown_->parameters();
  }
  Status configure(const Parameters& chosen, const FindModel& find_model) override {
    const Status flown = flown_->configure(chosen, find_model);
    return flown ? fine_->configure(chosen, find_model) : flown;
  }
  [[nodiscard]] std::vector<double> resolutions_m() const override {
    return flown_->resolutions_m();
  }
  Result<Work> prepare(const PointCloud& cloud_C,
                       const Pose& X_WC,
                       const MapperSettings& settings) override {
    const bool is_fine = settings.resolution_m < 0.2;
    if (was_fine_ && !is_fine) {
      compare();
    }
    was_fine_ = is_fine;
    EXPECT_TRUE(fine_->prepare(cloud_C, X_WC, {0.15, settings.range_m}).ok());
    return flown_->prepare(cloud_C, X_WC, settings);
  }
  void commit() override {
    flown_->commit();
    fine_->commit();
  }
  void declare_clear(const Vec3& centre_W, const Cylinder& space) override {
    flown_->declare_clear(centre_W, space);
  }
  [[nodiscard]] const OccupancyView& view() const override { return flown_->view(); }
  [[nodiscard]] std::shared_ptr<const OccupancyView> revision() override {
    return flown_->revision();
  }
  [[nodiscard]] std::vector<OccupiedCell> occupied() const override { return flown_->occupied(); }

 private:
  void compare() const {
    const Cells expected = finest_cells(*fine_);
    const Cells found = finest_cells(*flown_);
    std::size_t kept = 0;
    for (const auto& cell : expected) {
      kept += found.count(cell);
    }
    periods_.push_back({expected.size(), kept, found.size() - kept});
  }

  std::vector<FinePeriod>& periods_;
  std::unique_ptr<Mapper> flown_;
  std::unique_ptr<Mapper> fine_;
  bool was_fine_{};
};

TEST(LevelChanges, every_5_s_keep_and_inflate_nothing_beside_a_map_that_is_always_fine) {
  for (Scenario scenario : {among_trees(), in_rooms()}) {
    std::vector<FinePeriod> periods;
    scenario.plugins = Plugins{}.with([&periods](Registry& registry) {
      registry.add<Mapper>("accompanied",
                           [&periods] { return std::make_unique<Accompanied>(periods); });
    });
    scenario.kernels.mapper = "accompanied";
    scenario.mission.time_limit_s = 60.0;
    (void)kit::flown(scenario);
    ASSERT_GE(periods.size(), 3U) << scenario.world.generator;
    for (const FinePeriod& period : periods) {
      const auto expected = static_cast<double>(period.expected);
      EXPECT_GE(static_cast<double>(period.kept), 0.98 * expected) << scenario.world.generator;
      EXPECT_LT(static_cast<double>(period.added), 0.02 * expected) << scenario.world.generator;
    }
  }
}

/// Of a flight with this mapper at the price of stock OctoMap.
std::string trace_hash(const std::string& mapper, std::map<std::string, ParameterValue> chosen) {
  Scenario scenario = among_trees();
  scenario.world.parameters["goal_distance_m"] = 20.0;
  scenario.kernels.mapper = mapper;
  scenario.kernels.mapper_parameters = std::move(chosen);
  return kit::flown(scenario).summary.trace_hash;
}

TEST(LevelChanges, give_the_stock_kernels_flight_where_each_resolution_has_its_layer) {
  const ParameterValue stock{std::string{"stock"}};
  const ParameterValue octomap{std::string{"octomap"}};
  EXPECT_EQ(trace_hash("flyball", {{"layers", stock}, {"cost_of", octomap}}),
            trace_hash("octomap", {}));
}

}  // namespace
}  // namespace flyball
