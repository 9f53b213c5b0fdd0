// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/latency_bound.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>

namespace flyball {

QuantileTracker::QuantileTracker(const Settings& settings)
    : settings_{settings}, q_{settings.first}, first_{settings.first} {
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

std::optional<double> QuantileTracker::most_misses(double worst, std::size_t open) const {
  FLYBALL_ASSERT(worst > 0.0 && open >= 1, "worst=%g, open=%zu", worst, open);
  if (settings_.eta == 0.0) {
    return std::nullopt;
  }
  // B is no less than q_1: else q falls from the start, and (3) would allow less than it began
  // with.
  const double largest =
      std::max(std::log(worst), first_) + static_cast<double>(open) * settings_.eta;
  return settings_.alpha * static_cast<double>(decisions_) +
         (largest - first_) / settings_.eta;  // eq. (3), times T
}

void QuantileTracker::restore(double q) {
  FLYBALL_ASSERT(std::isfinite(q), "q=%g", q);
  q_ = q;
  first_ = q;
}

MissionTime LatencyBound::Open::expires() const {
  return issued + from_seconds(bound_s * factor);
}

LatencyBound::LatencyBound(std::size_t levels,
                           std::size_t open_max,
                           const QuantileTracker::Settings& settings)
    : trackers_(levels, QuantileTracker{settings}), open_max_{open_max} {
  FLYBALL_ASSERT(levels >= 1 && open_max >= 1, "levels=%zu, open_max=%zu", levels, open_max);
  open_.reserve(open_max);
}

Duration LatencyBound::bound(std::size_t level, Duration predicted) const {
  FLYBALL_ASSERT(level < levels() && predicted > Duration::zero(), "level=%zu, predicted=%g s",
                 level, to_seconds(predicted));
  return from_seconds(to_seconds(predicted) * trackers_[level].factor());
}

LatencyBound::Ticket LatencyBound::issue(std::size_t level, MissionTime now, Duration predicted) {
  const Duration bounded = bound(level, predicted);
  expire(now);
  if (open_.size() == open_max_) {
    close(0, true);
  }
  open_.push_back({next_, level, now, to_seconds(bounded), 1.0});
  return next_++;
}

LatencyBound::Open* LatencyBound::find(Ticket ticket) {
  const auto found = std::find_if(open_.begin(), open_.end(),
                                  [ticket](const Open& open) { return open.ticket == ticket; });
  return found == open_.end() ? nullptr : &*found;
}

void LatencyBound::close(std::size_t position, bool missed) {
  trackers_[open_[position].level].count(missed);
  open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(position));
}

void LatencyBound::regrant(Ticket ticket, double factor) {
  FLYBALL_ASSERT(factor > 0.0, "factor=%g", factor);
  if (Open* open = find(ticket)) {
    open->factor = factor;
  }
}

void LatencyBound::widen(Ticket ticket, std::size_t level, Duration predicted) {
  const double bound_s = to_seconds(bound(level, predicted));
  if (Open* open = find(ticket); open != nullptr && bound_s > open->bound_s) {
    open->level = level;
    open->bound_s = bound_s;
  }
}

void LatencyBound::settle(Ticket ticket, MissionTime ended) {
  if (const Open* open = find(ticket)) {
    close(static_cast<std::size_t>(open - open_.data()), ended > open->expires());
  }
}

void LatencyBound::expire(MissionTime now) {
  std::size_t i = 0;
  while (i < open_.size()) {
    if (open_[i].expires() < now) {
      close(i, true);
    } else {
      ++i;
    }
  }
}

}  // namespace flyball
