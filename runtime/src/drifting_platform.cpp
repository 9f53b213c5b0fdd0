// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/modeled/drifting_platform.h"

#include "flyball/runtime/assert.h"

#include <utility>

namespace flyball {

DriftingPlatform::DriftingPlatform(const PlatformModel& nominal)
    : nominal_{nominal}, now_{std::make_shared<const ModeledPlatform>(nominal)} {}

void DriftingPlatform::set(const Strain& strain) {
  FLYBALL_ASSERT(strain.cost > 0.0 && strain.memory_cost > 0.0 && strain.taken_cores >= 0.0,
                 "cost=%g, memory_cost=%g, taken_cores=%g", strain.cost, strain.memory_cost,
                 strain.taken_cores);
  strain_ = strain;
  PlatformModel strained = nominal_;
  for (auto& [name, cost] : strained.kernels) {
    const auto one = strain.kernel_cost.find(name);
    cost.scale *= strain.cost * (one == strain.kernel_cost.end() ? 1.0 : one->second);
    cost.b *= strain.memory_cost;
  }
  auto next = std::make_shared<const ModeledPlatform>(std::move(strained));
  const std::lock_guard lock{mutex_};
  now_ = std::move(next);
}

std::shared_ptr<const ModeledPlatform> DriftingPlatform::now() const {
  const std::lock_guard lock{mutex_};
  return now_;
}

OperatingPoint DriftingPlatform::granted(const OperatingPoint& wanted) const {
  if (!strain_.clock_cap || !(*strain_.clock_cap < wanted.frequency)) {
    return wanted;
  }
  // A board has no clock between two of its own; the lowest one is always granted.
  Hertz best = nominal_.frequencies.empty() ? wanted.frequency : nominal_.frequencies.front();
  for (const Hertz clock : nominal_.frequencies) {
    if (!(*strain_.clock_cap < clock) && !(wanted.frequency < clock)) {
      best = clock;
    }
  }
  return {wanted.cores, best};
}

}  // namespace flyball
