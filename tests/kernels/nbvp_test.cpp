// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/explorer.h"
#include "flyball/kernels/kernels.h"
#include "flyball/runtime/registry.h"

#include "explore_scenes.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

std::unique_ptr<Explorer> nbvp() {
  Registry registry;
  register_kernels(registry);
  return registry.make<Explorer>("nbvp");
}

/// A hall of which only the first metres are known.
kit::GridMap hall() {
  kit::GridMap map{{{0, 0, 0}, {12, 6, 3}}, 0.15, CellState::unknown};
  map.fill({{0, 0, 0}, {4, 6, 3}}, CellState::free);
  return map;
}

TEST(Nbvp, goes_by_an_edge_through_known_free_space_towards_the_unknown) {
  const kit::GridMap map = hall();
  const ExploreRequest request = kit::request_from({1.0, 3.0, 1.2}, 0.0);
  const ExploreStep step = nbvp()->explore(request, map);
  ASSERT_TRUE(step.next);
  EXPECT_FALSE(step.is_far);
  EXPECT_GT(step.gain_m3, 1.0);
  const Vec3 edge = step.next->p_W - request.from.p_W;
  EXPECT_LE(edge.norm(), request.settings.extension_m + 1e-9);
  EXPECT_LE(std::abs(edge.z()), std::tan(request.max_slope_rad) * edge.head<2>().norm() + 1e-9);
  for (double share = 0.05; share <= 1.0; share += 0.05) {
    EXPECT_EQ(map.body_state(request.from.p_W + share * edge, request.body), CellState::free);
  }
}

TEST(Nbvp, stops_at_its_number_of_nodes_and_counts_its_work) {
  const ExploreStep step = nbvp()->explore(kit::request_from({1.0, 3.0, 1.2}, 0.0), hall());
  EXPECT_GE(step.work.count("iterations"), 15.0);
  EXPECT_LE(step.work.count("iterations"), 80.0);
  EXPECT_GE(step.work.count("collision_queries"), step.work.count("iterations"));
  EXPECT_GT(step.work.count("cells"), 0.0);
  EXPECT_GT(step.work.count("ray_cells"), 0.0);
}

TEST(Nbvp, looks_as_long_as_it_is_asked_to_also_beyond_its_usual_end) {
  ExploreRequest request = kit::request_from({1.0, 3.0, 1.2}, 0.0);
  request.settings.iterations = 2 * request.settings.most_iterations;
  const ExploreStep step = nbvp()->explore(request, hall());
  EXPECT_EQ(step.work.count("iterations"), request.settings.iterations);
}

TEST(Nbvp, answers_the_same_to_the_same_and_otherwise_for_another_seed) {
  const auto ask = [](std::uint64_t seed) {
    ExploreRequest request = kit::request_from({1.0, 3.0, 1.2}, 0.0);
    request.seed = seed;
    return nbvp()->explore(request, hall());
  };
  const ExploreStep first = ask(1);
  const ExploreStep again = ask(1);
  EXPECT_EQ(first.next->p_W, again.next->p_W);
  EXPECT_EQ(first.next->yaw_rad, again.next->yaw_rad);
  EXPECT_EQ(first.gain_m3, again.gain_m3);
  EXPECT_NE(first.next->p_W, ask(2).next->p_W);
}

TEST(Nbvp, keeps_the_best_branch_for_its_next_tree) {
  const kit::GridMap map = hall();
  ExploreRequest request = kit::request_from({1.0, 3.0, 1.2}, 0.0);
  // Long branches: a short edge, and a gain that does not fade.
  request.settings.extension_m = 0.7;
  request.settings.discount_1_m = 0.0;
  const auto explorer = nbvp();
  const ExploreStep first = explorer->explore(request, map);
  ASSERT_TRUE(first.next);
  request.from = *first.next;
  request.settings.iterations = 1;
  request.settings.most_iterations = 1;
  const ExploreStep second = explorer->explore(request, map);
  ASSERT_TRUE(second.next);
  const ExploreStep fresh = nbvp()->explore(request, map);
  EXPECT_GT(second.work.count("iterations"), fresh.work.count("iterations"));
  EXPECT_GT(second.gain_m3, 0.0);
}

