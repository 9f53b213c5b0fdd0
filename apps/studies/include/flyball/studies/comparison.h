// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Policies side by side over the same seeds.

#include "flyball/records/summary.h"
#include "flyball/studies/policy_trouble.h"
#include "flyball/studies/statistics.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// One policy. Medians are over its succeeded flights only; failed ones are counted by failure.
struct ComparisonRow {
  std::string policy;
  int n{};
  int succeeded{};
  int collisions{};
  std::map<std::string, int> failures{};
  PolicyTrouble trouble{};
  std::optional<MedianInterval> mission_time_s{};
  std::optional<MedianInterval> energy_total_j{};
  std::optional<MedianInterval> battery_used_percent{};
  std::optional<MedianInterval> mean_speed_m_s{};
  std::optional<MedianInterval> latency_p50_s{};
  /// Ratios to the first policy, paired by seed, over the seeds where both succeed.
  int pairs{};
  std::optional<MedianInterval> battery_ratio{};
  std::optional<MedianInterval> time_ratio{};
};

struct Comparison {
  std::string scenario;
  std::vector<std::uint64_t> seeds{};
  std::vector<ComparisonRow> rows{};
};

/// @param flights  In the order of the policies; one summary per policy and seed.
[[nodiscard]] Comparison compare_flights(const std::vector<Summary>& flights);

[[nodiscard]] std::string to_json(const Comparison& comparison);
/// A table for a terminal, with an explanation of its figures.
[[nodiscard]] std::string to_text(const Comparison& comparison);
[[nodiscard]] std::string to_html(const Comparison& comparison);
/// `1..10`, or `1, 5, 7`.
[[nodiscard]] std::string seeds_text(const std::vector<std::uint64_t>& seeds);

}  // namespace flyball
