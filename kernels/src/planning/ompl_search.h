// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Runs an OMPL tree planner in R^3 as a pure function of stage and map: own sampler, own motion
/// check, own nearest neighbours, own seed, and a stop that counts iterations.

#include "planning/motion_checker.h"
#include "planning/ompl_kd_tree.h"
#include "planning/plan_sampler.h"
#include "planning/staged_search.h"
#include <exception>
#include <functional>
#include <memory>
#include <vector>

#include <ompl/base/MotionValidator.h>
#include <ompl/base/PlannerTerminationCondition.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateSampler.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/util/Console.h>

namespace flyball {

inline Vec3 position_of(const ompl::base::State* state) {
  const double* values = state->as<ompl::base::RealVectorStateSpace::StateType>()->values;
  return {values[0], values[1], values[2]};
}

inline void assign(ompl::base::State* state, const Vec3& p_W) {
  Vec3::Map(state->as<ompl::base::RealVectorStateSpace::StateType>()->values) = p_W;
}

class OmplMotionValidator final : public ompl::base::MotionValidator {
 public:
  OmplMotionValidator(ompl::base::SpaceInformation* space, MotionChecker& checker)
      : MotionValidator{space}, checker_{checker} {}
  bool checkMotion(const ompl::base::State* from, const ompl::base::State* to) const override {
    return checker_.is_flyable(position_of(from), position_of(to));
  }
  bool checkMotion(const ompl::base::State* from,
                   const ompl::base::State* to,
                   std::pair<ompl::base::State*, double>& last_valid) const override {
    const bool flyable = checkMotion(from, to);
    last_valid.second =
        flyable ? 1.0 : 0.0;  // Sound, if pessimistic: no piece of it counts as free.
    if (last_valid.first != nullptr) {
      si_->copyState(last_valid.first, flyable ? to : from);
    }
    return flyable;
  }

 private:
  MotionChecker& checker_;
};

class OmplStateSampler final : public ompl::base::StateSampler {
 public:
  OmplStateSampler(const ompl::base::StateSpace* space, PlanSampler& sampler, std::uint64_t seed)
      : StateSampler{space}, sampler_{sampler}, random_{seed, "ompl_state_sampler"} {}
  void sampleUniform(ompl::base::State* state) override { assign(state, sampler_.draw()); }
  void sampleUniformNear(ompl::base::State* state,
                         const ompl::base::State* near,
                         double distance) override {
    scatter(state, near, [&] { return random_.uniform(-distance, distance); });
  }
  void sampleGaussian(ompl::base::State* state,
                      const ompl::base::State* mean,
                      double deviation) override {
    scatter(state, mean, [&] { return deviation * random_.normal(); });
  }

 private:
  void scatter(ompl::base::State* state,
               const ompl::base::State* around,
               const std::function<double()>& offset) {
    const double x = offset();
    const double y = offset();
    assign(state, position_of(around) + Vec3{x, y, offset()});
    space_->enforceBounds(state);
  }

  PlanSampler& sampler_;
  RandomStream random_;
};

/// An OMPL planner whose generator does not depend on how many others were made before. (BIT* has
/// none of its own.)
template <class Planner>
class Seeded final : public Planner {
 public:
  Seeded(const ompl::base::SpaceInformationPtr& space, std::uint64_t seed) : Planner{space} {
    seed_generator(*this, static_cast<std::uint_fast32_t>(seed & 0x7fffffffU), 0);
  }

 private:
  template <class P>
  static auto seed_generator(P& planner, std::uint_fast32_t seed, int)
      -> decltype(planner.rng_.setLocalSeed(seed)) {
    planner.rng_.setLocalSeed(seed);
  }
  template <class P>
  static void seed_generator(P&, std::uint_fast32_t, long) {}
};

inline ompl::base::SpaceInformationPtr make_space(const SearchStage& stage,
                                                  MotionChecker& checker,
                                                  PlanSampler& sampler) {
  namespace ob = ompl::base;
  auto space = std::make_shared<ob::RealVectorStateSpace>(3);
  ob::RealVectorBounds bounds{3};
  for (unsigned i = 0; i < 3; ++i) {
    bounds.setLow(i, stage.box_W.min[i]);
    bounds.setHigh(i, stage.box_W.max[i]);
  }
  space->setBounds(bounds);
  auto information = std::make_shared<ob::SpaceInformation>(space);
  information->setStateValidityChecker(
      [&checker](const ob::State* state) { return checker.is_free(position_of(state)); });
  information->setMotionValidator(
      std::make_shared<OmplMotionValidator>(information.get(), checker));
  information->setup();
  // Only now: set-up draws samples too, for projections that tree planners do not use.
  space->setStateSamplerAllocator([&sampler, seed = stage.seed](const ob::StateSpace* of) {
    return std::make_shared<OmplStateSampler>(of, sampler, seed);
  });
  return information;
}

inline ompl::base::ProblemDefinitionPtr make_problem(const ompl::base::SpaceInformationPtr& space,
                                                     const SearchStage& stage) {
  ompl::base::ScopedState<> start{space};
  ompl::base::ScopedState<> goal{space};
  assign(start.get(), stage.start_W);
  assign(goal.get(), stage.goal_W);
  auto problem = std::make_shared<ompl::base::ProblemDefinition>(space);
  problem->setStartAndGoalStates(start, goal);
  return problem;
}

/// Empty unless the solution reaches the goal.
inline std::vector<Vec3> solution_of(const ompl::base::ProblemDefinition& problem) {
  std::vector<Vec3> points_W;
  if (problem.hasExactSolution()) {
    auto* path = problem.getSolutionPath()->as<ompl::geometric::PathGeometric>();
    for (const auto* state : path->getStates()) {
      points_W.push_back(position_of(state));
    }
  }
  return points_W;
}

/// One planner on one stage.
///
/// @param configure  Sets the planner's parameters.
/// @param is_done    Asked once per iteration, with the planner and the number of samples drawn.
/// @param iterations How many iterations the planner has made.
template <class Planner, class Configure, class IsDone, class Iterations>
StageResult search_with_ompl(const SearchStage& stage,
                             MotionChecker& checker,
                             Configure configure,
                             IsDone is_done,
                             Iterations iterations) {
  StageResult result;
  try {
    ompl::msg::noOutputHandler();  // For the whole process: libraries do not print.
    PlanSampler sampler{
        checker, {stage.box_W, stage.start_W, stage.goal_W, stage.shorter_than_m}, stage.seed};
    const auto space = make_space(stage, checker, sampler);
    const auto problem = make_problem(space, stage);
    Seeded<Planner> planner{space, stage.seed};
    planner.setProblemDefinition(problem);
    configure(planner);
    planner.template setNearestNeighbors<KdTree>();
    planner.solve(
        ompl::base::PlannerTerminationCondition{[&] { return is_done(planner, sampler); }});
    result.points_W = solution_of(*problem);
    result.iterations = iterations(planner, sampler);
  } catch (const std::exception& error) {
    result.error = std::string{"planner broke down: "} + error.what();
  }
  return result;
}

}  // namespace flyball
