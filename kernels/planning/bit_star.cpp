// SPDX-License-Identifier: BSD-3-Clause
// flyball-link: flyball_ompl
//
// BIT* (Gammell, Srinivasa and Barfoot 2015, doi:10.1109/ICRA.2015.7139620): batches of samples,
// whose edges are looked at in the order of the paths that they may give. An iteration looks at one
// edge or adds one batch.

#include "flyball/kernels/path_planner.h"
#include "flyball/runtime/registry.h"

#include "planning/improving_stop.h"
#include "planning/ompl_search.h"
#include "planning/staged_search.h"
#include <array>
#include <set>

#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/samplers/InformedStateSampler.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/informedtrees/bitstar/ImplicitGraph.h>
#include <ompl/geometric/planners/informedtrees/bitstar/Vertex.h>

// OMPL defines these two for its own trees only, inside its library.
template <>
void ompl::geometric::BITstar::ImplicitGraph::setNearestNeighbors<flyball::KdTree>() {
  samples_ = std::make_shared<flyball::KdTree<VertexPtr>>();
}
template <>
void ompl::geometric::BITstar::setNearestNeighbors<flyball::KdTree>() {
  graphPtr_->setNearestNeighbors<flyball::KdTree>();
}

namespace {

namespace ob = ompl::base;

constexpr unsigned most_throws = 100;  // For one sample among those that can improve a path.

/// Draws from the sampler of all planners here; OMPL's own would be seeded by the process. That one
/// repeats the places at passages, for the sake of trees that grow towards them; here many samples
/// in one place would be each other's nearest neighbours, and none would look through the passage.
class Informed final : public ob::InformedSampler {
 public:
  Informed(const ob::ProblemDefinitionPtr& problem, unsigned throws)
      : InformedSampler{problem, throws}, sampler_{space_->allocStateSampler()} {}

  bool sampleUniform(ob::State* state, const ob::Cost& most) override {
    return sampleUniform(state, ob::Cost{0.0}, most);
  }
  bool sampleUniform(ob::State* state, const ob::Cost& least, const ob::Cost& most) override {
    for (unsigned i = 0; i < numIters_; ++i) {
      sampler_->sampleUniform(state);
      const double cost = heuristicSolnCost(state).value();
      const bool wanted = cost >= least.value() && cost < most.value();
      const flyball::Vec3 p_W = flyball::position_of(state);
      if (wanted && places_.insert({p_W.x(), p_W.y(), p_W.z()}).second) {
        return true;
      }
    }
    return false;
  }
  [[nodiscard]] bool hasInformedMeasure() const override { return false; }
  [[nodiscard]] double getInformedMeasure(const ob::Cost&) const override {
    return space_->getMeasure();
  }

 private:
  ob::StateSamplerPtr sampler_;
  std::set<std::array<double, 3>> places_{};
};

class Length final : public ob::PathLengthOptimizationObjective {
 public:
  explicit Length(const ob::SpaceInformationPtr& space) : PathLengthOptimizationObjective{space} {
    setCostToGoHeuristic(ob::goalRegionCostToGo);
  }
  [[nodiscard]] ob::InformedSamplerPtr allocInformedStateSampler(
      const ob::ProblemDefinitionPtr& problem, unsigned) const override {
    return std::make_shared<Informed>(problem, most_throws);
  }
};

flyball::StageResult search(unsigned samples_per_batch,
                            const flyball::SearchStage& stage,
                            flyball::MotionChecker& checker) {
  using Planner = ompl::geometric::BITstar;
  return flyball::search_with_ompl<Planner>(
      stage, checker,
      [samples_per_batch](Planner& planner) {
        planner.getProblemDefinition()->setOptimizationObjective(
            std::make_shared<Length>(planner.getSpaceInformation()));
        planner.setSamplesPerBatch(samples_per_batch);
      },
      flyball::ImprovingStop{stage.max_iterations},
      [](const Planner& planner, const flyball::PlanSampler&) {
        return static_cast<int>(planner.numIterations());
      });
}

class BitStar final : public flyball::PathPlanner {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"samples_per_batch", 100.0, 1.0, 10000.0, "as the paper, and OMPL's default"}};
  }
  flyball::Status configure(const flyball::Parameters& chosen,
                            const flyball::FindModel& /*find_model*/) override {
    samples_per_batch_ = static_cast<unsigned>(chosen.number("samples_per_batch"));
    return flyball::Done{};
  }

  flyball::Plan plan(const flyball::PlanRequest& request,
                     const flyball::OccupancyView& map) override {
    return flyball::staged_plan(
        request, map, [this](const flyball::SearchStage& stage, flyball::MotionChecker& checker) {
          return search(samples_per_batch_, stage, checker);
        });
  }

 private:
  unsigned samples_per_batch_{100};
};

}  // namespace

FLYBALL_PLUGIN(bit_star) {
  registry.add<flyball::PathPlanner>("bit_star", [] { return std::make_unique<BitStar>(); });
}
