// SPDX-License-Identifier: BSD-3-Clause
#include "visual/pose_graph.h"

#include "visual/motion.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Once round a regular polygon of `sides` metres, turning left at each corner.
std::vector<Pose> lap(int sides, double turn_error_rad) {
  std::vector<Pose> poses{Pose::Identity()};
  for (int i = 0; i < sides; ++i) {
    Vec6 step;
    step << 1.0, 0.0, 0.01 * i * turn_error_rad, 0.0, 0.0,
        6.283185307179586 / sides + turn_error_rad;
    poses.push_back(moved(poses.back(), step));
  }
  return poses;
}

std::vector<PoseEdge> chain(const std::vector<Pose>& poses) {
  std::vector<PoseEdge> edges;
  for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
    edges.push_back({i, i + 1, poses[i].inverse() * poses[i + 1], 0.02, 0.01});
  }
  return edges;
}

TEST(PoseGraph, leaves_alone_what_does_not_contradict_itself) {
  const auto poses = lap(12, 0.0);
  auto edges = chain(poses);
  edges.push_back({0, 12, Pose::Identity(), 0.01, 0.01});
  Work work;
  const auto adjusted = adjust(poses, edges, work);
  ASSERT_TRUE(adjusted) << adjusted.error().message;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_TRUE((*adjusted)[i].isApprox(poses[i], 1e-6)) << i;
  }
}

// Odometry that turns .01 rad too far at each of 24 corners misses its start by a metre; that the
// lap is closed spreads the error until no pose is off by a third of that.
TEST(PoseGraph, spreads_the_error_of_a_lap_when_it_closes) {
  const auto truth = lap(24, 0.0);
  const auto drifted = lap(24, 0.01);
  auto edges = chain(drifted);
  edges.push_back({0, 24, Pose::Identity(), 0.001, 0.001});
  Work work;
  const auto adjusted = adjust(drifted, edges, work);
  ASSERT_TRUE(adjusted) << adjusted.error().message;
  double before_m = 0.0;
  double after_m = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    before_m = std::max(before_m, (drifted[i].translation() - truth[i].translation()).norm());
    after_m = std::max(after_m, ((*adjusted)[i].translation() - truth[i].translation()).norm());
  }
  EXPECT_GT(before_m, 0.7);
  EXPECT_LT(after_m, before_m / 3.0);
  EXPECT_LT((*adjusted)[24].translation().norm(), 0.05);
  EXPECT_GT(work.count("graph_edges"), 24.0);
}

TEST(PoseGraph, keeps_its_first_pose_wherever_it_is) {
  auto poses = lap(12, 0.02);
  Vec6 elsewhere;
  elsewhere << 30.0, -4.0, 2.0, 1.5, 0.7, -2.0;
  for (Pose& pose : poses) {
    pose = moved(Pose::Identity(), elsewhere) * pose;
  }
  auto edges = chain(poses);
  edges.push_back({0, 12, Pose::Identity(), 0.001, 0.001});
  Work work;
  const auto adjusted = adjust(poses, edges, work);
  ASSERT_TRUE(adjusted);
  EXPECT_TRUE(adjusted->front().isApprox(poses.front(), 1e-9));
  EXPECT_LT((adjusted->back().translation() - poses.front().translation()).norm(), 0.05);
}

TEST(PoseGraph, has_nothing_to_do_without_edges) {
  Work work;
  const auto adjusted = adjust({Pose::Identity()}, {}, work);
  ASSERT_TRUE(adjusted);
  EXPECT_EQ(adjusted->size(), 1U);
}

}  // namespace
}  // namespace flyball
