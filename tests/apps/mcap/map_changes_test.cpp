// SPDX-License-Identifier: BSD-3-Clause
#include "mcap/map_changes.h"

#include <functional>

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// A map of which only the state of places is asked.
class MadeMap final : public OccupancyView {
 public:
  explicit MadeMap(std::function<bool(const Vec3&)> is_occupied)
      : is_occupied_{std::move(is_occupied)} {}
  [[nodiscard]] double resolution_m() const override { return 0.5; }
  [[nodiscard]] CellState state(const Vec3& p_W) const override {
    return is_occupied_(p_W) ? CellState::occupied : CellState::free;
  }
  [[nodiscard]] CellState body_state(const Vec3&, const Cylinder&) const override { return {}; }
  [[nodiscard]] bool has_occupied(const Aabb&) const override { return false; }
  [[nodiscard]] bool segment_hits(const Vec3&, const Vec3&, const Cylinder&) const override {
    return false;
  }
  [[nodiscard]] double obstacle_density(const Vec3&, double, double) const override { return 0.0; }
  [[nodiscard]] double nearest_obstacle_m(const Vec3&, double, double) const override {
    return 0.0;
  }

 private:
  std::function<bool(const Vec3&)> is_occupied_;
};

MapRevision revision(double resolution_m, std::function<bool(const Vec3&)> is_occupied) {
  return {1, MissionTime{}, resolution_m, std::make_shared<MadeMap>(std::move(is_occupied))};
}

bool everywhere(const Vec3&) {
  return true;
}
bool nowhere(const Vec3&) {
  return false;
}

TEST(MapChanges, tells_each_occupied_cell_once) {
  MapChanges changes;
  const auto first = changes.since_last(revision(0.5, everywhere),
                                        {{0.1, 0.2, -0.1}, {0.4, 0.4, -0.4}, {7.0, 0, 0}});
  ASSERT_EQ(first.size(), 2U);
  EXPECT_EQ(first[0].centre_W, Vec3(0.25, 0.25, -0.25));
  EXPECT_EQ(first[1].centre_W, Vec3(7.25, 0.25, 0.25));
  EXPECT_TRUE(first[0].is_occupied && first[1].is_occupied);
  EXPECT_TRUE(changes.since_last(revision(0.5, everywhere), {{0.3, 0.3, -0.3}}).empty());
}

TEST(MapChanges, tells_a_cell_only_when_the_map_calls_it_occupied) {
  MapChanges changes;
  EXPECT_TRUE(changes.since_last(revision(0.5, nowhere), {{1.0, 1.0, 1.0}}).empty());
  EXPECT_EQ(changes.since_last(revision(0.5, everywhere), {{1.0, 1.0, 1.0}}).size(), 1U);
}

TEST(MapChanges, tells_that_a_cell_is_free_again_and_occupied_again) {
  MapChanges changes;
  (void)changes.since_last(revision(0.5, everywhere), {{1.1, 1.1, 1.1}});
  const auto freed = changes.since_last(revision(0.5, nowhere), {});
  ASSERT_EQ(freed.size(), 1U);
  EXPECT_FALSE(freed[0].is_occupied);
  EXPECT_EQ(freed[0].centre_W, Vec3(1.25, 1.25, 1.25));
  EXPECT_TRUE(changes.since_last(revision(0.5, nowhere), {}).empty());
  EXPECT_EQ(changes.since_last(revision(0.5, everywhere), {{1.1, 1.1, 1.1}}).size(), 1U);
}

TEST(MapChanges, begins_anew_at_another_resolution) {
  MapChanges changes;
  (void)changes.since_last(revision(0.5, everywhere), {{1.1, 1.1, 1.1}});
  const auto coarse = changes.since_last(revision(1.0, everywhere), {{1.1, 1.1, 1.1}});
  ASSERT_EQ(coarse.size(), 1U);
  EXPECT_EQ(coarse[0].centre_W, Vec3(1.5, 1.5, 1.5));
}

TEST(MapChanges, forgets_the_oldest_cell_when_it_has_too_many) {
  MapChanges changes;
  std::vector<Vec3> hits_W;
  for (std::size_t i = 0; i < MapChanges::most_cells; ++i) {
    hits_W.emplace_back(0.5 * static_cast<double>(i % 1024) + 0.1,
                        0.5 * static_cast<double>(i / 1024) + 0.1, 0.1);
  }
  EXPECT_EQ(changes.since_last(revision(0.5, everywhere), hits_W).size(), MapChanges::most_cells);
  EXPECT_TRUE(changes.since_last(revision(0.5, everywhere), {hits_W.front()}).empty());
  EXPECT_EQ(changes.since_last(revision(0.5, everywhere), {{0.1, 0.1, 9.1}}).size(), 1U);
  EXPECT_EQ(changes.since_last(revision(0.5, everywhere), {hits_W.front()}).size(), 1U);
}

TEST(HitsOf, are_the_same_of_an_image_and_of_its_points) {
  DepthImage image;
  image.camera = {4, 3, 3.0, 2.0, 1.5};
  image.depth_m = {1.0F, 2.0F, 3.0F, 90.0F, 1.5F, 2.5F, 3.5F, 4.5F, 0.0F, 5.0F, 6.0F, 7.0F};
  Pose X_WC{Eigen::AngleAxisd{0.4, Vec3::UnitX()}};
  X_WC.translation() = Vec3{3.0, 2.0, 1.0};
  PointCloudFrame by_image;
  by_image.pixels = RangeImage{Deferred<DepthImage>::of(image), 50.0};
  const std::vector<Vec3> hits_W = hits_of(by_image, X_WC);
  EXPECT_EQ(hits_W.size(), 10U);  // One pixel is broken, one ray has no return.
  const Vec3 middle_C{(0.5 - 2.0) / 3.0, (0.5 - 1.5) / 3.0, 1.0};
  EXPECT_LT((hits_W.front() - X_WC * middle_C).norm(), 1e-6);  // Points are of single precision.
  PointCloud cloud;
  for (const Vec3& hit_W : hits_W) {
    cloud.hits_C.emplace_back((X_WC.inverse() * hit_W).cast<float>());
  }
  PointCloudFrame by_points;
  by_points.cloud_C = Deferred<PointCloud>::of(cloud);
  const std::vector<Vec3> same_W = hits_of(by_points, X_WC);
  ASSERT_EQ(same_W.size(), hits_W.size());
  for (std::size_t i = 0; i < hits_W.size(); ++i) {
    EXPECT_LT((same_W[i] - hits_W[i]).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace flyball
