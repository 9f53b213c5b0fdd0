// SPDX-License-Identifier: BSD-3-Clause
#include "planning/standing_places.h"

#include "explore_scenes.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

struct Flooded {
  kit::GridMap map;
  StateGrid grid;
  StandingPlaces places;

  Flooded(const kit::GridMap& map_in, const ExploreRequest& request)
      : map{map_in},
        grid{map, request.volume_W},
        places{grid, request.body, request.bounds_W, request.from.p_W} {}
};

TEST(StandingPlaces, are_free_for_the_whole_body_and_within_the_bounds) {
  const ExploreRequest request = kit::request_from({3.0, 3.0, 1.2}, 0.0);
  const Flooded flooded{kit::two_rooms(), request};
  ASSERT_FALSE(flooded.places.thinned().empty());
  for (const Place& place : flooded.places.thinned()) {
    const Vec3 p_W = flooded.grid.centre(place.cell);
    EXPECT_EQ(flooded.map.body_state(p_W, request.body), CellState::free) << p_W.transpose();
    EXPECT_TRUE(request.bounds_W.contains(p_W));
  }
}

TEST(StandingPlaces, come_nearest_first_with_the_path_to_them) {
  const ExploreRequest request = kit::request_from({1.0, 1.0, 1.2}, 0.0);
  const Flooded flooded{kit::two_rooms(), request};
  double last_m = 0.0;
  for (const Place& place : flooded.places.thinned()) {
    EXPECT_GE(place.path_m, last_m);
    last_m = place.path_m;
    const Vec3 way = flooded.grid.centre(place.cell) - request.from.p_W;
    EXPECT_NEAR(place.path_m, way.lpNorm<1>(), 0.5);
  }
  EXPECT_GT(last_m, 8.0);
}

TEST(StandingPlaces, go_through_a_door_of_five_cells_but_not_through_one_of_four) {
  kit::GridMap map = kit::two_rooms();
  map.fill({{6, 0, 0}, {12, 6, 3}}, CellState::free);
  const ExploreRequest request = kit::request_from({3.0, 3.0, 1.2}, 0.0);
  for (const int open_cells : {5, 4}) {
    map.fill({{6, 0, 0}, {6.15, 6, 3}}, CellState::occupied);
    map.fill({{6, 2.7, 0}, {6.15, 2.7 + 0.15 * open_cells, 2.1}}, CellState::free);
    const Flooded flooded{map, request};
    EXPECT_EQ(flooded.places.reaches(flooded.grid.cell_of({9.0, 3.0, 1.2})), open_cells == 5);
  }
}

TEST(StandingPlaces, are_none_where_the_body_cannot_stand_at_the_start) {
  const ExploreRequest request = kit::request_from({9.0, 3.0, 1.2}, 0.0);
  EXPECT_TRUE(Flooded(kit::two_rooms(), request).places.thinned().empty());
}

TEST(StandingPlaces, begin_in_the_cell_of_the_start_however_wide_it_is) {
  const kit::GridMap map{{{0, 0, 0}, {12, 6, 3.6}}, 1.2, CellState::free};
  // Near the corner of its cell, 1.02 m away from the centre.
  const Flooded flooded{map, kit::request_from({3.59, 3.59, 1.21}, 0.0)};
  EXPECT_TRUE(flooded.places.reaches(flooded.grid.cell_of({9.0, 3.0, 1.8})));
}

TEST(StandingPlaces, are_every_cell_of_a_corridor_that_is_one_wide_cell_across) {
  kit::GridMap map{{{0, 0, 0}, {12, 6, 3.6}}, 1.2, CellState::occupied};
  map.fill({{0, 1.2, 1.2}, {12, 2.4, 2.4}}, CellState::free);
  const Flooded flooded{map, kit::request_from({0.6, 1.8, 1.8}, 0.0)};
  EXPECT_EQ(flooded.places.thinned().size(), 10U);
}

}  // namespace
}  // namespace flyball
