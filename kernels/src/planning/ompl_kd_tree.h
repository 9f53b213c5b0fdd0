// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Exact nearest neighbours for OMPL's planners in R^3. OMPL's own tree draws its pivots from a
/// process-wide seed, so that equally near neighbours could change from one plan to the next; here
/// the one that was added first wins.

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighbors.h>

namespace flyball {

/// @tparam T  Pointer to a motion with a `state`, or `state()`, of RealVectorStateSpace(3).
template <typename T>
class KdTree final : public ompl::NearestNeighbors<T> {
 public:
  [[nodiscard]] bool reportsSortedResults() const override { return true; }
  void clear() override {
    nodes_.clear();
    removed_ = 0;
  }
  using ompl::NearestNeighbors<T>::add;
  void add(const T& motion) override {
    const Node node{motion, position(motion), {none, none}, false};
    if (!nodes_.empty()) {
      leaf_for(node.p) = nodes_.size();
    }
    nodes_.push_back(node);
  }
  bool remove(const T& motion) override {
    for (Node& node : nodes_) {
      if (node.motion == motion && !node.removed) {
        node.removed = true;
        ++removed_;
        return true;
      }
    }
    return false;
  }
  [[nodiscard]] T nearest(const T& motion) const override {
    std::vector<T> found;
    nearestK(motion, 1, found);
    return found.empty() ? T{} : found.front();
  }
  void nearestK(const T& motion, std::size_t k, std::vector<T>& found) const override {
    collect({position(motion), k, std::numeric_limits<double>::infinity(), {}}, found);
  }
  void nearestR(const T& motion, double radius, std::vector<T>& found) const override {
    collect({position(motion), nodes_.size(), radius * radius, {}}, found);
  }
  [[nodiscard]] std::size_t size() const override { return nodes_.size() - removed_; }
  void list(std::vector<T>& motions) const override {
    motions.clear();
    for (const Node& node : nodes_) {
      if (!node.removed) {
        motions.push_back(node.motion);
      }
    }
  }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  struct Node {
    T motion;
    Eigen::Vector3d p;
    std::size_t child[2]{none, none};
    bool removed{};
  };
  /// Candidates as a heap of (squared distance, age): the worst one on top.
  struct Query {
    Eigen::Vector3d p;
    std::size_t k{};
    double limit{};
    std::vector<std::pair<double, std::size_t>> best;
  };

  /// The planners' motions have a member `state`, BIT*'s vertices a function.
  template <class M>
  static auto state_of(const M& motion, int) -> decltype(motion->state()) {
    return motion->state();
  }
  template <class M>
  static auto state_of(const M& motion, long) -> decltype((motion->state)) {
    return motion->state;
  }
  static Eigen::Vector3d position(const T& motion) {
    const double* values =
        state_of(motion, 0)->template as<ompl::base::RealVectorStateSpace::StateType>()->values;
    return {values[0], values[1], values[2]};
  }
  static int side(const Node& node, const Eigen::Vector3d& p, int depth) {
    return p[depth % 3] < node.p[depth % 3] ? 0 : 1;
  }

  /// The empty place where a point belongs. @pre There is a root.
  std::size_t& leaf_for(const Eigen::Vector3d& p) {
    std::size_t at = 0;
    for (int depth = 0;; ++depth) {
      std::size_t& next = nodes_[at].child[side(nodes_[at], p, depth)];
      if (next == none) {
        return next;
      }
      at = next;
    }
  }
  void collect(Query query, std::vector<T>& found) const {
    found.clear();
    if (query.k > 0 && !nodes_.empty()) {
      visit(0, 0, query);
    }
    std::sort_heap(query.best.begin(), query.best.end());
    for (const auto& candidate : query.best) {
      found.push_back(nodes_[candidate.second].motion);
    }
  }
  void visit(std::size_t index, int depth, Query& query) const {
    const Node& node = nodes_[index];
    if (!node.removed) {
      offer({(node.p - query.p).squaredNorm(), index}, query);
    }
    const int near = side(node, query.p, depth);
    if (node.child[near] != none) {
      visit(node.child[near], depth + 1, query);
    }
    const double apart = query.p[depth % 3] - node.p[depth % 3];
    if (node.child[1 - near] != none && apart * apart <= query.limit) {
      visit(node.child[1 - near], depth + 1, query);
    }
  }
  static void offer(const std::pair<double, std::size_t>& candidate, Query& query) {
    if (candidate.first > query.limit) {
      return;
    }
    query.best.push_back(candidate);
    std::push_heap(query.best.begin(), query.best.end());
    if (query.best.size() > query.k) {
      std::pop_heap(query.best.begin(), query.best.end());
      query.best.pop_back();
    }
    if (query.best.size() == query.k) {
      query.limit = std::min(query.limit, query.best.front().first);
    }
  }

  std::vector<Node> nodes_;
  std::size_t removed_{};
};

}  // namespace flyball
