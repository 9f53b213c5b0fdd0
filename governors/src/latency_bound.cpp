// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/latency_bound.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>

namespace flyball {

QuantileTracker::QuantileTracker(const Settings& settings)
    : settings_{settings}, q_{settings.first} {
  FLYBALL_ASSERT(settings.alpha > 0.0 && settings.alpha < 1.0 && settings.eta >= 0.0,
                 "alpha=%g, eta=%g", settings.alpha, settings.eta);
}

double QuantileTracker::factor() const {
  return std::exp(q_);
}

void QuantileTracker::count(bool missed) {
  q_ += settings_.eta * ((missed ? 1.0 : 0.0) - settings_.alpha);  // eq. (1)
  ++decisions_;
  misses_ += missed ? 1 : 0;
}

std::optional<double> QuantileTracker::most_misses(double worst) const {
  FLYBALL_ASSERT(worst > 0.0, "worst=%g", worst);
  if (settings_.eta == 0.0) {
    return std::nullopt;
  }
  // B is no less than q_1: else q falls from the start, and (3) would allow less than it began
  // with.
  const double largest = std::max(std::log(worst), settings_.first) + settings_.eta;
  return settings_.alpha * static_cast<double>(decisions_) +
         (largest - settings_.first) / settings_.eta;  // eq. (3), times T
}

MissionTime LatencyBound::Open::expires() const {
  return issued + from_seconds(bound_s * factor);
}

LatencyBound::LatencyBound(std::size_t levels, const QuantileTracker::Settings& settings)
    : trackers_(levels, QuantileTracker{settings}) {
  FLYBALL_ASSERT(levels >= 1, "levels=%zu", levels);
}

Duration LatencyBound::bound(std::size_t level, Duration predicted) const {
  FLYBALL_ASSERT(level < levels() && predicted > Duration::zero(), "level=%zu, predicted=%g s",
                 level, to_seconds(predicted));
  return from_seconds(to_seconds(predicted) * trackers_[level].factor());
}

void LatencyBound::close(bool missed) {
  trackers_[open_->level].count(missed);
  open_.reset();
}

void LatencyBound::issue(std::size_t level, MissionTime now, Duration predicted) {
  const Duration bounded = bound(level, predicted);
  if (open_) {
    close(true);
  }
  open_ = Open{level, now, to_seconds(bounded), 1.0};
}

void LatencyBound::regrant(double factor) {
  FLYBALL_ASSERT(factor > 0.0, "factor=%g", factor);
  if (open_) {
    open_->factor = factor;
  }
}

void LatencyBound::widen(std::size_t level, Duration predicted) {
  const double bound_s = to_seconds(bound(level, predicted));
  if (open_ && bound_s > open_->bound_s) {
    open_->level = level;
    open_->bound_s = bound_s;
  }
}

void LatencyBound::settle(MissionTime ended) {
  if (open_) {
    close(ended > open_->expires());
  }
}

void LatencyBound::expire(MissionTime now) {
  if (open_ && open_->expires() < now) {
    close(true);
  }
}

}  // namespace flyball
