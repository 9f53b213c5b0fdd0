// SPDX-License-Identifier: BSD-3-Clause
#include "vehicles/sender_clock.h"

#include <algorithm>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr auto part = 500ms;  // Chosen: 25 messages, of which one did not wait.
// A longer pause is none of listening: what comes after it is old, and has to be known as such.
constexpr auto longest_step = 100ms;
constexpr auto farthest_back = 1000ms;  // Messages overtake each other by less: it began anew.

}  // namespace

/// Whoever listens for long enough forgets how the clock stood before.
void SenderClock::listen(Duration heard) {
  part_ += std::min<Duration>(heard - last_heard_, longest_step);
  last_heard_ = heard;
  if (part_ >= part) {
    part_ = Duration::zero();
    before_ = ahead_;
    ahead_.reset();
  }
}

Duration SenderClock::made(std::uint32_t boot_ms, Duration heard) {
  const Duration said = std::chrono::milliseconds{boot_ms};
  const bool began_anew = said + farthest_back < last_made_;
  if (began_anew) {
    ahead_.reset();
    before_.reset();
  }
  listen(heard);
  const Duration ahead = heard - said;
  ahead_ = std::min(ahead_.value_or(ahead), ahead);
  last_made_ = said;
  return said + std::min(*ahead_, before_.value_or(*ahead_));
}

}  // namespace flyball
