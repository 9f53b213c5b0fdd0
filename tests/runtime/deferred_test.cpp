// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/deferred.h"

#include <atomic>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(Deferred, computes_nothing_before_somebody_looks) {
  int computed = 0;
  const Deferred<int> value{[&computed] { return ++computed; }};
  EXPECT_EQ(computed, 0);
  EXPECT_EQ(value.value(), 1);
}

TEST(Deferred, computes_once_for_all_copies) {
  int computed = 0;
  const Deferred<int> first{[&computed] { return ++computed; }};
  const Deferred<int> second = first;  // NOLINT(performance-unnecessary-copy-initialization)
  EXPECT_EQ(second.value(), 1);
  EXPECT_EQ(first.value(), 1);
  EXPECT_EQ(&first.value(), &second.value()) << "one object, not two equal ones";
  EXPECT_EQ(computed, 1);
}

TEST(Deferred, lets_go_of_what_it_computed_from) {
  const auto source = std::make_shared<int>(7);
  const Deferred<int> value{[source] { return *source; }};
  EXPECT_EQ(source.use_count(), 2);
  EXPECT_EQ(value.value(), 7);
  EXPECT_EQ(source.use_count(), 1);
}

TEST(Deferred, holds_what_exists_already) {
  const auto value = Deferred<std::vector<int>>::of({1, 2, 3});
  EXPECT_EQ(value.value(), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(Deferred<int>{}.value(), 0);
}

TEST(Deferred, computes_once_for_many_threads) {
  std::atomic<int> computed{0};
  const Deferred<int> value{[&computed] { return ++computed; }};
  std::atomic<int> sum{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&sum, value] { sum += value.value(); });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  EXPECT_EQ(sum, 4);
}

}  // namespace
}  // namespace flyball