TEST(Nbvp, goes_far_when_nothing_is_left_nearby) {
  // The first room is known, and its door is out of a short tree's reach.
  ExploreRequest request = kit::request_from({1.0, 1.0, 1.2}, 0.0);
  request.settings.extension_m = 0.5;
  request.settings.iterations = 1;
  request.settings.most_iterations = 1;
  const ExploreStep step = nbvp()->explore(request, kit::two_rooms());
  ASSERT_TRUE(step.next);
  EXPECT_TRUE(step.is_far);
  EXPECT_GT(step.gain_m3, 1.0);
}

TEST(Nbvp, knows_when_nothing_is_left_to_see) {
  const kit::GridMap map{{{0, 0, 0}, {12, 6, 3}}, 0.15, CellState::free};
  const ExploreStep step = nbvp()->explore(kit::request_from({3.0, 3.0, 1.2}, 0.0), map);
  EXPECT_FALSE(step.next);
  EXPECT_EQ(step.gain_m3, 0.0);
  EXPECT_GT(step.work.count("iterations"), 0.0);
}

/// Steps of one mission in a hall, and in a room from which a tree shows next to nothing.
std::vector<ExploreStep> steps_with(int threads, std::uint64_t seed) {
  std::vector<ExploreStep> steps;
  for (const kit::GridMap& map : {hall(), kit::two_rooms()}) {
    const auto explorer = nbvp();
    ExploreRequest request = kit::request_from({1.0, 1.0, 1.2}, 3.0);
    request.seed = seed;
    request.settings.threads = threads;
    for (int i = 0; i < 3; ++i) {
      steps.push_back(explorer->explore(request, map));
      if (const auto& next = steps.back().next) {
        request.taken.push_back(*next);
        request.from = *next;
      }
    }
  }
  return steps;
}

TEST(Nbvp, answers_the_same_with_any_number_of_threads) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    const std::vector<ExploreStep> alone = steps_with(1, seed);
    const std::vector<ExploreStep> together = steps_with(4, seed);
    ASSERT_EQ(together.size(), alone.size());
    for (std::size_t i = 0; i < alone.size(); ++i) {
      ASSERT_EQ(together[i].next.has_value(), alone[i].next.has_value()) << seed << ": " << i;
      EXPECT_EQ(together[i].gain_m3, alone[i].gain_m3);
      EXPECT_EQ(together[i].is_far, alone[i].is_far);
      EXPECT_EQ(together[i].work.count("iterations"), alone[i].work.count("iterations"));
      EXPECT_GE(together[i].work.count("cells"), alone[i].work.count("cells"));
      if (alone[i].next) {
        EXPECT_EQ(together[i].next->p_W, alone[i].next->p_W);
        EXPECT_EQ(together[i].next->yaw_rad, alone[i].next->yaw_rad);
      }
    }
  }
}

TEST(Nbvp, says_that_looks_at_cells_can_be_shared) {
  const ExploreStep step = nbvp()->explore(kit::request_from({1.0, 3.0, 1.2}, 0.0), hall());
  const Work shared = step.work.shared();
  EXPECT_EQ(shared.count("ray_cells"), step.work.count("ray_cells"));
  EXPECT_EQ(shared.count("cells"), step.work.count("cells")) << "no search for frontiers";
  EXPECT_EQ(shared.count("iterations"), 0.0);
  EXPECT_EQ(shared.count("collision_queries"), 0.0);
}

TEST(Nbvp, goes_nowhere_for_nothing_where_any_gain_is_worthwhile) {
  const auto explorer = nbvp();
  const auto chosen = Parameters::resolve("nbvp", explorer->parameters(), {{"worthwhile_m3", 0.0}});
  ASSERT_TRUE(explorer->configure(std::get<Parameters>(chosen), {}).ok());
  const kit::GridMap known{{{0, 0, 0}, {12, 6, 3}}, 0.15, CellState::free};
  EXPECT_FALSE(explorer->explore(kit::request_from({3.0, 3.0, 1.2}, 0.0), known).next);
  EXPECT_TRUE(explorer->explore(kit::request_from({1.0, 3.0, 1.2}, 0.0), hall()).next);
}

}  // namespace
}  // namespace flyball
