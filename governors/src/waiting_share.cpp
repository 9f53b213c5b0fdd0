// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/waiting_share.h"

#include "flyball/runtime/assert.h"

#include <cmath>

namespace flyball {
namespace {

constexpr double memory_s = 60.0;  // Chosen: several legs of an exploration, few of a delivery.

}  // namespace

bool stands_in_cruise(const Observation& seen) {
  constexpr double standing_m_s = 0.1;  // Chosen: slower than any cruise.
  return seen.phase == MissionPhase::cruise && !(seen.speed_m_s > standing_m_s);
}

void WaitingShare::note(const Observation& seen) {
  if (seen.phase != MissionPhase::cruise) {
    last_.reset();
    return;
  }
  const double dt_s = last_ ? to_seconds(seen.now - *last_) : 0.0;
  last_ = seen.now;
  if (dt_s > 0.0) {
    const double stands = stands_in_cruise(seen) ? 1.0 : 0.0;
    share_ += (1.0 - std::exp(-dt_s / memory_s)) * (stands - share_);
  }
}

double WaitingShare::delay(double clock_hz, double top_hz) const {
  FLYBALL_ASSERT(clock_hz > 0.0 && clock_hz <= top_hz, "clock_hz=%g, top_hz=%g", clock_hz, top_hz);
  return 1.0 + share_ * (top_hz / clock_hz - 1.0);
}

}  // namespace flyball
