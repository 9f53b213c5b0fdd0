// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "bricks/chunk_log.h"

#include "flyball/kernels/kernels.h"
#include "flyball/kernels/mapper.h"
#include "flyball/runtime/registry.h"

#include "scratch_folder.h"
#include "synthetic_scans.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double range_m = 7.0;
const Vec3 near_the_start_W{2.0, 0.3, 1.2};

std::unique_ptr<Mapper> make(const std::map<std::string, ParameterValue>& given = {}) {
  Registry registry;
  register_kernels(registry);
  auto mapper = registry.make<Mapper>("flyball");
  const auto chosen = Parameters::resolve("mapper", mapper->parameters(), given);
  EXPECT_TRUE(mapper->configure(std::get<Parameters>(chosen), no_models));
  return mapper;
}

/// Corridors, one after the other.
void fly_on(Mapper& mapper, int first_m, int last_m) {
  const int step_m = first_m < last_m ? 5 : -5;
  for (int x_m = first_m; x_m != last_m; x_m += step_m) {
    auto scan = kit::synthetic_scan(kit::Place::indoor, x_m / 5 % 4, range_m, 96);
    scan.X_WC.translation().x() += x_m;
    ASSERT_TRUE(mapper.prepare(scan.cloud_C, scan.X_WC, {0.15, range_m}).ok());
    mapper.commit();
  }
}

TEST(ChunkLog, has_what_was_forgotten_when_the_map_is_written) {
  const ScratchFolder scratch;
  const auto all = make();
  const auto near = make({{"keep_radius_m", 20.0}});
  ASSERT_TRUE(near->keep_forgotten(scratch.path("log")).ok());
  fly_on(*all, 0, 80);
  fly_on(*near, 0, 80);
  EXPECT_EQ(near->view().state(near_the_start_W), CellState::unknown);
  EXPECT_EQ(all->view().state(near_the_start_W), CellState::free);
  ASSERT_TRUE(all->write(scratch.path("all.ot"), std::nullopt).ok());
  ASSERT_TRUE(near->write(scratch.path("near.ot"), std::nullopt).ok());
  EXPECT_GT(scratch.content("all.ot").size(), 10000U);
  EXPECT_EQ(scratch.content("near.ot"), scratch.content("all.ot"));
  ASSERT_TRUE(all->write(scratch.path("all.bt"), 0.60).ok());
  ASSERT_TRUE(near->write(scratch.path("near.bt"), 0.60).ok());
  EXPECT_EQ(scratch.content("near.bt"), scratch.content("all.bt"));
}

TEST(ChunkLog, adds_up_what_was_seen_on_two_visits) {
  const ScratchFolder scratch;
  const auto all = make();
  const auto near = make({{"keep_radius_m", 20.0}});
  ASSERT_TRUE(near->keep_forgotten(scratch.path("log")).ok());
  for (Mapper* mapper : {all.get(), near.get()}) {
    fly_on(*mapper, 0, 60);
    fly_on(*mapper, 60, 0);
    ASSERT_TRUE(mapper->write(scratch.path("map.ot"), std::nullopt).ok());
    ASSERT_TRUE(mapper->read(scratch.path("map.ot")).ok());
  }
  const MapLevel found = near->contents().levels[0];
  const MapLevel expected = all->contents().levels[0];
  EXPECT_EQ(found.known_cells, expected.known_cells);
  EXPECT_NEAR(static_cast<double>(found.occupied_cells),
              static_cast<double>(expected.occupied_cells),
              0.02 * static_cast<double>(expected.occupied_cells));  // clamps do not add up
}

TEST(ChunkLog, does_not_bring_back_what_was_doubted) {
  const ScratchFolder scratch;
  const auto near = make({{"keep_radius_m", 20.0}});
  ASSERT_TRUE(near->keep_forgotten(scratch.path("log")).ok());
  fly_on(*near, 0, 60);
  fly_on(*near, 60,
         0);  // All was forgotten and seen again; then the vehicle stands where it began.
  near->doubt_obstacles({0.0, 0.0, 1.0}, 100.0);
  ASSERT_TRUE(near->write(scratch.path("map.ot"), std::nullopt).ok());
  const auto later = make();
  ASSERT_TRUE(later->read(scratch.path("map.ot")).ok());
  EXPECT_EQ(later->contents().levels[0].occupied_cells, 0U);
  EXPECT_GT(later->contents().levels[0].known_cells, 1000U);
  // What is seen after that counts.
  fly_on(*near, 0, 60);
  ASSERT_TRUE(near->write(scratch.path("map.ot"), std::nullopt).ok());
  ASSERT_TRUE(later->read(scratch.path("map.ot")).ok());
  EXPECT_GT(later->contents().levels[0].occupied_cells, 1000U);
}

TEST(ChunkLog, is_gone_with_its_mapper) {
  const ScratchFolder scratch;
  {
    const auto near = make({{"keep_radius_m", 20.0}});
    ASSERT_TRUE(near->keep_forgotten(scratch.path("log")).ok());
    EXPECT_FALSE(scratch.is_empty());
  }
  EXPECT_TRUE(scratch.is_empty());
  ASSERT_TRUE(make()->keep_forgotten(scratch.path("log")).ok());
  EXPECT_TRUE(scratch.is_empty()) << "nothing is ever forgotten";
}

TEST(ChunkLog, says_what_went_wrong_and_leaves_no_map) {
  const ScratchFolder scratch;
  const auto near = make({{"keep_radius_m", 20.0}});
  const Status refused = near->keep_forgotten(scratch.path("no_folder/log"));
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("no_folder"), std::string::npos);
  ASSERT_TRUE(near->keep_forgotten(scratch.path("log")).ok());
  fly_on(*near, 0, 60);
  std::filesystem::remove(scratch.path("log"));
  const Status written = near->write(scratch.path("map.bt"), std::nullopt);
  ASSERT_FALSE(written.ok());
  EXPECT_NE(written.error().message.find("log"), std::string::npos);
  EXPECT_TRUE(scratch.is_empty());
}

}  // namespace
}  // namespace flyball
