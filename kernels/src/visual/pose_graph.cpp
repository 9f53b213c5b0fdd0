// SPDX-License-Identifier: BSD-3-Clause
#include "visual/pose_graph.h"

#include "flyball/runtime/assert.h"

#include <exception>

#include <mrpt/graphs/CNetworkOfPoses.h>
#include <mrpt/graphslam/levmarq.h>

namespace flyball {
namespace {

using Graph = mrpt::graphs::CNetworkOfPoses3DInf;

mrpt::poses::CPose3D to_mrpt(const Pose& X) {
  const Eigen::Matrix3d R = X.linear();
  const Vec3 p = X.translation();
  return mrpt::poses::CPose3D{mrpt::math::CMatrixDouble33{R}, mrpt::math::CVectorFixedDouble<3>{p}};
}

Pose from_mrpt(const mrpt::poses::CPose3D& pose) {
  Pose X = Pose::Identity();
  const mrpt::math::CMatrixDouble33 R = pose.getRotationMatrix();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      X.linear()(row, column) = R(row, column);
    }
    X.translation()[row] = pose.m_coords[row];
  }
  return X;
}

Graph graph_of(const std::vector<Pose>& poses, const std::vector<PoseEdge>& edges) {
  Graph graph;
  graph.root = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    graph.nodes[i] = to_mrpt(poses[i]);
  }
  for (const PoseEdge& edge : edges) {
    FLYBALL_ASSERT(edge.from < poses.size() && edge.to < poses.size(), "edge %zu -> %zu of %zu",
                   edge.from, edge.to, poses.size());
    mrpt::math::CMatrixDouble66 information;
    information.setZero();
    for (int i = 0; i < 6; ++i) {
      const double sigma = i < 3 ? edge.sigma_m : edge.sigma_rad;
      information(i, i) = 1.0 / (sigma * sigma);
    }
    graph.insertEdge(edge.from, edge.to,
                     mrpt::poses::CPose3DPDFGaussianInf{to_mrpt(edge.X_FT), information});
  }
  return graph;
}

}  // namespace

Result<std::vector<Pose>> adjust(const std::vector<Pose>& poses,
                                 const std::vector<PoseEdge>& edges,
                                 Work& work) {
  if (poses.size() < 2 || edges.empty()) {
    return poses;
  }
  try {
    Graph graph = graph_of(poses, edges);
    mrpt::graphslam::TResultInfoSpaLevMarq outcome{};
    mrpt::containers::yaml settings;
    settings["max_iterations"] = 50;
    mrpt::graphslam::optimize_graph_spa_levmarq(graph, outcome, nullptr, settings);
    work.add("graph_edges",
             static_cast<double>(edges.size()) * static_cast<double>(outcome.num_iters));
    std::vector<Pose> adjusted;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      adjusted.push_back(from_mrpt(graph.nodes.at(i)));
      if (!adjusted.back().matrix().allFinite()) {
        return Error{ErrorCode::failed, "the pose graph has no finite solution"};
      }
    }
    return adjusted;
  } catch (const std::exception& error) {
    return Error{ErrorCode::failed, std::string{"MRPT cannot adjust the poses: "} + error.what()};
  }
}

}  // namespace flyball
