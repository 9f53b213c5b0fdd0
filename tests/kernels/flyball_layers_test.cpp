// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/mapper.h"

#include "made_mapper.h"
#include "scratch_folder.h"
#include "synthetic_scans.h"
#include "wall_scan.h"
#include <array>
#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr Cylinder body{0.35, 0.15};
constexpr double range_m = 7.0;

std::unique_ptr<Mapper> make_layers() {
  return kit::made_mapper("flyball", {{"layers", std::string{"stock"}}});
}

Work insert_scan(Mapper& mapper, kit::Place place, int frame, double resolution_m) {
  return kit::insert_scan(mapper, place, frame, resolution_m, range_m);
}

class Places {
 public:
  Vec3 point() { return {random(-3.0, 9.0), random(-5.0, 5.0), random(-0.5, 5.0)}; }
  Vec3 step() { return {random(-2.0, 2.0), random(-2.0, 2.0), random(-1.0, 1.0)}; }

 private:
  double random(double low, double high) {
    return std::uniform_real_distribution<double>{low, high}(generator_);
  }
  std::mt19937 generator_{1};
};

void expect_same_answers(const OccupancyView& view, const OccupancyView& expected) {
  EXPECT_EQ(view.resolution_m(), expected.resolution_m());
  Places places;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = places.point();
    ASSERT_EQ(view.state(p), expected.state(p)) << p.transpose();
    if (i % 20 == 0) {
      const Vec3 to = p + places.step();
      ASSERT_EQ(view.body_state(p, body), expected.body_state(p, body)) << p.transpose();
      ASSERT_EQ(view.segment_hits(p, to, body), expected.segment_hits(p, to, body));
      ASSERT_EQ(view.obstacle_density(p, 5.0, 1.0), expected.obstacle_density(p, 5.0, 1.0));
      ASSERT_NEAR(view.nearest_obstacle_m(p, 5.0, 1.0), expected.nearest_obstacle_m(p, 5.0, 1.0),
                  1e-9);
    }
  }
}

TEST(FlyballLayers, answer_and_count_as_stock_does_while_the_resolution_changes) {
  constexpr std::array<double, 6> resolutions_m{0.15, 0.60, 0.60, 0.80, 0.15, 0.30};
  for (const auto place : {kit::Place::indoor, kit::Place::outdoor}) {
    const auto stock = kit::made_mapper("octomap");
    const auto layers = make_layers();
    stock->declare_clear({0.0, 0.0, 1.0}, {1.0, 1.0});
    layers->declare_clear({0.0, 0.0, 1.0}, {1.0, 1.0});
    for (int frame = 0; frame < 12; ++frame) {
      const double resolution_m = resolutions_m[static_cast<std::size_t>(frame) / 2];
      const Work expected = insert_scan(*stock, place, frame, resolution_m);
      const Work work = insert_scan(*layers, place, frame, resolution_m);
      for (const char* name : {"frame", "rays", "traversals", "updates"}) {
        EXPECT_EQ(work.count(name), expected.count(name)) << name;
      }
      if (frame % 2 == 1) {
        expect_same_answers(layers->view(), stock->view());
      }
    }
  }
}

TEST(FlyballLayers, are_forgotten_beyond_sixteen_that_were_used_later) {
  for (const bool is_octomap : {false, true}) {
    const auto mapper = is_octomap ? kit::made_mapper("octomap") : make_layers();
    for (int i = 0; i < 4; ++i) {
      kit::insert(*mapper, kit::wall_scan(5.0F), {0.5, range_m});  // A wall beyond doubt.
    }
    const Vec3 wall_W{5.01, 0.1, 0.1};
    const Vec3 before_W{4.2, 0.1, 0.1};
    const auto revision = mapper->revision();
    ASSERT_EQ(mapper->view().state(wall_W), CellState::occupied);
    for (int i = 0; i < 40; ++i) {
      kit::insert(*mapper, kit::wall_scan(1.0F), {0.51 + 0.01 * i, range_m});
      EXPECT_EQ(mapper->view().resolution_m(), 0.51 + 0.01 * i);
    }
    EXPECT_EQ(mapper->contents().levels.size(), 16U);
    EXPECT_EQ(mapper->view().state(wall_W), CellState::unknown);
    EXPECT_EQ(mapper->view().state(before_W), CellState::unknown);
    EXPECT_EQ(revision->state(wall_W), CellState::occupied) << "revisions keep their answers";
    kit::insert(*mapper, kit::wall_scan(1.0F), {0.75, range_m});  // The one that is next to go.
    kit::insert(*mapper, kit::wall_scan(1.0F), {2.0, range_m});
    EXPECT_NEAR(mapper->contents().levels.front().cell_m, 0.75, 1e-9) << "it was used again";
  }
}

TEST(FlyballLayers, come_back_from_a_file) {
  const ScratchFolder folder;
  const std::string path = folder.path("map.ot");
  const auto layers = make_layers();
  for (int frame = 0; frame < 4; ++frame) {
    insert_scan(*layers, kit::Place::indoor, frame, 0.60);
  }
  ASSERT_TRUE(layers->write(path, 0.60).ok());
  EXPECT_FALSE(layers->write(path, 0.15).ok());  // nothing was mapped at it
  const auto again = make_layers();
  ASSERT_TRUE(again->read(path).ok());
  EXPECT_EQ(again->view().resolution_m(), 0.60);
  EXPECT_EQ(again->contents().levels.front().known_cells,
            layers->contents().levels.front().known_cells);
  Places places;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = places.point();
    ASSERT_EQ(again->view().state(p) == CellState::unknown,
              layers->view().state(p) == CellState::unknown);
  }
}

TEST(FlyballLayers, refuse_what_only_one_lattice_can_do) {
  for (const std::string name : {"keep_radius_m", "most_traversals"}) {
    Registry registry;
    register_kernels(registry);
    const auto mapper = registry.make<Mapper>("flyball");
    const auto chosen = Parameters::resolve("flyball", mapper->parameters(),
                                            {{"layers", std::string{"stock"}}, {name, 40.0}});
    const Status configured = mapper->configure(std::get<Parameters>(chosen), no_models);
    ASSERT_FALSE(configured.ok());
    EXPECT_NE(configured.error().message.find(name), std::string::npos)
        << configured.error().message;
  }
}

}  // namespace
}  // namespace flyball
