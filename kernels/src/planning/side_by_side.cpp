// SPDX-License-Identifier: BSD-3-Clause
#include "planning/side_by_side.h"

#include "flyball/runtime/realtime/cpu_time.h"
#include "flyball/runtime/realtime/cpus.h"

#include <algorithm>
#include <atomic>
#include <future>
#include <system_error>
#include <vector>

namespace flyball {

void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& job) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      job(i);
    }
  };
  std::vector<std::future<Duration>> others;
  const std::size_t useful = std::min(count, static_cast<std::size_t>(std::max(1, threads)));
  try {
    while (others.size() + 1 < useful) {
      others.push_back(std::async(std::launch::async, [&work] {
        step_back();  // Else, with the priority of the caller, all cores would be taken from
                      // others.
        work();
        return thread_cpu_time();
      }));
    }
  } catch (const std::system_error&) {  // The system has no more; `work` below does the rest.
  }
  work();
  for (std::future<Duration>& other : others) {
    add_helpers_time(other.get());
  }
}

}  // namespace flyball
