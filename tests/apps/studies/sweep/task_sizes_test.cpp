// SPDX-License-Identifier: BSD-3-Clause
#include "studies/sweep/task_sizes.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using Sizes = std::vector<std::size_t>;

TEST(TaskSizes, fall_by_half_in_each_round) {
  EXPECT_EQ(task_sizes(60, 2, 1000), (Sizes{15, 15, 8, 8, 4, 4, 2, 2, 1, 1}));
  EXPECT_EQ(task_sizes(3, 2, 1000), (Sizes{1, 1, 1}));
  EXPECT_TRUE(task_sizes(0, 2, 1000).empty());
}

TEST(TaskSizes, hold_each_flight_once_in_no_more_tasks_than_allowed) {
  for (const std::size_t flights : {1U, 7U, 200U, 996U, 50000U}) {
    for (const std::size_t processors : {1U, 2U, 64U, 2000U}) {
      for (const std::size_t most : {1U, 10U, 1000U}) {
        const Sizes sizes = task_sizes(flights, processors, most);
        EXPECT_EQ(std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}), flights);
        EXPECT_LE(sizes.size(), most);
        EXPECT_TRUE(std::is_sorted(sizes.rbegin(), sizes.rend()));
        EXPECT_GE(sizes.back(), 1U);
      }
    }
  }
}

}  // namespace
}  // namespace flyball
