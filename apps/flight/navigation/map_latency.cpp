// SPDX-License-Identifier: BSD-3-Clause
#include "flight/navigation/map_latency.h"

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

Duration expected_latency(const MissionContext& context, const MapTerms& terms) {
  const DepthCameraSpec& camera = context.settings.camera;
  const Intrinsics lens = camera.intrinsics();
  const double rays = static_cast<double>(camera.count) * lens.width_px * lens.height_px;
  const double tan_x = 0.5 * lens.width_px / lens.focal_px;
  const double tan_y = 0.5 * lens.height_px / lens.focal_px;
  const double range_m = terms.range_m;
  const double resolution_m = terms.resolution_m;
  const double volume_m3 = camera.count * 4.0 / 3.0 * tan_x * tan_y * range_m * range_m * range_m;
  Work work;
  work.add("frame", 1.0);
  work.add("rays", rays);
  work.add("traversals", 1.5 * rays * range_m / resolution_m);
  work.add("updates", volume_m3 / (resolution_m * resolution_m * resolution_m));
  return context.platform.job_time(mapper_cost(context.settings.kernels), work, terms.clock);
}

bool MapLatency::note_knobs(MissionTime now, const MissionContext& context) {
  const MapTerms before = terms_;
  note_terms(now, terms_of(context.knobs));
  const bool is_same_map =
      terms_.resolution_m == before.resolution_m && terms_.range_m == before.range_m;
  if (!is_same_map || !(terms_.clock < before.clock)) {
    return false;
  }
  const Duration was = expected_latency(context, before);
  if (was > Duration::zero()) {
    stretch(ratio(expected_latency(context, terms_), was));
  }
  return was > Duration::zero();
}

void MapLatency::stretch(double factor) {
  latency_bound_ = from_seconds(factor * to_seconds(latency_bound_));
  interval_bound_ = from_seconds(factor * to_seconds(interval_bound_));
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
  const Duration under_these = times(here.latency.bound(), expected);
  const Duration promised = knows_no_other      ? under_these
                            : is_of_these_terms ? std::max(under_these, latency_bound_)
                                                : latency_bound_;
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
