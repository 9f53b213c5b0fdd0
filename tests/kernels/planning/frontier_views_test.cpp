// SPDX-License-Identifier: BSD-3-Clause
#include "planning/frontier_views.h"

#include "explore_scenes.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::optional<FrontierView> best_view(const kit::GridMap& map,
                                      const ExploreRequest& request,
                                      const WantedGain& wanted = {0.1, 1.0}) {
  const StateGrid grid{map, request.volume_W};
  const StandingPlaces places{grid, request.body, request.bounds_W, request.from.p_W};
  ViewGain gain{grid, request.volume_W, request.field};
  double ray_cells = 0.0;
  return best_frontier_view(request, places, gain, wanted, ray_cells);
}

TEST(Frontiers, are_the_door_between_a_known_room_and_an_unknown_one) {
  const kit::GridMap map = kit::two_rooms();
  const StateGrid grid{map, {{0, 0, 0}, {12, 6, 3}}};
  const auto frontiers = find_frontiers(grid, {{0, 0, 0}, {12, 6, 3}});
  ASSERT_FALSE(frontiers.empty());
  double faces = 0.0;
  for (const Frontier& frontier : frontiers) {
    const Vec3 p_W = grid.centre(frontier.cell);
    EXPECT_NEAR(p_W.x(), 6.075, 1e-9);
    EXPECT_TRUE(p_W.y() > 2.55 && p_W.y() < 3.6 && p_W.z() < 2.1) << p_W.transpose();
    faces += frontier.faces;
  }
  EXPECT_EQ(faces, 7.0 * 14.0);
}

TEST(Frontiers, at_the_volumes_border_are_none) {
  const kit::GridMap map{{{-3, -3, 0}, {3, 3, 3}}, 0.15, CellState::unknown};
  const Aabb volume_W{{-1.5, -1.5, 0}, {1.5, 1.5, 3}};
  kit::GridMap seen = map;
  seen.fill(volume_W, CellState::free);
  EXPECT_TRUE(find_frontiers(StateGrid{seen, {{-3, -3, 0}, {3, 3, 3}}}, volume_W).empty());
}

TEST(FrontierView, looks_through_the_door_from_where_the_body_can_stand) {
  const kit::GridMap map = kit::two_rooms();
  const ExploreRequest request = kit::request_from({1.0, 1.0, 1.2}, 0.0);
  const auto found = best_view(map, request);
  ASSERT_TRUE(found);
  EXPECT_EQ(map.body_state(found->view.p_W, request.body), CellState::free);
  EXPECT_GT(found->gain_m3, 1.0);
  const Vec3 door = Vec3{6.1, 3.1, 1.2} - found->view.p_W;
  EXPECT_LT(std::abs(wrap_angle(yaw_of(door) - found->view.yaw_rad)), 0.8);
}

TEST(FrontierView, is_not_taken_twice_nor_where_nobody_gets) {
  const kit::GridMap map = kit::two_rooms();
  ExploreRequest request = kit::request_from({1.0, 1.0, 1.2}, 0.0);
  const auto first = best_view(map, request);
  ASSERT_TRUE(first);
  request.taken.push_back(first->view);
  EXPECT_TRUE(is_spent(request, first->view));
  const auto second = best_view(map, request);
  ASSERT_TRUE(second);
  EXPECT_FALSE(is_spent(request, second->view));
  request.taken.clear();
  request.unreachable_W.push_back(first->view.p_W);
  const auto third = best_view(map, request);
  ASSERT_TRUE(third);
  EXPECT_GE((third->view.p_W - first->view.p_W).norm(), 0.5);
}

TEST(FrontierView, looks_at_more_frontiers_until_one_shows_enough) {
  kit::GridMap map = kit::two_rooms();
  constexpr double pocket_m = 0.45;  // Under the ceiling, one in each cube of 1.2 m.
  for (double x_m = 0.45; x_m < 5.5; x_m += 1.2) {
    for (double y_m = 0.45; y_m < 5.5; y_m += 1.2) {
      const Vec3 low_W{x_m, y_m, 2.55};
      map.fill({low_W, low_W + Vec3::Constant(pocket_m)}, CellState::unknown);
    }
  }
  const ExploreRequest request = kit::request_from({1.0, 1.0, 1.2}, 0.0);
  constexpr double room_m3 = 5.0;
  const auto any = best_view(map, request, {0.1, 0.1});
  const auto good = best_view(map, request, {0.1, room_m3});
  ASSERT_TRUE(any && good);
  EXPECT_LT(any->gain_m3, room_m3) << "pockets have more faces a metre than the door";
  EXPECT_GT(good->gain_m3, room_m3);
}

// From where the body stands, the door is seen past its edge, which shows next to nothing.
TEST(FrontierView, is_from_nearer_by_where_the_first_place_shows_little) {
  kit::GridMap map = kit::two_rooms();
  map.fill({{6, 2.55, 0}, {6.15, 3.6, 3}}, CellState::occupied);
  map.fill({{6, 5.1, 0}, {6.15, 5.85, 2.1}}, CellState::free);
  const auto found = best_view(map, kit::request_from({5.4, 0.5, 1.2}, 0.0));
  ASSERT_TRUE(found);
  EXPECT_GT(found->gain_m3, 5.0);
  EXPECT_GT(found->path_m, 2.0);
}

TEST(FrontierView, is_none_when_all_is_known) {
  const kit::GridMap map{{{0, 0, 0}, {12, 6, 3}}, 0.15, CellState::free};
  EXPECT_FALSE(best_view(map, kit::request_from({3.0, 3.0, 1.2}, 0.0)));
}

}  // namespace
}  // namespace flyball
