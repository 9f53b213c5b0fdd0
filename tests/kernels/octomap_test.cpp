// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/kernels.h"
#include "flyball/kernels/mapper.h"
#include "flyball/runtime/registry.h"

#include "maps/octomap_tree.h"
#include "synthetic_scans.h"
#include "wall_scan.h"
#include <memory>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using kit::insert;
using kit::looking_along_x;
using kit::wall_scan;

constexpr Cylinder octomap_body{0.35, 0.15};

std::unique_ptr<Mapper> make_octomap() {
  Registry registry;
  register_kernels(registry);
  return registry.make<Mapper>("octomap");
}

TEST(Octomap, refuses_an_image_without_a_depth_for_each_pixel) {
  kit::expect_image_without_all_depths_refused(*make_octomap());
}

TEST(Octomap, shows_a_scan_only_after_commit) {
  const auto mapper = make_octomap();
  ASSERT_TRUE(mapper->prepare(wall_scan(3.0F), looking_along_x(), {0.15, 7.0}).ok());
  EXPECT_EQ(mapper->view().state({3.01, 0.01, 0.01}), CellState::unknown);
  EXPECT_TRUE(mapper->occupied().empty());
  mapper->commit();
  EXPECT_EQ(mapper->view().state({3.01, 0.01, 0.01}), CellState::occupied);
  EXPECT_EQ(mapper->view().state({1.5, 0.0, 0.0}), CellState::free);
  EXPECT_EQ(mapper->view().state({3.4, 0.0, 0.0}), CellState::unknown);
  EXPECT_EQ(mapper->view().body_state({2.0, 0.0, 0.0}, {0.3, 0.15}), CellState::free);
  EXPECT_EQ(mapper->view().body_state({2.8, 0.0, 0.0}, octomap_body), CellState::occupied);
}

TEST(Octomap, replaces_a_change_that_was_not_committed) {
  const auto mapper = make_octomap();
  ASSERT_TRUE(mapper->prepare(wall_scan(3.0F), looking_along_x(), {0.15, 7.0}).ok());
  ASSERT_TRUE(mapper->prepare(wall_scan(5.0F), looking_along_x(), {0.15, 7.0}).ok());
  mapper->commit();
  mapper->commit();
  EXPECT_EQ(mapper->view().state({3.01, 0.01, 0.01}), CellState::free);
  EXPECT_EQ(mapper->view().state({5.01, 0.01, 0.01}), CellState::occupied);
}

TEST(Octomap, frees_returns_beyond_the_range_up_to_it_and_marks_nothing) {
  const auto mapper = make_octomap();
  insert(*mapper, wall_scan(5.0F), {0.15, 4.0});
  EXPECT_EQ(mapper->view().state({3.7, 0.0, 0.0}), CellState::free);
  EXPECT_EQ(mapper->view().state({4.2, 0.0, 0.0}), CellState::unknown);
  EXPECT_TRUE(mapper->occupied().empty());
}

TEST(Octomap, frees_clear_rays_and_marks_nothing) {
  const auto mapper = make_octomap();
  PointCloud cloud_C = wall_scan(7.007F);
  std::swap(cloud_C.hits_C, cloud_C.clear_C);
  insert(*mapper, cloud_C, {0.15, 7.0});
  EXPECT_EQ(mapper->view().state({6.6, 0.0, 0.0}), CellState::free);
  EXPECT_EQ(mapper->view().state({7.2, 0.0, 0.0}), CellState::unknown);
  EXPECT_TRUE(mapper->occupied().empty());
}

TEST(Octomap, reports_the_work_of_one_frame) {
  const auto mapper = make_octomap();
  PointCloud cloud_C;
  cloud_C.hits_C = {{0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 1.0F}};
  cloud_C.clear_C = {{0.0F, 0.0F, 5.0F}};
  const auto work = mapper->prepare(cloud_C, looking_along_x(), {0.15, 2.0});
  ASSERT_TRUE(work.ok());
  EXPECT_EQ(work->count("frame"), 1);
  EXPECT_EQ(work->count("rays"), 3);
  EXPECT_EQ(work->count("traversals"), 6 + 6 + 13);  // 1 m ends in cell 6, 2 m in cell 13
  EXPECT_EQ(work->count("updates"), 13);             // cell 6 is hit, the others are free
}

