// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/latency_model.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flyball {
namespace {

// Of each sample the next 200 or so still know something: 10 s of frames at 20 Hz.
constexpr double latency_forgetting = 0.995;
// Standard deviation of log latency from map to map of one setting: .07 to .25 in forests, rooms
// and congestion. Its square is the unit of the solver's covariance.
constexpr double noise = 0.15;
// How much less than the level the slopes are expected to be wrong: a level is off by a factor, a
// slope by some hundredths. Slopes that are freer follow the noise of a scene and mislead about
// settings that were not in force: with .3, mission_energy took 8 % more in a forest.
constexpr double slope_share = 0.045;
// The clock's is physics, and seldom varied enough to be told from the level.
constexpr double clock_share = 0.0045;

}  // namespace

LatencyModel::LatencyModel(const LatencyPrior& prior)
    : clock_{prior.clock},
      solver_{{std::log(prior.seconds), prior.slope, 1.0},
              prior.sigma / noise * Solver::Vector{1.0, slope_share, clock_share},
              latency_forgetting} {}

LatencyModel::Solver::Vector LatencyModel::row(const LatencyFeatures& features) const {
  FLYBALL_ASSERT(features.size > 0.0 && features.clock.value() > 0, "size=%g, clock=%g Hz",
                 features.size, features.clock.value());
  return {1.0, std::log(features.size), std::log(clock_.factor(features.clock))};
}

double LatencyModel::predict_log_s(const LatencyFeatures& features) const {
  return solver_.predict(row(features));
}

void LatencyModel::learn_log_s(const LatencyFeatures& features, double log_s) {
  solver_.learn(row(features), log_s);
}

double LatencyModels::predict_s(std::size_t kernel, const LatencyFeatures& features) const {
  FLYBALL_ASSERT(kernel < size(), "kernel=%zu of %zu", kernel, size());
  return std::exp(kernels_[kernel].model.predict_log_s(features) + log_slowdown_);
}

void LatencyModels::learn(std::size_t kernel, const LatencyFeatures& features, Duration measured) {
  FLYBALL_ASSERT(kernel < size() && measured > Duration::zero(), "kernel=%zu of %zu, measured=%g s",
                 kernel, size(), to_seconds(measured));
  LatencyModel& model = kernels_[kernel].model;
  const double log_s = std::log(to_seconds(measured));
  if (kernels_[kernel].samples >= first_samples) {
    log_slowdown_ += slowdown_step(log_s - model.predict_log_s(features) - log_slowdown_);
  }
  ++kernels_[kernel].samples;
  model.learn_log_s(features, log_s - log_slowdown_);
}

/// What both of the last two samples show is no chance if it is large.
double LatencyModels::slowdown_step(double residual) {
  const double before = std::exchange(residual_, residual);
  const double both = residual > 0.0 ? std::min(residual, before) : std::max(residual, before);
  const bool is_sudden = both * residual > 0.0 && std::abs(both) > surprise;
  if (is_sudden) {
    residual_ = 0.0;  // It is explained.
  }
  return is_sudden ? both : slowdown_gain * residual;
}

}  // namespace flyball
