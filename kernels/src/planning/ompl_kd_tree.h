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
    const Node node{motion, position(motion), {none, none}, none, nodes_.size(), false};
    if (!nodes_.empty()) {
      link_to(node.p) = nodes_.size();
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
    std::size_t next_here{none};  ///< The next younger one at the same place.
    std::size_t last_here{none};  ///< The youngest, where this is the oldest.
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

  /// Where the tree has to name the next node, which lies at this point. Samplers draw a few places
  /// again and again, and as children of each other those would be a list that each query walks.
  /// @pre There is a root.
  std::size_t& link_to(const Eigen::Vector3d& p) {
    std::size_t at = 0;
    for (int depth = 0;; ++depth) {
      if (nodes_[at].p == p) {
        return nodes_[std::exchange(nodes_[at].last_here, nodes_.size())].next_here;
      }
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
      visit(query);
    }
    std::sort_heap(query.best.begin(), query.best.end());
    for (const auto& candidate : query.best) {
      found.push_back(nodes_[candidate.second].motion);
    }
  }
  /// Part of the tree that is still to be looked at.
  struct Branch {
    std::size_t root;
    int depth;
    double distance2;  ///< At least, of what is in it.
  };
  void visit(Query& query) const {
    std::vector<Branch> open{{0, 0, 0.0}};
    while (!open.empty()) {
      const auto [index, depth, distance2] = open.back();
      open.pop_back();
      if (distance2 > query.limit) {
        continue;
      }
      offer_all_at(index, query);
      const Node& node = nodes_[index];
      const int near = side(node, query.p, depth);
      const double apart = query.p[depth % 3] - node.p[depth % 3];
      if (node.child[1 - near] != none) {
        open.push_back({node.child[1 - near], depth + 1, apart * apart});
      }
      if (node.child[near] != none) {
        open.push_back({node.child[near], depth + 1, 0.0});
      }
    }
  }
  /// The oldest first, up to the one that is no better than what was found: nor is any younger one.
  void offer_all_at(std::size_t index, Query& query) const {
    const double distance2 = (nodes_[index].p - query.p).squaredNorm();
    for (; index != none; index = nodes_[index].next_here) {
      if (!nodes_[index].removed && !offer({distance2, index}, query)) {
        return;
      }
    }
  }
  /// @return  Whether it is among the best.
  static bool offer(const std::pair<double, std::size_t>& candidate, Query& query) {
    const bool is_full = query.best.size() == query.k;
    if (candidate.first > query.limit || (is_full && candidate > query.best.front())) {
      return false;
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
    return true;
  }

  std::vector<Node> nodes_;
  std::size_t removed_{};
};

}  // namespace flyball