TEST(Octomap, rejects_bad_input_and_prepares_nothing) {
  kit::expect_bad_input_refused(*make_octomap());
}

TEST(Octomap, keeps_what_was_mapped_when_the_resolution_changes) {
  const auto mapper = make_octomap();
  insert(*mapper, wall_scan(5.0F), {0.15, 7.0});
  insert(*mapper, wall_scan(3.0F), {0.80, 7.0});
  const OccupancyView& view = mapper->view();
  EXPECT_EQ(view.resolution_m(), 0.80);
  EXPECT_EQ(view.state({2.5, 0.0, 0.0}), CellState::occupied);  // the coarse cell of the new wall
  EXPECT_EQ(view.state({5.01, 0.01, 0.01}),
            CellState::occupied);  // fine, unknown to the coarse map
  EXPECT_EQ(view.state({4.5, 0.0, 0.0}), CellState::free);
  EXPECT_EQ(view.body_state({4.2, 0.0, 0.0}, octomap_body), CellState::free);
  insert(*mapper, wall_scan(5.0F), {0.15, 7.0});
  EXPECT_EQ(view.resolution_m(), 0.15);
  EXPECT_EQ(view.state({2.5, 0.0, 0.0}), CellState::free);
  EXPECT_EQ(view.state({5.01, 0.01, 0.01}), CellState::occupied);
}

/// A wide view along x that ends at a wall `distance_m` away.
PointCloud wide_scan(float distance_m) {
  PointCloud cloud_C = wall_scan(distance_m);
  for (Eigen::Vector3f& hit_C : cloud_C.hits_C) {
    hit_C.head<2>() *= 4.0F;
  }
  return cloud_C;
}

TEST(Octomap, trusts_no_coarse_cell_that_was_freed_after_a_hit_once_there_is_a_finer_map) {
  const auto mapper = make_octomap();
  insert(*mapper, wide_scan(3.0F), {0.80, 7.0});
  for (int i = 0; i < 3; ++i) {
    insert(*mapper, wide_scan(6.0F), {0.80, 7.0});  // passes through the cells of the wall
  }
  const OccupancyView& view = mapper->view();
  EXPECT_EQ(view.state({2.8, 0.1, 0.1}), CellState::free);
  insert(*mapper, wall_scan(1.0F), {0.15, 7.0});  // sees nothing of it
  EXPECT_EQ(view.state({2.8, 0.1, 0.1}), CellState::unknown);
  EXPECT_EQ(view.body_state({2.1, 0.1, 0.1}, octomap_body), CellState::unknown);  // reaches to 2.45
  EXPECT_EQ(view.state({4.4, 0.1, 0.1}), CellState::free);
  EXPECT_EQ(view.body_state({4.4, 0.1, 0.1}, octomap_body), CellState::free);
}

TEST(Octomap, trusts_no_coarse_cell_beside_space_that_nobody_saw_once_there_is_a_finer_map) {
  const auto mapper = make_octomap();
  PointCloud grazing_C;  // along a wall at y = 0.3, which no ray hits: what is behind stays unseen
  for (int i = 0; i < 60 * 60; ++i) {
    const float right = 0.1F * static_cast<float>(i % 60) - 0.2F;
    const float down = 0.1F * static_cast<float>(i / 60 - 30);
    grazing_C.hits_C.emplace_back(right, down, 6.0F);
  }
  insert(*mapper, grazing_C, {0.80, 7.0});
  const OccupancyView& view = mapper->view();
  EXPECT_EQ(view.state({4.4, 0.1, 0.1}), CellState::free);
  insert(*mapper, wall_scan(1.0F), {0.15, 7.0});
  EXPECT_EQ(view.state({4.4, 0.1, 0.1}), CellState::unknown);  // its neighbour at y = 1.2 is
  EXPECT_EQ(view.state({4.4, -1.2, 0.1}), CellState::free);
}

