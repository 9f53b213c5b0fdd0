// SPDX-License-Identifier: BSD-3-Clause
// compiled-alone
#include "flyball/kernels/mapper.h"

#include "made_mapper.h"
#include "synthetic_scans.h"
#include "wall_scan.h"
#include <algorithm>
#include <array>
#include <memory>
#include <set>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using kit::insert;
using kit::looking_along_x;
using kit::wall_scan;

constexpr Cylinder body{0.35, 0.15};
constexpr double range_m = 7.0;
constexpr std::array<double, 4> lattice_m{0.15, 0.30, 0.60, 1.20};

Work insert_scan(Mapper& mapper, kit::Place place, int frame, double resolution_m) {
  return kit::insert_scan(mapper, place, frame, resolution_m, range_m);
}

TEST(Flyball, refuses_an_image_without_a_depth_for_each_pixel) {
  kit::expect_image_without_all_depths_refused(*kit::made_mapper("flyball"));
}

TEST(Flyball, offers_no_range_that_it_refuses) {
  for (const double finest_m : {0.03, 0.15}) {
    const auto mapper = kit::made_mapper("flyball", {{"finest_m", finest_m}});
    for (const KnobSpec& spec : mapper->knobs()) {
      if (spec.name == "map.range_m") {
        EXPECT_NEAR(spec.max, std::min(25.0, 250.0 * finest_m), 1e-9);
        EXPECT_LE(spec.fallback, spec.max);
        EXPECT_TRUE(mapper->prepare({}, looking_along_x(), {finest_m, spec.max}).ok());
      }
    }
  }
}

TEST(Flyball, reaches_as_far_as_the_cells_allow_that_an_empty_map_begins_with) {
  const auto mapper = kit::made_mapper("flyball");
  Pose X_WC = looking_along_x();
  X_WC.translation().x() = 6000.0;  // Beyond 32768 cells of 0.15 m, but not of 0.5 m.
  const auto prepared = mapper->prepare(wall_scan(3.0F), X_WC, {0.5, 100.0});
  EXPECT_TRUE(prepared.ok()) << prepared.error().message;
  EXPECT_FALSE(mapper->prepare(wall_scan(3.0F), looking_along_x(), {0.5, 126.0}).ok());
  EXPECT_EQ(mapper->longest_range_m(0.5), 125.0);
}

TEST(Flyball, shows_a_scan_only_after_commit) {
  const auto mapper = kit::made_mapper("flyball");
  ASSERT_TRUE(mapper->prepare(wall_scan(3.0F), looking_along_x(), {0.15, range_m}).ok());
  EXPECT_EQ(mapper->view().state({3.01, 0.01, 0.01}), CellState::unknown);
  EXPECT_TRUE(mapper->occupied().empty());
  mapper->commit();
  EXPECT_EQ(mapper->view().state({3.01, 0.01, 0.01}), CellState::occupied);
  EXPECT_EQ(mapper->view().state({1.5, 0.0, 0.0}), CellState::free);
  EXPECT_EQ(mapper->view().state({3.4, 0.0, 0.0}), CellState::unknown);
  EXPECT_EQ(mapper->view().body_state({2.0, 0.0, 0.0}, {0.3, 0.15}), CellState::free);
  EXPECT_EQ(mapper->view().body_state({2.8, 0.0, 0.0}, body), CellState::occupied);
}

TEST(Flyball, replaces_a_change_that_was_not_committed) {
  const auto mapper = kit::made_mapper("flyball");
  ASSERT_TRUE(mapper->prepare(wall_scan(3.0F), looking_along_x(), {0.15, range_m}).ok());
  ASSERT_TRUE(mapper->prepare(wall_scan(5.0F), looking_along_x(), {0.15, range_m}).ok());
  mapper->commit();
  mapper->commit();
  EXPECT_EQ(mapper->view().state({3.01, 0.01, 0.01}), CellState::free);
  EXPECT_EQ(mapper->view().state({5.01, 0.01, 0.01}), CellState::occupied);
}

TEST(Flyball, frees_returns_beyond_the_range_up_to_it_and_marks_nothing) {
  const auto mapper = kit::made_mapper("flyball");
  insert(*mapper, wall_scan(5.0F), {0.15, 4.0});
  EXPECT_EQ(mapper->view().state({3.7, 0.0, 0.0}), CellState::free);
  EXPECT_EQ(mapper->view().state({4.2, 0.0, 0.0}), CellState::unknown);
  EXPECT_TRUE(mapper->occupied().empty());
}

