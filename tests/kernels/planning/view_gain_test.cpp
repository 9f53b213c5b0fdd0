// SPDX-License-Identifier: BSD-3-Clause
#include "planning/view_gain.h"

#include "explore_scenes.h"
#include <cmath>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double half_turn_rad = 3.141592653589793;

TEST(ViewGain, of_a_view_into_the_open_is_the_volume_of_its_pyramid) {
  const Aabb box{{-8, -8, -8}, {8, 8, 8}};
  const kit::GridMap map{box, 0.2, CellState::unknown};
  const StateGrid grid{map, box};
  ViewField field;
  field.horizontal_rad = 1.2;
  field.vertical_rad = 0.8;
  field.range_m = 6.0;
  ViewGain gain{grid, box, field};
  // The pyramid is cut by a sphere: r^3 / 3 times its solid angle, 4 asin(sin a/2 sin b/2).
  const double cut = std::sin(0.6) * std::sin(0.4);
  const double expected_m3 = 6.0 * 6.0 * 6.0 / 3.0 * 4.0 * std::asin(cut);
  for (const double yaw_rad : {0.0, 0.7, -2.5}) {
    EXPECT_NEAR(gain.gain_m3({{0.03, 0.02, 0.01}, yaw_rad}), expected_m3, 0.02 * expected_m3);
  }
  EXPECT_GT(gain.ray_cells(), gain.cells());
}

TEST(ViewGain, counts_only_what_is_unknown_visible_and_in_the_volume) {
  const kit::GridMap map = kit::two_rooms();
  const ExploreRequest request = kit::request_from({3.0, 3.0, 1.2}, 0.0);
  const StateGrid grid{map, request.volume_W};
  ViewGain gain{grid, request.volume_W, request.field};
  EXPECT_EQ(gain.gain_m3({{3.0, 3.0, 1.2}, half_turn_rad}), 0.0) << "a room that is known";
  const double from_afar_m3 = gain.gain_m3({{3.0, 3.0, 1.2}, 0.0});
  const double from_door_m3 = gain.gain_m3({{6.0, 3.0, 1.2}, 0.0});
  EXPECT_GT(from_afar_m3, 0.5);
  EXPECT_GT(from_door_m3, 5.0 * from_afar_m3);
  ViewGain of_half{grid, {{0, 0, 0}, {9, 6, 3}}, request.field};
  EXPECT_LT(of_half.gain_m3({{6.0, 3.0, 1.2}, 0.0}), 0.6 * from_door_m3);
}

TEST(ViewGain, agrees_with_a_cell_by_cell_test_of_the_field) {
  const kit::GridMap map = kit::two_rooms();
  const ExploreRequest request = kit::request_from({5.0, 2.5, 1.0}, 0.3);
  const StateGrid grid{map, request.volume_W};
  ViewGain gain{grid, request.volume_W, request.field};
  const double cell_m3 = 0.15 * 0.15 * 0.15;
  double expected_m3 = 0.0;
  double crossed = 0.0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const GridCell cell = grid.cell_at(i);
    const bool counts = grid.at(cell) == CellState::unknown &&
                        gain.is_in_field(request.from, cell) &&
                        grid.sees(request.from.p_W, cell, crossed);
    expected_m3 += counts ? cell_m3 : 0.0;
  }
  EXPECT_NEAR(gain.gain_m3(request.from), expected_m3, 3.0 * cell_m3) << "rounding at the rim";
}

TEST(ViewGain, is_the_same_for_several_views_at_once) {
  const kit::GridMap map = kit::two_rooms();
  const ExploreRequest request = kit::request_from({5.0, 2.5, 1.0}, 0.3);
  const StateGrid grid{map, request.volume_W, 3};
  const std::vector<Viewpoint> views{{{3.0, 3.0, 1.2}, 0.0},
                                     {{6.0, 3.0, 1.2}, 0.0},
                                     {{3.0, 3.0, 1.2}, half_turn_rad},
                                     {{5.0, 2.5, 1.0}, 0.3},
                                     {{5.5, 3.5, 1.5}, -0.4}};
  ViewGain alone{grid, request.volume_W, request.field};
  std::vector<double> expected_m3;
  for (const Viewpoint& view : views) {
    expected_m3.push_back(alone.gain_m3(view));
  }
  ViewGain together{grid, request.volume_W, request.field, 3};
  EXPECT_EQ(together.gains_m3(views), expected_m3);
  EXPECT_EQ(together.cells(), alone.cells());
  EXPECT_EQ(together.ray_cells(), alone.ray_cells());
}

TEST(ViewGain, of_a_tilted_camera_is_the_same_pyramid_turned) {
  const Aabb box{{-8, -8, -8}, {8, 8, 8}};
  const kit::GridMap map{box, 0.2, CellState::unknown};
  const StateGrid grid{map, box};
  ViewField field;
  field.horizontal_rad = 1.2;
  field.vertical_rad = 0.8;
  ViewGain level{grid, box, field};
  field.pitch_down_rad = 0.7;
  ViewGain tilted{grid, box, field};
  const Viewpoint view{{0.03, 0.02, 0.01}, 0.4};
  EXPECT_NEAR(tilted.gain_m3(view), level.gain_m3(view), 0.02 * level.gain_m3(view));
  const auto cell_at = [&](double ahead_m, double up_m) {
    return grid.cell_of(view.p_W + Vec3{ahead_m * std::cos(0.4), ahead_m * std::sin(0.4), up_m});
  };
  EXPECT_TRUE(tilted.is_in_field(view, cell_at(3.0, -3.0 * std::tan(0.7))));
  EXPECT_FALSE(level.is_in_field(view, cell_at(3.0, -3.0 * std::tan(0.7))));
  EXPECT_FALSE(tilted.is_in_field(view, cell_at(3.0, 0.0)));
}

TEST(ViewGain, looks_from_where_the_camera_is_mounted) {
  const Aabb box{{-8, -8, -8}, {8, 8, 8}};
  const kit::GridMap map{box, 0.2, CellState::unknown};
  const StateGrid grid{map, box};
  ViewField field;
  const double centred_m3 =
      ViewGain{grid, box, field}.gain_m3({{1.0, 2.0, 0.5}, 1.5 * half_turn_rad});
  field.forward_m = 2.0;
  field.up_m = 0.5;
  ViewGain mounted{grid, box, field};
  EXPECT_NEAR(mounted.gain_m3({{1.0, 4.0, 0.0}, 1.5 * half_turn_rad}), centred_m3, 0.05)
      << "but for rounding at the edges";
}

}  // namespace
}  // namespace flyball
