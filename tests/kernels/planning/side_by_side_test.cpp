// SPDX-License-Identifier: BSD-3-Clause
#include "planning/side_by_side.h"

#include "flyball/runtime/realtime/cpu_time.h"

#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(SideBySide, calls_each_index_once_with_any_number_of_threads) {
  for (const int threads : {-1, 0, 1, 2, 5}) {
    for (const std::size_t count : {0U, 1U, 3U, 100U}) {
      std::vector<int> calls(count, 0);
      for_each_index(count, threads, [&](std::size_t i) { ++calls[i]; });
      EXPECT_EQ(calls, std::vector<int>(count, 1)) << threads << " threads";
    }
  }
}

TEST(SideBySide, has_as_many_calls_at_once_as_threads) {
  constexpr int threads = 3;
  std::mutex mutex;
  std::condition_variable all_are_here;
  int here = 0;
  // Each call waits for the others: fewer threads would never come to an end.
  for_each_index(threads, threads, [&](std::size_t /*i*/) {
    std::unique_lock lock{mutex};
    ++here;
    all_are_here.notify_all();
    all_are_here.wait(lock, [&] { return here == threads; });
  });
  EXPECT_EQ(here, threads);
}

TEST(SideBySide, tells_what_the_other_threads_took) {
  const auto works_for_a_millisecond = [](std::size_t /*i*/) {
    const Duration begin = thread_cpu_time();
    while (thread_cpu_time() - begin < std::chrono::milliseconds{1}) {
    }
  };
  (void)take_helpers_time();
  for_each_index(4, 1, works_for_a_millisecond);
  EXPECT_EQ(take_helpers_time(), Duration::zero()) << "there are no others";
  // One thread may be through with all calls before the other one begins.
  Duration taken{};
  while (taken == Duration::zero()) {
    for_each_index(50, 2, works_for_a_millisecond);
    taken = take_helpers_time();
    EXPECT_LT(taken, std::chrono::milliseconds{200});
  }
  EXPECT_EQ(take_helpers_time(), Duration::zero()) << "it is told once";
}

TEST(SideBySide, hands_on_what_a_call_throws) {
  const auto fails = [](std::size_t i) {
    if (i == 7) {
      throw std::runtime_error{"seven"};
    }
  };
  EXPECT_THROW(for_each_index(20, 3, fails), std::runtime_error);
}

}  // namespace
}  // namespace flyball
