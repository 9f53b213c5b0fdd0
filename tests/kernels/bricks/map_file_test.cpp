// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "bricks/map_file.h"

#include "flyball/kernels/kernels.h"
#include "flyball/kernels/mapper.h"
#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"

#include "scratch_folder.h"
#include "synthetic_scans.h"
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double range_m = 7.0;

std::unique_ptr<Mapper> make(const std::string& name,
                             const std::map<std::string, ParameterValue>& given = {}) {
  Registry registry;
  register_kernels(registry);
  auto mapper = registry.make<Mapper>(name);
  const auto chosen = Parameters::resolve("mapper", mapper->parameters(), given);
  EXPECT_TRUE(mapper->configure(std::get<Parameters>(chosen), no_models));
  return mapper;
}

std::unique_ptr<Mapper> exact() {
  return make("flyball", {{"front_end", std::string{"exact"}}});
}

void insert(Mapper& mapper, int frame, const Vec3& shift_W = Vec3::Zero()) {
  auto scan = kit::synthetic_scan(kit::Place::indoor, frame, range_m, 96);
  scan.cloud_C.camera.reset();
  scan.X_WC.translation() += shift_W;
  ASSERT_TRUE(mapper.prepare(scan.cloud_C, scan.X_WC, {0.15, range_m}).ok());
  mapper.commit();
}

TEST(MapFile, both_mappers_write_the_same_bytes_of_the_same_flight) {
  const ScratchFolder scratch;
  const auto bricks = exact();
  const auto stock = make("octomap");
  for (int frame = 0; frame < 6; ++frame) {
    insert(*bricks, frame);
    insert(*stock, frame);
  }
  ASSERT_TRUE(bricks->write(scratch.path("bricks.bt"), std::nullopt).ok());
  ASSERT_TRUE(stock->write(scratch.path("stock.bt"), std::nullopt).ok());
  EXPECT_GT(scratch.content("stock.bt").size(), 1000U);
  EXPECT_EQ(scratch.content("bricks.bt"), scratch.content("stock.bt"));
}

TEST(MapFile, a_map_that_was_read_is_the_one_that_was_written) {
  const ScratchFolder scratch;
  const auto from = exact();
  insert(*from, 0);
  insert(*from, 1);
  for (const char* file : {"map.bt", "map.ot"}) {
    ASSERT_TRUE(from->write(scratch.path(file), std::nullopt).ok());
    for (const char* name : {"flyball", "octomap"}) {
      const auto to = make(name);
      ASSERT_TRUE(to->read(scratch.path(file)).ok()) << name;
      const MapLevel sent = from->contents().levels.front();
      const MapLevel arrived = to->contents().levels.front();
      EXPECT_GT(sent.occupied_cells, 100U);
      EXPECT_EQ(arrived.known_cells, sent.known_cells) << name << " " << file;
      EXPECT_EQ(arrived.occupied_cells, sent.occupied_cells) << name << " " << file;
      for (double x_m = -2.0; x_m < 9.0; x_m += 0.17) {
        const Vec3 p_W{x_m, 0.31, 1.2};
        EXPECT_EQ(to->view().state(p_W), from->view().state(p_W)) << name << p_W.transpose();
      }
    }
  }
}

TEST(MapFile, mapping_goes_on_where_a_file_ended) {
  const ScratchFolder scratch;
  const auto whole = exact();
  insert(*whole, 0);
  ASSERT_TRUE(whole->write(scratch.path("half.ot"), std::nullopt).ok());
  const auto resumed = exact();
  ASSERT_TRUE(resumed->read(scratch.path("half.ot")).ok());
  for (int frame = 1; frame < 4; ++frame) {
    insert(*whole, frame);
    insert(*resumed, frame);
  }
  EXPECT_EQ(resumed->contents().levels[0].known_cells, whole->contents().levels[0].known_cells);
  EXPECT_EQ(resumed->contents().levels[0].occupied_cells,
            whole->contents().levels[0].occupied_cells);
}

TEST(MapFile, a_broken_one_leaves_the_map_as_it_was) {
  const ScratchFolder scratch;
  for (const char* name : {"flyball", "octomap"}) {
    const auto mapper = make(name);
    insert(*mapper, 0);
    const std::uint64_t known = mapper->contents().levels.front().known_cells;
    EXPECT_FALSE(mapper->read(scratch.file("broken.bt", "# Octomap OcTree binary file\n")).ok());
    EXPECT_FALSE(mapper->read(scratch.path("missing.bt")).ok());
    EXPECT_EQ(mapper->contents().levels.front().known_cells, known) << name;
  }
}