TEST(Flyball, rejects_bad_input_and_prepares_nothing) {
  kit::expect_bad_input_refused(*kit::made_mapper("flyball"));
}

TEST(Flyball, begins_its_lattice_with_the_first_resolution_and_keeps_to_it) {
  const auto mapper = kit::made_mapper("flyball");
  insert(*mapper, wall_scan(3.0F), {0.80, range_m});
  EXPECT_EQ(mapper->view().resolution_m(), 0.80);
  insert(*mapper, wall_scan(3.0F), {1.60, range_m});
  EXPECT_EQ(mapper->view().resolution_m(), 1.60);
  const auto work = mapper->prepare(wall_scan(3.0F), looking_along_x(), {0.15, range_m});
  ASSERT_FALSE(work.ok());
  EXPECT_NE(work.error().message.find("0.8"), std::string::npos);
}

TEST(Flyball, keeps_the_old_level_until_the_change_is_committed) {
  const auto mapper = kit::made_mapper("flyball");
  insert(*mapper, wall_scan(5.0F), {0.15, range_m});
  ASSERT_TRUE(mapper->prepare(wall_scan(5.0F), looking_along_x(), {0.60, range_m}).ok());
  EXPECT_EQ(mapper->view().resolution_m(), 0.15);
  mapper->commit();
  EXPECT_EQ(mapper->view().resolution_m(), 0.60);
  // The wall's coarse cell begins at 4.8 m.
  EXPECT_EQ(mapper->view().state({4.85, 0.01, 0.01}), CellState::occupied);
  EXPECT_EQ(mapper->view().state({4.75, 0.01, 0.01}), CellState::free);
}

TEST(Flyball, reports_stock_work_exactly_at_every_level) {
  for (const auto place : {kit::Place::indoor, kit::Place::outdoor}) {
    const auto stock = kit::made_mapper("octomap");
    const auto fast = kit::made_mapper("flyball", {{"cost_of", std::string{"octomap"}}});
    for (int frame = 0; frame < 6; ++frame) {
      const double resolution_m = lattice_m[static_cast<std::size_t>(frame) % 4];
      const Work expected = insert_scan(*stock, place, frame, resolution_m);
      const Work reported = insert_scan(*fast, place, frame, resolution_m);
      for (const char* name : {"frame", "rays", "traversals", "updates"}) {
        EXPECT_EQ(reported.count(name), expected.count(name)) << name;
      }
      EXPECT_EQ(reported.items().size(), expected.items().size());
    }
  }
}

TEST(Flyball, maps_the_same_whoever_pays) {
  const auto own = kit::made_mapper("flyball");
  const auto stock = kit::made_mapper("flyball", {{"cost_of", std::string{"octomap"}}});
  for (int frame = 0; frame < 4; ++frame) {
    const double resolution_m = lattice_m[static_cast<std::size_t>(frame) % 2];
    insert_scan(*own, kit::Place::indoor, frame, resolution_m);
    insert_scan(*stock, kit::Place::indoor, frame, resolution_m);
  }
  const auto a = own->occupied();
  const auto b = stock->occupied();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].centre_W, b[i].centre_W);
  }
}

TEST(Flyball, answers_as_stock_does_at_one_resolution) {
  for (const auto place : {kit::Place::indoor, kit::Place::outdoor}) {
    for (const double resolution_m : {0.15, 0.20}) {
      const auto stock = kit::made_mapper("octomap");
      const auto fast = kit::made_mapper("flyball", {{"front_end", std::string{"exact"}}});
      for (int frame = 0; frame < 8; ++frame) {
        insert_scan(*stock, place, frame, resolution_m);
        insert_scan(*fast, place, frame, resolution_m);
      }
      const OccupancyView& expected = stock->view();
      const OccupancyView& view = fast->view();
      std::srand(1);
      for (int i = 0; i < 20000; ++i) {
        const auto random = [](double low, double high) {
          return low + (high - low) * std::rand() / RAND_MAX;
        };
        const Vec3 p{random(-3.0, 9.0), random(-5.0, 5.0), random(-0.5, 5.0)};
        ASSERT_EQ(view.state(p), expected.state(p)) << p.transpose();
        if (i % 20 == 0) {
          ASSERT_EQ(view.body_state(p, body), expected.body_state(p, body)) << p.transpose();
          const Vec3 to = p + Vec3{random(-2, 2), random(-2, 2), random(-1, 1)};
          ASSERT_EQ(view.segment_hits(p, to, body), expected.segment_hits(p, to, body));
        }
      }
    }
  }
}

using Cells = std::set<std::tuple<long, long, long>>;

