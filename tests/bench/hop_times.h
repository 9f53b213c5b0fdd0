// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How long a message takes from the job that publishes it to the one that it starts.

#include "flyball/runtime/quantile.h"

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace flyball::bench {

inline std::int64_t now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// What goes to and fro: when it was sent.
struct Ball {
  std::int64_t sent_ns{};
};

/// Filled by both players in turn; its memory is there before the first hop.
class HopTimes {
 public:
  explicit HopTimes(std::size_t hops) : warm_{hops / 10}, most_{hops + hops / 10} {
    times_us_.reserve(hops);
  }
  /// The ball has arrived; whether it goes back.
  bool note(const Ball& ball) {
    const auto hop_us = static_cast<double>(now_ns() - ball.sent_ns) * 1e-3;
    if (count_++ >= warm_ && times_us_.size() < times_us_.capacity()) {
      times_us_.push_back(hop_us);
    }
    return count_ < most_;
  }
  [[nodiscard]] bool is_warm() const { return count_ >= warm_; }
  [[nodiscard]] double quantile_us(double share) const { return quantile(times_us_, share); }

 private:
  std::size_t warm_;
  std::size_t most_;
  std::size_t count_{};
  std::vector<double> times_us_{};
};

}  // namespace flyball::bench