TEST(MapFile, that_claims_a_continent_in_two_bytes_is_refused) {
  const ScratchFolder scratch;
  const std::string path = scratch.file(
      "wide.bt", std::string{"# Octomap OcTree binary file\nid OcTree\nsize 2\nres 0.3\ndata\n"} +
                     std::string{"\x01\x00", 2});  // One of the root's children is free.
  for (const char* name : {"flyball", "octomap"}) {
    const auto mapper = make(name);
    insert(*mapper, 0);
    const std::uint64_t known = mapper->contents().levels.front().known_cells;
    const Status read = mapper->read(path);
    ASSERT_FALSE(read.ok()) << name;
    EXPECT_EQ(read.error().code, ErrorCode::invalid_input);
    EXPECT_NE(read.error().message.find("wide.bt"), std::string::npos) << read.error().message;
    EXPECT_NE(read.error().message.find("wider cells"), std::string::npos);
    EXPECT_EQ(mapper->contents().levels.front().known_cells, known) << name;
  }
}

TEST(MapFile, cells_of_a_file_are_those_of_a_level) {
  const ScratchFolder scratch;
  const auto mapper = exact();
  insert(*mapper, 0);
  for (const MapLevel& level : mapper->contents().levels) {
    const std::string path = scratch.path("level.bt");
    ASSERT_TRUE(mapper->write(path, level.cell_m).ok()) << level.cell_m;
    const auto read = make("octomap");
    ASSERT_TRUE(read->read(path).ok());
    const MapLevel arrived = read->contents().levels.front();
    EXPECT_DOUBLE_EQ(arrived.cell_m, level.cell_m);
    EXPECT_EQ(arrived.known_cells, level.known_cells);
    EXPECT_EQ(arrived.occupied_cells, level.occupied_cells);
  }
  EXPECT_FALSE(mapper->write(scratch.path("level.bt"), 0.4).ok());
  EXPECT_FALSE(make("octomap")->write(scratch.path("nothing.bt"), std::nullopt).ok());
}

TEST(MapFile, no_mutation_of_a_file_crashes_a_mapper) {
  const ScratchFolder scratch;
  const auto from = exact();
  insert(*from, 0);
  ASSERT_TRUE(from->write(scratch.path("map.bt"), 1.2).ok());
  const std::string content = scratch.content("map.bt");
  RandomStream random{3, "map_file_fuzz"};
  for (int i = 0; i < 300; ++i) {
    std::string mutant = content;
    mutant[random.next() % mutant.size()] = static_cast<char>(random.next());
    const auto mapper = make("flyball");
    if (mapper->read(scratch.file("mutant.bt", mutant)).ok()) {
      EXPECT_EQ(mapper->view().state({1e9, 0.0, 0.0}), CellState::unknown);
    }
  }
}

TEST(MapFile, what_is_far_is_forgotten_when_a_radius_is_set) {
  const auto all = make("flyball");
  const auto near = make("flyball", {{"keep_radius_m", 20.0}});
  for (int frame = 0; frame < 40; ++frame) {
    for (Mapper* mapper : {all.get(), near.get()}) {
      insert(*mapper, frame % 4, Vec3{5.0 * frame, 0.0, 0.0});
    }
  }
  const MapContents kept = near->contents();
  const MapContents whole = all->contents();
  EXPECT_LT(kept.bytes, whole.bytes / 2);
  EXPECT_LT(kept.levels[0].known_cells, whole.levels[0].known_cells / 2);
  int same = 0;
  for (double x_m = 180.0; x_m < 204.0; x_m += 0.2) {  // around the last frames
    const Vec3 p_W{x_m, 0.3, 1.2};
    EXPECT_EQ(near->view().state(p_W), all->view().state(p_W)) << x_m;
    same += all->view().state(p_W) != CellState::unknown ? 1 : 0;
  }
  EXPECT_GT(same, 50);
  EXPECT_EQ(near->view().state({2.0, 0.3, 1.2}), CellState::unknown) << "was free";
  EXPECT_EQ(all->view().state({2.0, 0.3, 1.2}), CellState::free);
}

}  // namespace
}  // namespace flyball
