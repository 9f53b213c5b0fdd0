// SPDX-License-Identifier: BSD-3-Clause
#include "maps/kept_walls.h"

#include "flyball/kernels/point_cloud.h"
#include "flyball/sim/depth_camera.h"
#include "flyball/sim/world.h"

#include "made_mapper.h"
#include "scratch_folder.h"
#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr MapperSettings fine{0.15, 7.0};
constexpr Cylinder flown_body{0.325, 0.125};

/// The end of a wall beside a hole. Its faces lie in the middle of cells and its corner, which is
/// at (5.025, 3.275), in a cell of which it fills less than half.
World wall_with_a_hole() {
  World world;
  world.boxes = {{{4.875, -5.25, 0.0}, {5.025, 3.275, 2.4}},
                 {{-5.0, -5.4, 0.0}, {9.0, -5.25, 2.4}}};
  return world;
}

const Vec3 corner_cell_W{5.025, 3.225, 1.725};

struct Look {
  double x_m;
  double y_m;
  double yaw_rad;
};

// From a flight that hit the wall (search_collapsed_building, seed 9108): the vehicle sees the end
// of the wall while it comes through the hole, ...
constexpr std::array<Look, 2> coming{Look{4.396, 3.476, 0.347}, Look{4.489, 3.573, 0.261}};
// ... and then it stands behind it, and its outermost rays pass by the corner.
constexpr Look standing{5.166, 3.677, -0.983};
// From here the camera shows all of the place where the corner was.
constexpr Look facing{4.0, 4.0, -0.6};

class Flight {
 public:
  explicit Flight(std::unique_ptr<Mapper> mapper) : mapper_{std::move(mapper)} {}

  void see(const World& world, const Look& from, int frames, bool with_image = true) {
    DepthCameraSpec spec;
    spec.rgbd_noise = false;
    const DepthCamera camera{world, spec, 1};
    for (int i = 0; i < frames; ++i) {
      Work work;
      PointCloudFrame frame =
          builder_->build(camera.frame(pose(from), {}, ++sequence_), fine.range_m, work);
      if (!with_image) {
        frame.pixels.reset();
      }
      ASSERT_TRUE(mapper_->prepare_frame(frame, pose(from), fine));
      mapper_->commit();
    }
  }
  [[nodiscard]] CellState corner() const { return mapper_->view().state(corner_cell_W); }
  [[nodiscard]] Mapper& mapper() { return *mapper_; }

 private:
  static Pose pose(const Look& from) {
    Pose X_WC = Pose::Identity();
    X_WC.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    X_WC.linear() = Eigen::AngleAxisd{from.yaw_rad, Vec3::UnitZ()} * X_WC.linear();
    X_WC.translation() = Vec3{from.x_m, from.y_m, 1.722};
    return X_WC;
  }
  static std::unique_ptr<PointCloudBuilder> make_builder() {
    Registry registry;
    register_kernels(registry);
    return registry.make<PointCloudBuilder>("depth_to_points");
  }

  std::unique_ptr<Mapper> mapper_;
  std::unique_ptr<PointCloudBuilder> builder_{make_builder()};
  std::uint64_t sequence_{};
};

class KeptWallsOf : public testing::TestWithParam<const char*> {
 protected:
  static Flight make_flight() {
    return Flight{GetParam() == std::string{"octomap"}
                      ? kit::made_mapper("octomap")
                      : kit::made_mapper("flyball", {{"layers", std::string{"stock"}}})};
  }
  /// A flight that has seen the wall's end and then looks past it for a while.
  static Flight make_standing(bool with_image) {
    Flight flight = make_flight();
    for (const Look& from : coming) {
      flight.see(wall_with_a_hole(), from, 2);
    }
    EXPECT_EQ(flight.corner(), CellState::occupied);
    flight.see(wall_with_a_hole(), standing, 10, with_image);
    return flight;
  }
};

TEST_P(KeptWallsOf, keeps_the_end_of_a_wall_that_rays_only_pass_beside) {
  Flight flight = make_standing(true);
  EXPECT_EQ(flight.corner(), CellState::occupied);
  const OccupancyView& view = flight.mapper().view();
  const Vec3 here{standing.x_m, standing.y_m, 1.722};
  EXPECT_TRUE(view.segment_hits(here, {5.25, 3.45, 1.722}, flown_body));
  EXPECT_EQ(view.body_state(here, flown_body), CellState::free);
  EXPECT_TRUE(flight.mapper().revision()->segment_hits(here, {5.25, 3.45, 1.722}, flown_body));
}

TEST_P(KeptWallsOf, leaves_the_tree_as_stock_has_it) {
  const ScratchFolder folder;
  Flight flight = make_standing(true);
  ASSERT_TRUE(flight.mapper().write(folder.path("map.ot"), std::nullopt));
  const auto stock = kit::made_mapper("octomap");
  ASSERT_TRUE(stock->read(folder.path("map.ot")));
  EXPECT_EQ(stock->view().state(corner_cell_W), CellState::free);
}

TEST_P(KeptWallsOf, frees_what_a_scan_sees_through_as_a_whole) {
  Flight flight = make_standing(true);
  flight.see(World{}, facing, 1);
  EXPECT_EQ(flight.corner(), CellState::free);
}

TEST_P(KeptWallsOf, keeps_what_is_occupied_by_its_log_odds_though_a_scan_sees_through_it) {
  Flight flight = make_flight();
  flight.see(wall_with_a_hole(), facing, 4);
  flight.see(World{}, facing, 1);
  EXPECT_EQ(flight.corner(), CellState::occupied);
  flight.see(World{}, facing, 14);
  EXPECT_EQ(flight.corner(), CellState::free);
}

TEST_P(KeptWallsOf, frees_by_any_ray_where_there_is_no_image) {
  EXPECT_EQ(make_standing(false).corner(), CellState::free);
}

INSTANTIATE_TEST_SUITE_P(Mappers,
                         KeptWallsOf,
                         testing::Values("octomap", "flyball_in_stock_layers"),
                         [](const auto& tested) { return std::string{tested.param}; });

}  // namespace
}  // namespace flyball
