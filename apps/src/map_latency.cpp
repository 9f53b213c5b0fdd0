// SPDX-License-Identifier: BSD-3-Clause
#include "map_latency.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

/// So that one second stands for what is expected.
Duration over(Duration measured, Duration expected) {
  return from_seconds(ratio(measured, expected));
}

Duration times(Duration share, Duration expected) {
  return from_seconds(to_seconds(share) * to_seconds(expected));
}

}  // namespace

MapTerms terms_of(const KnobSettings& knobs) {
  return {knobs.value("map.resolution_m"), knobs.value("map.range_m"),
          Hertz{knobs.value("cpu.frequency_hz")}};
}

void MapLatency::note_terms(MissionTime now, const MapTerms& terms) {
  if (!known_terms_ || terms != terms_) {
    since_ = known_terms_ ? now : MissionTime{};
    known_terms_ = true;
    terms_ = terms;
  }
}

// A range that is new begins with what the nearest one of the same cells has shown, and cells that
// are new with what the nearest cells have: the platform's price of a frame is an upper bound, and
// several times too high where a wall ends most rays.
MapLatency::Windows& MapLatency::windows() {
  const auto key = std::make_pair(terms_.resolution_m, terms_.range_m);
  const auto found = windows_.find(key);
  if (found != windows_.end()) {
    return found->second;
  }
  const Duration one = from_seconds(1.0);
  Windows seeds{LatencyWindow{one}, LatencyWindow{one}};
  using Apart = std::pair<double, double>;  // Cells first, then range.
  std::optional<Apart> nearest;
  for (const auto& [known, samples] : windows_) {
    const Apart apart{std::abs(std::log(known.first / terms_.resolution_m)),
                      std::abs(std::log(known.second / terms_.range_m))};
    if (!nearest || apart < *nearest) {
      nearest = apart;
      seeds = {LatencyWindow{samples.latency.bound()}, LatencyWindow{samples.interval.bound()}};
    }
  }
  return windows_.emplace(key, seeds).first->second;
}

void MapLatency::published(const MapRevision& revision, MissionTime now, Duration expected) {
  constexpr Duration least = std::chrono::milliseconds{1};  // A computer in a test may be free.
  expected = std::max(expected, least);
  Windows& here = windows();
  const Duration latency = now - revision.captured;
  const bool is_of_these_terms = revision.resolution_m == terms_.resolution_m;
  const bool knows_no_other = latency_bound_ == Duration{0};
  const Duration promised =
      is_of_these_terms || knows_no_other ? times(here.latency.bound(), expected) : latency_bound_;
  budget_use_ = ratio(latency, promised);
  if (is_of_these_terms && revision.captured >= since_) {
    here.latency.add(over(latency, expected));
  }
  if (is_of_these_terms && last_published_ && *last_published_ >= since_) {
    here.interval.add(over(now - *last_published_, expected));
  }
  last_published_ = now;
  latency_bound_ = times(here.latency.bound(), expected);
  interval_bound_ = times(here.interval.bound(), expected);
}

}  // namespace flyball
