// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/sender_clock.h"

#include <algorithm>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr double most_drift = 1e-4;     // Two crystals, each within 50 ppm (usual data sheets).
constexpr auto farthest_back = 1000ms;  // Messages overtake each other by less: it began anew.

}  // namespace

Duration SenderClock::made(std::uint32_t boot_ms, Duration heard) {
  const Duration said = std::chrono::milliseconds{boot_ms};
  const Duration ahead = heard - said;
  const bool began_anew = said + farthest_back < last_made_;
  if (!ahead_ || began_anew) {
    ahead_ = ahead;
  } else {
    const Duration drifted =
        *ahead_ + nearest_duration(most_drift * to_seconds(heard - last_heard_));
    ahead_ = std::min(drifted, ahead);
  }
  last_made_ = said;
  last_heard_ = heard;
  return said + *ahead_;
}

}  // namespace flyball