Cells occupied_cells(const Mapper& mapper) {
  Cells cells;
  for (const OccupiedCell& cell : mapper.occupied()) {
    const Vec3 index = cell.centre_W / cell.size_m - Vec3::Constant(0.5);
    cells.insert({std::lround(index.x()), std::lround(index.y()), std::lround(index.z())});
  }
  return cells;
}

TEST(Flyball, loses_and_inflates_nothing_when_the_knob_goes_coarse_and_back) {
  for (const std::string front_end : {"exact", "rays", "pyramid"}) {
    for (const auto place : {kit::Place::indoor, kit::Place::outdoor}) {
      const auto fine = kit::made_mapper("flyball", {{"front_end", front_end}});
      const auto mixed = kit::made_mapper("flyball", {{"front_end", front_end}});
      for (int frame = 0; frame < 24; ++frame) {
        const std::size_t level =
            frame < 8 || frame >= 14 ? 0 : 1 + static_cast<std::size_t>(frame) / 2 % 3;
        insert_scan(*fine, place, frame, lattice_m[0]);
        insert_scan(*mixed, place, frame, lattice_m[level]);
      }
      const Cells expected = occupied_cells(*fine);
      const Cells found = occupied_cells(*mixed);
      std::size_t kept = 0;
      for (const auto& cell : expected) {
        kept += found.count(cell);
      }
      EXPECT_GE(kept, 0.98 * static_cast<double>(expected.size())) << front_end;
      EXPECT_LT(found.size() - kept, 0.02 * static_cast<double>(expected.size())) << front_end;
    }
  }
}

TEST(Flyball, looks_less_far_when_work_is_limited_and_no_less_near) {
  const auto all = kit::made_mapper("flyball", {{"front_end", std::string{"exact"}}});
  const Work work = insert_scan(*all, kit::Place::indoor, 0, 0.15);
  const double limit = 0.4 * work.count("traversals");
  const auto limited = kit::made_mapper(
      "flyball", {{"front_end", std::string{"exact"}}, {"most_traversals", limit}});
  const Work less = insert_scan(*limited, kit::Place::indoor, 0, 0.15);
  EXPECT_LT(less.count("traversals"), 1.1 * limit);
  EXPECT_GT(less.count("traversals"), 0.9 * limit);
  const auto place = kit::synthetic_scan(kit::Place::indoor, 0, range_m);
  const Vec3 camera_W = place.X_WC.translation();
  for (double ahead_m = 0.3; ahead_m < 1.5; ahead_m += 0.1) {
    const Vec3 p = camera_W + Vec3{ahead_m, 0.2 * ahead_m, 0.1 * ahead_m};
    EXPECT_EQ(limited->view().state(p), all->view().state(p)) << ahead_m;
  }
  EXPECT_EQ(limited->view().state(camera_W + Vec3{4.5, 0, 0}), CellState::unknown);
  EXPECT_EQ(all->view().state(camera_W + Vec3{4.5, 0, 0}), CellState::free);
}

TEST(Flyball, frees_declared_space_at_once_and_only_where_it_is_unknown) {
  const auto mapper = kit::made_mapper("flyball");
  mapper->declare_clear({0.0, 0.0, 1.25}, {1.0, 1.25});
  EXPECT_EQ(mapper->view().body_state({0.2, 0.3, 1.0}, body), CellState::free);
  insert(*mapper, wall_scan(0.7F), {0.15, range_m});
  EXPECT_EQ(mapper->view().body_state({0.5, 0.0, 0.3}, body), CellState::occupied);
}

TEST(Flyball, forgets_obstacles_in_doubt_until_a_scan_shows_them_again) {
  const auto mapper = kit::made_mapper("flyball");
  const Vec3 wall_W{3.01, 0.01, 0.01};
  insert(*mapper, wall_scan(3.0F), {0.15, range_m});
  mapper->doubt_obstacles({-20.0, 0.0, 0.0}, 12.0);
  EXPECT_EQ(mapper->view().state(wall_W), CellState::occupied) << "it lies elsewhere";
  mapper->doubt_obstacles({-4.0, 0.0, 0.0}, 12.0);
  EXPECT_EQ(mapper->view().state(wall_W), CellState::unknown);
  EXPECT_EQ(mapper->view().state({1.5, 0.0, 0.0}), CellState::free);
  EXPECT_TRUE(mapper->occupied().empty());
  insert(*mapper, wall_scan(3.0F), {0.15, range_m});
  EXPECT_EQ(mapper->view().state(wall_W), CellState::occupied);
}

}  // namespace
}  // namespace flyball
