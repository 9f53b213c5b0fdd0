// SPDX-License-Identifier: BSD-3-Clause
#include "planning/ompl_kd_tree.h"

#include <cmath>
#include <deque>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using State = ompl::base::RealVectorStateSpace::StateType;

/// A motion as OMPL's planners have them, and its age.
struct Motion {
  Motion(double x, double y, double z, int number) : values{x, y, z}, age{number} {
    place.values = values;
  }
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;

  double values[3];
  State place{};
  State* state{&place};
  int age;
};

/// In cells of a metre, so that many lie at one place and many are equally far.
std::deque<Motion> some_motions(int count) {
  std::mt19937 random{7};
  std::deque<Motion> motions;
  for (int i = 0; i < count; ++i) {
    const auto draw = [&] { return static_cast<double>(random() % 5); };
    const double x = draw();
    const double y = draw();
    motions.emplace_back(x, y, draw(), i);
  }
  return motions;
}

/// The ages of the nearest ones, by looking at all.
std::vector<int> nearest_of(const std::deque<Motion>& motions, const Motion& to, std::size_t k) {
  std::vector<std::pair<double, int>> all;
  for (const Motion& one : motions) {
    const double x = one.values[0] - to.values[0];
    const double y = one.values[1] - to.values[1];
    const double z = one.values[2] - to.values[2];
    all.emplace_back(x * x + y * y + z * z, one.age);
  }
  std::sort(all.begin(), all.end());
  std::vector<int> ages;
  for (std::size_t i = 0; i < k; ++i) {
    ages.push_back(all[i].second);
  }
  return ages;
}

std::vector<int> ages_of(const std::vector<Motion*>& motions) {
  std::vector<int> ages;
  for (const Motion* one : motions) {
    ages.push_back(one->age);
  }
  return ages;
}

TEST(KdTree, finds_the_nearest_and_of_equally_near_ones_the_oldest) {
  std::deque<Motion> motions = some_motions(400);
  KdTree<Motion*> tree;
  for (Motion& one : motions) {
    tree.add(&one);
  }
  std::vector<Motion*> found;
  for (int i = 0; i < 50; ++i) {
    Motion wanted{0.1 * i, 0.07 * i, 4.0 - 0.05 * i, 0};
    for (const std::size_t k : {1U, 3U, 40U}) {
      tree.nearestK(&wanted, k, found);
      EXPECT_EQ(ages_of(found), nearest_of(motions, wanted, k)) << i << ", " << k;
    }
    tree.nearestR(&wanted, 1.5, found);
    EXPECT_EQ(ages_of(found), nearest_of(motions, wanted, found.size())) << i;
  }
}

TEST(KdTree, finds_none_that_was_removed) {
  std::deque<Motion> motions = some_motions(200);
  KdTree<Motion*> tree;
  for (Motion& one : motions) {
    tree.add(&one);
  }
  for (int i = 0; i < 150; ++i) {
    EXPECT_TRUE(tree.remove(&motions.front()));
    motions.pop_front();
  }
  EXPECT_EQ(tree.size(), 50U);
  std::vector<Motion*> found;
  Motion wanted{2.0, 2.0, 2.0, 0};
  tree.nearestK(&wanted, 50, found);
  EXPECT_EQ(ages_of(found), nearest_of(motions, wanted, 50));
}

/// RRT draws the few places before a passage in half of its samples, and adds each as a motion.
TEST(KdTree, holds_any_number_at_one_place) {
  std::deque<Motion> motions;
  KdTree<Motion*> tree;
  for (int i = 0; i < 300000; ++i) {
    motions.emplace_back(1.0, 2.0, 3.0, i);
    tree.add(&motions.back());
  }
  Motion beside{9.0, 9.0, 9.0, 300000};
  tree.add(&beside);
  Motion wanted{1.0, 2.0, 3.0, 0};
  EXPECT_EQ(tree.nearest(&wanted)->age, 0);
  wanted.values[0] = 8.0;
  wanted.values[1] = 9.0;
  EXPECT_EQ(tree.nearest(&wanted)->age, 300000);
}

}  // namespace
}  // namespace flyball
