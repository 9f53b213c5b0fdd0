// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/map_latency.h"

#include "flyball/flight/navigation/path_follower.h"
#include "flyball/flight/perception/rate_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr Duration least_price = 1ms;     // A computer in a test may charge nothing.
constexpr std::size_t most_windows = 64;  // Chosen: enough for the settings of some minutes.
constexpr double spread = 1.1;  // As `LatencyWindow` allows for what has not been measured yet.

/// The interval behind a rate limit, if there is such a knob.
double behind(const KnobsInForce& knobs, const char* knob, double interval_s) {
  return knobs.knobs.spec(knob) == nullptr ? interval_s
                                           : passed_interval_s(interval_s, knobs.value(knob));
}

MapTerms within_range(MapTerms terms, double range_m) {
  terms.range_m = range_m;
  return terms;
}

}  // namespace

MapTerms terms_of(const KnobsInForce& knobs, const Brief& brief) {
  MapTerms terms{knobs.value("map.resolution_m"), knobs.value("map.range_m"),
                 knobs.computer.frequency, knobs.computer.cores};
  const double taken_s = 1.0 / brief.settings.camera.rate_hz;
  const double used_s = behind(knobs, "camera.rate_hz", taken_s);
  const double mapped_s = behind(knobs, "map.rate_hz", used_s);
  const double located_s = behind(knobs, "localizer.rate_hz", used_s);
  terms.frame_interval = mapped_s > taken_s ? from_seconds(mapped_s) : Duration{};
  const bool needs_fixes = brief.sees_its_place && located_s > taken_s;
  terms.fix_interval = needs_fixes ? from_seconds(located_s) : Duration{};
  terms.is_offloaded =
      knobs.knobs.spec("offload.map") != nullptr && knobs.value("offload.map") != 0.0;
  return terms;
}

FramePrice frame_price(const Brief& brief) {
  const DepthCameraSpec& camera = brief.settings.camera;
  const Intrinsics lens = camera.intrinsics();
  const double rays = static_cast<double>(camera.count) * lens.width_px * lens.height_px;
  const double tan_x = 0.5 * lens.width_px / lens.focal_px;
  const double tan_y = 0.5 * lens.height_px / lens.focal_px;
  const double volume_at_1_m3 = camera.count * 4.0 / 3.0 * tan_x * tan_y;
  const std::string mapper = mapper_cost(brief.settings.kernels);
  const auto fixed_work = [rays] {
    Work work;
    work.add("frame", 1.0);
    work.add("rays", rays);
    return work;
  };
  FramePrice price;
  price.least =
      brief.platform->job_time(mapper, fixed_work(), brief.platform->frequencies().back());
  price.of = [=, platform = brief.platform](const MapTerms& terms) {
    const double range_m = terms.range_m;
    const double resolution_m = terms.resolution_m;
    Work work = fixed_work();
    work.add("traversals", 1.5 * rays * range_m / resolution_m);
    work.add("updates", volume_at_1_m3 * range_m * range_m * range_m /
                            (resolution_m * resolution_m * resolution_m));
    return platform->job_time(mapper, work, terms.clock);
  };
  return price;
}

// The oldest measurement is forgotten, because a policy that never asks for the same range twice
// would fill the memory.
void MeasuredShares::add(MissionTime now, const MapTerms& terms, double share) {
  const auto key = std::make_tuple(terms.is_offloaded, terms.cores, terms.resolution_m,
                                   terms.range_m, terms.frame_interval);
  if (windows_.find(key) == windows_.end() && windows_.size() >= most_windows) {
    windows_.erase(std::min_element(
        windows_.begin(), windows_.end(),
        [](const auto& a, const auto& b) { return a.second.newest < b.second.newest; }));
  }
  Window& here = windows_[key];
  here.shares.add(from_seconds(share));
  here.newest = now;
}

// The price of a frame is an upper bound, and several times too high where a wall ends most rays.
// So a measurement at the nearest settings tells more than the price does. The same jobs on fewer
// cores take longer by at most the ratio of the numbers of cores.
double MeasuredShares::bound(const MapTerms& terms) const {
  // Cells first, then range, then cores, then the interval between frames.
  using Apart = std::tuple<double, double, double, Duration>;
  std::optional<Apart> nearest;
  double share = terms.is_offloaded ? std::numeric_limits<double>::infinity() : 1.0;
  for (const auto& [key, window] : windows_) {
    const auto& [is_offloaded, cores, resolution_m, range_m, frame_interval] = key;
    if (is_offloaded != terms.is_offloaded) {
      continue;
    }
    const double times_fewer = static_cast<double>(cores) / terms.cores;
    const Apart apart{std::abs(std::log(resolution_m / terms.resolution_m)),
                      std::abs(std::log(range_m / terms.range_m)), std::abs(std::log(times_fewer)),
                      std::chrono::abs(frame_interval - terms.frame_interval)};
    if (!nearest || apart < *nearest) {
      nearest = apart;
      share = to_seconds(window.shares.bound()) * std::max(1.0, times_fewer);
    }
  }
  return share;
}

MapLatency::MapLatency(FramePrice price) : price_{std::move(price)} {
  price_.least = std::max(price_.least, least_price);
}

bool MapLatency::note_terms(MissionTime now, const MapTerms& terms) {
  if (known_terms_ && terms == terms_) {
    return false;
  }
  if (known_terms_ && within_range(terms_, terms.range_m) != terms) {
    since_ = now;
  }
  known_terms_ = true;
  terms_ = terms;
  if (!last_published_) {
    return false;
  }
  const Bounds before = bounds_;
  const Bounds here = bounds_of(terms_);
  bounds_ = {std::max(before.latency, here.latency), std::max(before.interval, here.interval),
             std::max(before.reckoned, here.reckoned)};
  return bounds_.latency != before.latency || bounds_.interval != before.interval ||
         bounds_.reckoned != before.reckoned;
}

Duration MapLatency::price(const MapTerms& terms) const {
  return std::max(price_.of(terms), price_.least);
}

MapLatency::Bounds MapLatency::bounds_of(const MapTerms& terms) const {
  const double price_s = to_seconds(price(terms));
  const auto bound = [&](const MeasuredShares& measured) {
    return std::clamp(from_seconds(measured.bound(terms) * price_s),
                      std::min(price_.least, longest_latency_bound), longest_latency_bound);
  };
  const Duration of_frames = from_seconds(spread * to_seconds(terms.frame_interval));
  return {bound(latencies_),
          std::min(std::max(bound(intervals_), of_frames), longest_latency_bound),
          terms.fix_interval};
}

void MapLatency::published(const MapRevision& revision, MissionTime now) {
  const Duration bound = last_published_ ? bounds_.latency : bounds_of(terms_).latency;
  budget_use_ = ratio(now - revision.captured, bound);
  const bool is_of_these_cells = revision.resolution_m == terms_.resolution_m;
  const MapTerms made =
      within_range(terms_, revision.range_m > 0.0 ? revision.range_m : terms_.range_m);
  if (is_of_these_cells && revision.captured >= since_) {
    latencies_.add(now, made, ratio(now - revision.captured, price(made)));
  }
  if (is_of_these_cells && last_published_ && *last_published_ >= since_) {
    intervals_.add(now, made, ratio(now - *last_published_, price(made)));
  }
  last_published_ = now;
  bounds_ = bounds_of(terms_);
}

}  // namespace flyball
