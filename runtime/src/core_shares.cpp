// SPDX-License-Identifier: BSD-3-Clause
#include "core_shares.h"

#include <algorithm>
#include <numeric>

namespace flyball {

std::vector<double> share_cores(const std::vector<CoreClaim>& claims, double cores) {
  std::vector<std::size_t> order(claims.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Inside a class the smallest claim first: what it leaves raises the level of the others.
  std::stable_sort(order.begin(), order.end(), [&claims](std::size_t a, std::size_t b) {
    return claims[a].priority != claims[b].priority ? claims[a].priority > claims[b].priority
                                                    : claims[a].most < claims[b].most;
  });
  std::vector<double> shares(claims.size(), 0.0);
  double left = cores;
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first;
    while (end < order.size() && claims[order[end]].priority == claims[order[first]].priority) {
      ++end;
    }
    for (; first < end; ++first) {
      const double level = left / static_cast<double>(end - first);
      shares[order[first]] = std::min(claims[order[first]].most, level);
      left -= shares[order[first]];  // the last one of a class that takes all leaves exactly zero
    }
  }
  return shares;
}

}  // namespace flyball
