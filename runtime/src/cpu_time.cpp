// SPDX-License-Identifier: BSD-3-Clause
// tested-in: realtime_records
#include "flyball/runtime/realtime/cpu_time.h"

#include <ctime>
#include <utility>

namespace flyball {
namespace {

/// Of the calling thread.
Duration& helpers_time() {
  thread_local Duration used{};
  return used;
}

}  // namespace

Duration thread_cpu_time() {
  timespec used{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return std::chrono::seconds{used.tv_sec} + Duration{used.tv_nsec};
}

void add_helpers_time(Duration used) {
  helpers_time() += used;
}

Duration take_helpers_time() {
  return std::exchange(helpers_time(), Duration{});
}

}  // namespace flyball
