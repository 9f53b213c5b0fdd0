// SPDX-License-Identifier: BSD-3-Clause
//
// Receding-horizon next-best view (Bircher et al. 2016, doi:10.1109/ICRA.2016.7487281): a random
// tree of poses in known-free space; each node counts the unknown space that it would show, less
// the farther it is; the first edge towards the best node is flown, and the rest of that branch
// begins the next tree. When the tree finds little, the best view of any frontier is next, to be
// flown to by a planner.

#include "flyball/kernels/explorer.h"
#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"

#include "planning/frontier_views.h"
#include <algorithm>
#include <cmath>

namespace {

using flyball::CellState;
using flyball::ExploreRequest;
using flyball::ExploreStep;
using flyball::Vec3;
using flyball::Viewpoint;

constexpr double two_pi = 6.283185307179586;
// Chosen by hand.
constexpr double view_step_m = 0.075;  // Half a fine cell, so that nothing fits between two poses.
constexpr int tries_per_node = 25;     // In a corner hardly any sample is free.
constexpr double branch_slack_m =
    0.5;  // The old branch is used if it begins this near to the vehicle.
constexpr double usually_worthwhile_m3 = 1.0;
constexpr double least_m3 = 0.1;  // A view of a frontier that shows less is noise.

struct Node {
  Viewpoint view{};
  int parent{-1};
  double path_m{};
  bool is_spent{};  ///< Shows nothing that was not looked for already.
  double own_m3{};
  double score_m3{};  ///< Eq. 3: along the branch, discounted.
};

class Tree {
 public:
  Tree(const ExploreRequest& request,
       const flyball::OccupancyView& map,
       const flyball::StateGrid& grid)
      : request_{request},
        map_{map},
        gain_{grid, request.volume_W, request.field, request.settings.threads},
        random_{request.seed, "nbvp"} {
    nodes_.push_back({request.from});
    for (Eigen::Index i = 0; i < 3; ++i) {
      low_W_[i] = std::max(request.bounds_W.min[i], request.volume_W.min[i]);
      high_W_[i] = std::min(request.bounds_W.max[i], request.volume_W.max[i]);
    }
  }

  /// Begins with what is left of a branch.
  void keep(const std::vector<Viewpoint>& branch) {
    int parent = 0;
    for (const Viewpoint& view : branch) {
      if (!is_free(node(parent).view.p_W, view.p_W)) {
        return;
      }
      parent = add(view, parent);
    }
  }

  /// Until there are enough nodes and one of them has a gain. Where the nodes lie does not depend
  /// on their gains, so that several can be looked at together.
  void grow() {
    const flyball::ExploreSettings& settings = request_.settings;
    const int most = std::max(settings.most_iterations, settings.iterations);
    const int most_tries = tries_per_node * most;
    least_ = std::max(settings.iterations, size());
    for (int tries = 0; tries < most_tries && size() < most; ++tries) {
      const int unseen = size() - seen_;
      if (size() >= least_ && (seen_ < least_ || unseen >= settings.threads)) {
        look();
        if (node(best_).score_m3 > 0.0) {
          return;
        }
      }
      extend();
    }
    look();
  }

  /// From the first node behind the root to the best one; empty without any gain.
  [[nodiscard]] std::vector<Viewpoint> best_branch() const {
    std::vector<Viewpoint> branch;
    for (int i = best_; i > 0; i = node(i).parent) {
      branch.insert(branch.begin(), node(i).view);
    }
    return branch;
  }
  /// Undiscounted, of the best node's branch.
  [[nodiscard]] double best_m3() const {
    double most_m3 = 0.0;
    for (int i = best_; i > 0; i = node(i).parent) {
      most_m3 = std::max(most_m3, node(i).own_m3);
    }
    return most_m3;
  }
  [[nodiscard]] flyball::ViewGain& gain() { return gain_; }
  void count(flyball::Work& work) const {
    work.add("iterations", static_cast<double>(size()));
    work.add("collision_queries", queries_);
    work.add_shared("cells", gain_.cells());
    work.add_shared("ray_cells", gain_.ray_cells());
  }

 private:
  [[nodiscard]] const Node& node(int i) const { return nodes_[static_cast<std::size_t>(i)]; }
  /// Without the root.
  [[nodiscard]] int size() const { return static_cast<int>(nodes_.size()) - 1; }

  void extend() {
    Vec3 sample_W;
    for (Eigen::Index i = 0; i < 3; ++i) {
      sample_W[i] = random_.uniform(low_W_[i], high_W_[i]);
    }
    const double yaw_rad = random_.uniform(-0.5 * two_pi, 0.5 * two_pi);
    const int from = nearest(sample_W);
    const Vec3 to_W = steered(node(from).view.p_W, sample_W);
    if (is_free(node(from).view.p_W, to_W)) {
      add({to_W, yaw_rad}, from);
    }
  }

  [[nodiscard]] int nearest(const Vec3& p_W) const {
    int best = 0;
    for (int i = 1; i < static_cast<int>(nodes_.size()); ++i) {
      const double apart = (node(i).view.p_W - p_W).squaredNorm();
      best = apart < (node(best).view.p_W - p_W).squaredNorm() ? i : best;
    }
    return best;
  }

  /// Towards the sample, no farther than an edge is long and no steeper than may be flown.
  [[nodiscard]] Vec3 steered(const Vec3& from_W, const Vec3& sample_W) const {
    Vec3 step = sample_W - from_W;
    const double rise_m = std::tan(request_.max_slope_rad) * step.head<2>().norm();
    step.z() = std::clamp(step.z(), -rise_m, rise_m);
    return from_W + step * std::min(1.0, request_.settings.extension_m / step.norm());
  }

