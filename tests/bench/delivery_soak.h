// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

namespace flyball::bench {

/// Runs a graph of a delivery's shape for so many seconds on the real-time executor, and prints
/// misses, drops, the largest release jitter of the path follower, and the process's memory after a
/// tenth of the time and in the end.
/// @param fifo_priority  See `RealtimeSettings`; what else runs on the machine hardly matters then.
void soak(double seconds, std::optional<int> fifo_priority);

}  // namespace flyball::bench