TEST(Octomap, keeps_the_old_resolution_until_the_change_is_committed) {
  const auto mapper = make_octomap();
  insert(*mapper, wall_scan(5.0F), {0.15, 7.0});
  ASSERT_TRUE(mapper->prepare(wall_scan(5.0F), looking_along_x(), {0.80, 7.0}).ok());
  EXPECT_EQ(mapper->view().resolution_m(), 0.15);
  mapper->commit();
  EXPECT_EQ(mapper->view().resolution_m(), 0.80);
}

TEST(Octomap, lists_the_occupied_leaves_of_the_stock_tree) {
  const auto mapper = make_octomap();
  octomap::OcTree stock{0.15};
  stock.setClampingThresMin(0.12);
  stock.setClampingThresMax(0.97);
  for (int frame = 0; frame < 3; ++frame) {
    const auto scan = kit::synthetic_scan(kit::Place::outdoor, frame, 7.0);
    octomap::Pointcloud points;
    for (const auto* ends : {&scan.cloud_C.hits_C, &scan.cloud_C.clear_C}) {
      for (const auto& p_C : *ends) {
        const Eigen::Vector3f p_W = (scan.X_WC * p_C.cast<double>()).cast<float>();
        points.push_back(p_W.x(), p_W.y(), p_W.z());
      }
    }
    const Eigen::Vector3f origin = scan.X_WC.translation().cast<float>();
    stock.insertPointCloud(points, {origin.x(), origin.y(), origin.z()}, 7.0);
    ASSERT_TRUE(mapper->prepare(scan.cloud_C, scan.X_WC, {0.15, 7.0}).ok());
    mapper->commit();
  }
  std::size_t expected = 0;
  for (auto leaf = stock.begin_leafs(); leaf != stock.end_leafs(); ++leaf) {
    const Vec3 centre_W{leaf.getX(), leaf.getY(), leaf.getZ()};
    const bool occupied = stock.isNodeOccupied(*leaf);
    ASSERT_EQ(mapper->view().state(centre_W), occupied ? CellState::occupied : CellState::free);
    expected += occupied ? 1 : 0;
  }
  const auto cells = mapper->occupied();
  EXPECT_EQ(cells.size(), expected);
  for (const OccupiedCell& cell : cells) {
    const auto* node = stock.search(cell.centre_W.x(), cell.centre_W.y(), cell.centre_W.z());
    ASSERT_TRUE(node != nullptr && stock.isNodeOccupied(node));
  }
}

TEST(Octomap, lists_cells_of_another_resolution_only_where_the_active_one_knows_nothing) {
  const auto mapper = make_octomap();
  insert(*mapper, wall_scan(5.0F), {0.15, 7.0});
  const std::size_t fine = mapper->occupied().size();
  insert(*mapper, wall_scan(3.0F), {0.80, 7.0});
  const std::size_t both = mapper->occupied().size();
  EXPECT_GT(both, fine);
  for (int i = 0; i < 2; ++i) {
    insert(*mapper, wall_scan(6.0F), {0.80, 7.0});  // looks through where the fine wall was
  }
  for (const OccupiedCell& cell : mapper->occupied()) {
    EXPECT_NEAR(cell.size_m, 0.80, 1e-9);
  }
}

TEST(Octomap, frees_declared_space_at_once_and_only_where_it_is_unknown) {
  const auto mapper = make_octomap();
  mapper->declare_clear({0.0, 0.0, 1.25}, {1.0, 1.25});
  EXPECT_EQ(mapper->view().body_state({0.2, 0.3, 1.0}, octomap_body), CellState::free);
  insert(*mapper, wall_scan(0.7F), {0.15, 7.0});
  EXPECT_EQ(mapper->view().body_state({0.5, 0.0, 0.3}, octomap_body), CellState::occupied);
}

}  // namespace
}  // namespace flyball
