// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace flyball::bench {

/// Runs a graph of a delivery's shape for so many seconds on the real-time executor, and prints
/// misses, drops, the largest release jitter of the path follower, and the process's memory after a
/// tenth of the time and in the end.
void soak(double seconds);

}  // namespace flyball::bench
