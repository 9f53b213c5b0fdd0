// SPDX-License-Identifier: BSD-3-Clause
// flyball-link: flyball_ompl
//
// Probabilistic roadmap (Kavraki, Svestka, Latombe and Overmars 1996, doi:10.1109/70.508439) with
// A* (Hart, Nilsson and Raphael 1968, doi:10.1109/TSSC.1968.300136) on it. It is built for one
// question, for the map changes between two: as soon as start and goal are connected, the shortest
// path over the roadmap is taken.
//
// Rejected: OMPL's PRM looks for the solution in a thread of its own, so its plan depends on the
// host's load; its LazyPRM draws nearest neighbours from a process-wide seed.

#include "flyball/kernels/path_planner.h"
#include "flyball/runtime/registry.h"

#include "planning/ompl_kd_tree.h"
#include "planning/plan_sampler.h"
#include "planning/staged_search.h"
#include <algorithm>
#include <deque>
#include <functional>
#include <queue>
#include <utility>

namespace {

using flyball::Vec3;

/// A place of the roadmap. It stays where it is: its state points into it.
struct Milestone {
  explicit Milestone(const Vec3& at_W) : p_W{at_W} { holder.values = p_W.data(); }
  Milestone(const Milestone&) = delete;
  Milestone& operator=(const Milestone&) = delete;
  ~Milestone() = default;

  Vec3 p_W;
  ompl::base::RealVectorStateSpace::StateType holder{};
  const ompl::base::State* state{&holder};  ///< What the tree of neighbours looks at.
  std::size_t index{};
  std::size_t leader{};  ///< Of its part of the roadmap, or a node closer to the leader.
  std::vector<std::pair<std::size_t, double>> edges{};  ///< To whom, and how far [m].
};

class Roadmap {
 public:
  /// @param neighbours  To each of so many a new milestone is connected.
  Roadmap(const Vec3& start_W,
          const Vec3& goal_W,
          std::size_t neighbours,
          flyball::MotionChecker& checker)
      : neighbours_{neighbours}, checker_{checker} {
    add(start_W);
    add(goal_W);
  }

  /// Connects a free place with its nearest neighbours; nothing when it is a milestone already.
  void add(const Vec3& p_W) {
    Milestone& fresh = milestones_.emplace_back(p_W);
    fresh.index = fresh.leader = milestones_.size() - 1;
    std::vector<Milestone*> near;
    tree_.nearestK(&fresh, neighbours_, near);
    if (!near.empty() && near.front()->p_W == p_W) {
      milestones_.pop_back();
      return;
    }
    for (Milestone* other : near) {
      if (checker_.is_flyable(other->p_W, fresh.p_W)) {
        const double length_m = (other->p_W - fresh.p_W).norm();
        fresh.edges.emplace_back(other->index, length_m);
        other->edges.emplace_back(fresh.index, length_m);
        milestones_[leader(other->index)].leader = leader(fresh.index);
      }
    }
    tree_.add(&fresh);
  }

  [[nodiscard]] bool is_connected() { return leader(start) == leader(goal); }

  /// @pre Start and goal are connected.
  [[nodiscard]] std::vector<Vec3> shortest_path() const {
    std::vector<Vec3> points_W;
    const std::vector<std::size_t> before = search();
    for (std::size_t at = goal; at != start; at = before[at]) {
      points_W.push_back(milestones_[at].p_W);
    }
    points_W.push_back(milestones_[start].p_W);
    std::reverse(points_W.begin(), points_W.end());
    return points_W;
  }

 private:
  static constexpr std::size_t start = 0;
  static constexpr std::size_t goal = 1;

  std::size_t leader(std::size_t of) {
    while (milestones_[of].leader != of) {
      milestones_[of].leader = milestones_[milestones_[of].leader].leader;
      of = milestones_[of].leader;
    }
    return of;
  }

  /// A*; who was reached from where. Of equally promising milestones the older one goes first.
  [[nodiscard]] std::vector<std::size_t> search() const {
    constexpr double far = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> before(milestones_.size(), start);
    std::vector<double> reached_m(milestones_.size(), far);
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const auto open_up = [&](std::size_t at, std::size_t from, double path_m) {
      if (path_m < reached_m[at]) {
        reached_m[at] = path_m;
        before[at] = from;
        open.emplace(path_m + (milestones_[at].p_W - milestones_[goal].p_W).norm(), at);
      }
    };
    open_up(start, start, 0.0);
    while (!open.empty() && open.top().second != goal) {
      const std::size_t at = open.top().second;
      open.pop();
      for (const auto& [to, length_m] : milestones_[at].edges) {
        open_up(to, at, reached_m[at] + length_m);
      }
    }
    return before;
  }

  std::size_t neighbours_;
  flyball::MotionChecker& checker_;
  std::deque<Milestone> milestones_{};
  flyball::KdTree<Milestone*> tree_{};
};

// Each iteration draws one sample.
flyball::StageResult search(std::size_t neighbours,
                            const flyball::SearchStage& stage,
                            flyball::MotionChecker& checker) {
  flyball::StageResult result;
  flyball::PlanSampler sampler{
      checker, {stage.box_W, stage.start_W, stage.goal_W, stage.shorter_than_m}, stage.seed};
  Roadmap roadmap{stage.start_W, stage.goal_W, neighbours, checker};
  while (!roadmap.is_connected() && sampler.draws() < stage.max_iterations) {
    const Vec3 p_W = sampler.draw();
    if (checker.is_free(p_W)) {
      roadmap.add(p_W);
    }
  }
  result.iterations = sampler.draws();
  if (roadmap.is_connected()) {
    result.points_W = roadmap.shortest_path();
  }
  return result;
}

class Prm final : public flyball::PathPlanner {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"neighbours", 10.0, 1.0, 100.0,
             "a new place is connected with so many at most; OMPL's default"}};
  }
  flyball::Status configure(const flyball::Parameters& chosen,
                            const flyball::FindModel& /*find_model*/) override {
    neighbours_ = static_cast<std::size_t>(chosen.number("neighbours"));
    return flyball::Done{};
  }

  flyball::Plan plan(const flyball::PlanRequest& request,
                     const flyball::OccupancyView& map) override {
    return flyball::staged_plan(
        request, map, [this](const flyball::SearchStage& stage, flyball::MotionChecker& checker) {
          return search(neighbours_, stage, checker);
        });
  }

 private:
  std::size_t neighbours_{10};
};

}  // namespace

FLYBALL_PLUGIN(prm) {
  registry.add<flyball::PathPlanner>("prm", [] { return std::make_unique<Prm>(); });
}
