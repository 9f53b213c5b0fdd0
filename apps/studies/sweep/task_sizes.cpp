// SPDX-License-Identifier: BSD-3-Clause
#include "studies/sweep/task_sizes.h"

#include <algorithm>

namespace flyball {
namespace {

/// With no task below `least` but the last one.
std::vector<std::size_t> sizes_from(std::size_t flights,
                                    std::size_t processors,
                                    std::size_t least) {
  std::vector<std::size_t> sizes;
  while (flights > 0) {
    const std::size_t shares = 2 * processors;
    const std::size_t round = std::max(least, (flights + shares - 1) / shares);
    for (std::size_t i = 0; i < processors && flights > 0; ++i) {
      sizes.push_back(std::min(round, flights));
      flights -= sizes.back();
    }
  }
  return sizes;
}

}  // namespace

std::vector<std::size_t> task_sizes(std::size_t flights,
                                    std::size_t processors,
                                    std::size_t most_tasks) {
  std::size_t least = 1;
  std::vector<std::size_t> sizes = sizes_from(flights, processors, least);
  while (sizes.size() > most_tasks) {
    least *= 2;
    sizes = sizes_from(flights, processors, least);
  }
  return sizes;
}

}  // namespace flyball