  bool is_free(const Vec3& from_W, const Vec3& to_W) {
    const double length_m = (to_W - from_W).norm();
    const int steps = std::max(1, static_cast<int>(std::ceil(length_m / view_step_m)));
    // The root is where the vehicle stands, free or not.
    for (int i = 1; i <= steps; ++i) {
      queries_ += 1.0;
      const Vec3 p_W = from_W + (to_W - from_W) * i / steps;
      if (map_.body_state(p_W, request_.body) != CellState::free) {
        return false;
      }
    }
    return true;
  }

  int add(const Viewpoint& view, int parent) {
    Node added;
    added.view = view;
    added.parent = parent;
    added.path_m = node(parent).path_m + (view.p_W - node(parent).view.p_W).norm();
    added.is_spent = flyball::is_spent(request_, view);
    nodes_.push_back(added);
    return size();
  }

  /// What the nodes show that were added since the last look. Behind the first gain those are
  /// dropped that would not be there, had each been looked at before the next one was added.
  void look() {
    std::vector<Viewpoint> views;
    for (int i = seen_ + 1; i <= size(); ++i) {
      if (!node(i).is_spent) {
        views.push_back(node(i).view);
      }
    }
    const std::vector<double> gains_m3 = gain_.gains_m3(views);
    auto gain_m3 = gains_m3.begin();
    while (seen_ < size()) {
      ++seen_;
      rate(seen_, node(seen_).is_spent ? 0.0 : *gain_m3++);
      if (seen_ >= least_ && node(best_).score_m3 > 0.0) {
        nodes_.resize(static_cast<std::size_t>(seen_) + 1);
      }
    }
  }

  void rate(int index, double gain_m3) {
    Node& rated = nodes_[static_cast<std::size_t>(index)];
    rated.own_m3 = gain_m3;
    const double discount = std::exp(-request_.settings.discount_1_m * rated.path_m);
    rated.score_m3 = node(rated.parent).score_m3 + gain_m3 * discount;  // eq. 3
    best_ = rated.score_m3 > node(best_).score_m3 ? index : best_;
  }

  const ExploreRequest& request_;
  const flyball::OccupancyView& map_;
  flyball::ViewGain gain_;
  flyball::RandomStream random_;
  Vec3 low_W_{Vec3::Zero()};
  Vec3 high_W_{Vec3::Zero()};
  std::vector<Node> nodes_{};
  int least_{};  ///< With so many, a gain is enough.
  int seen_{};   ///< Nodes whose gain is known.
  int best_{};
  double queries_{};
};

/// The volume, and where the body may be to look at it.
flyball::Aabb explored_box(const ExploreRequest& request) {
  constexpr double around_m = 5.0;  // Chosen: less than the range of the camera.
  const Vec3 around = Vec3::Constant(around_m);
  flyball::Aabb box = request.bounds_W;
  box.min = box.min.cwiseMax(request.volume_W.min - around).cwiseMin(request.volume_W.min);
  box.max = box.max.cwiseMin(request.volume_W.max + around).cwiseMax(request.volume_W.max);
  return box;
}

bool is_finite(const ExploreRequest& request) {
  return request.from.p_W.allFinite() && std::isfinite(request.from.yaw_rad) &&
         request.volume_W.min.allFinite() && request.volume_W.max.allFinite() &&
         request.bounds_W.min.allFinite() && request.bounds_W.max.allFinite();
}

class Nbvp final : public flyball::Explorer {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"worthwhile_m3", usually_worthwhile_m3, 0.0, 1000.0,
             "a tree that shows less is left for the frontiers: a step costs seconds, whatever it "
             "shows"}};
  }
  flyball::Status configure(const flyball::Parameters& chosen,
                            const flyball::FindModel& /*find_model*/) override {
    worthwhile_m3_ = chosen.number("worthwhile_m3");
    return flyball::Done{};
  }

  ExploreStep explore(const ExploreRequest& request, const flyball::OccupancyView& map) override {
    if (!is_finite(request)) {
      return {};
    }
    const flyball::StateGrid grid{map, explored_box(request), request.settings.threads};
    Tree tree{request, map, grid};
    if (!branch_.empty() && (branch_.front().p_W - request.from.p_W).norm() < branch_slack_m) {
      tree.keep({branch_.begin() + 1, branch_.end()});
    }
    tree.grow();
    ExploreStep step;
    branch_ = tree.best_branch();
    step.gain_m3 = tree.best_m3();
    if (!branch_.empty() && step.gain_m3 >= worthwhile_m3_) {
      step.next = branch_.front();
    } else {
      look_far(request, grid, tree.gain(), step);
    }
    tree.count(step.work);
    return step;
  }

 private:
  void look_far(const ExploreRequest& request,
                const flyball::StateGrid& grid,
                flyball::ViewGain& gain,
                ExploreStep& step) {
    const flyball::StandingPlaces places{grid, request.body, request.bounds_W, request.from.p_W};
    double ray_cells = 0.0;
    const auto found =
        flyball::best_frontier_view(request, places, gain, {least_m3, worthwhile_m3_}, ray_cells);
    step.work.add("cells", places.cells());
    step.work.add_shared("cells", static_cast<double>(grid.size()));
    step.work.add_shared("ray_cells", ray_cells);
    branch_.clear();
    step.gain_m3 = found ? found->gain_m3 : 0.0;
    step.is_far = found.has_value();
    if (found) {
      step.next = found->view;
    }
  }

  double worthwhile_m3_{usually_worthwhile_m3};
  std::vector<Viewpoint> branch_{};  ///< The last step's, from its first node on.
};

}  // namespace

FLYBALL_PLUGIN(nbvp) {
  registry.add<flyball::Explorer>("nbvp", [] { return std::make_unique<Nbvp>(); });
}
