// SPDX-License-Identifier: BSD-3-Clause
//
// The body's cylinder swept along the path: exact for each chord, so nothing slips between poses.

#include "flyball/kernels/collision_check.h"
#include "flyball/runtime/guard.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <cmath>

namespace {

using flyball::Path;
using flyball::Vec3;

constexpr double pose_step_m = 0.05;  // A check pose by pose would need such steps in a .15 m map.
// Chosen by hand.
constexpr double longest_chord_m = 5.0;
constexpr double chord_tolerance_m = 0.002;  // The curve is an eighth of this from its chord.
constexpr double blocked_tolerance_m = 0.01;

double poses_in(double length_m) {
  return std::floor(length_m / pose_step_m) + 1.0;
}

/// The farthest sample that one chord from `from` reaches without leaving the path.
std::size_t chord_end(const std::vector<Path::Sample>& samples,
                      const Path::Sample& from,
                      std::size_t next) {
  std::size_t end = next;
  double turn = 0.0;
  while (end + 1 < samples.size()) {
    turn = std::max(turn, (samples[end].tangent_W - from.tangent_W).norm());
    const double length_m = samples[end + 1].s_m - from.s_m;
    if (length_m > longest_chord_m || length_m * turn > chord_tolerance_m) {
      break;
    }
    ++end;
  }
  return end;
}

class SweptCylinder final : public flyball::CollisionChecker {
 public:
  flyball::PathCheck check(const flyball::OccupancyView& map,
                           const flyball::PathSpan& span,
                           const flyball::Cylinder& body,
                           flyball::Work& work) override {
    flyball::PathCheck result;
    if (span.path == nullptr || span.path->empty()) {
      return result;
    }
    const double from_m = std::clamp(span.from_m, 0.0, span.path->length_m());
    result.blocked_at_m = first_blocked_m(map, *span.path, from_m, body);
    result.known_free_m =
        flyball::known_free_distance(map, {span.path, from_m, span.horizon_m}, body, pose_step_m);
    const double end_m = result.blocked_at_m.value_or(span.path->length_m());
    work.add("poses", poses_in(end_m - from_m) + poses_in(result.known_free_m));
    return result;
  }

 private:
  static std::optional<double> first_blocked_m(const flyball::OccupancyView& map,
                                               const Path& path,
                                               double from_m,
                                               const flyball::Cylinder& body) {
    const auto& samples = path.samples();
    Path::Sample here = path.at(from_m);
    auto next = static_cast<std::size_t>(
        std::upper_bound(samples.begin(), samples.end(), from_m,
                         [](double s, const Path::Sample& sample) { return s < sample.s_m; }) -
        samples.begin());
    if (next == samples.size()) {
      return map.segment_hits(here.p_W, here.p_W, body) ? std::optional{from_m} : std::nullopt;
    }
    while (next < samples.size()) {
      const std::size_t end = chord_end(samples, here, next);
      if (map.segment_hits(here.p_W, samples[end].p_W, body)) {
        return bisect(map, here, samples[end], body);
      }
      here = samples[end];
      next = end + 1;
    }
    return std::nullopt;
  }

  /// The last place on a blocked chord that is surely reached, to a centimetre.
  static double bisect(const flyball::OccupancyView& map,
                       const Path::Sample& from,
                       const Path::Sample& to,
                       const flyball::Cylinder& body) {
    double free = 0.0;
    double hit = 1.0;
    while ((hit - free) * (to.s_m - from.s_m) > blocked_tolerance_m) {
      const double middle = 0.5 * (free + hit);
      const Vec3 place = from.p_W + middle * (to.p_W - from.p_W);
      (map.segment_hits(from.p_W, place, body) ? hit : free) = middle;
    }
    return from.s_m + free * (to.s_m - from.s_m);
  }
};

}  // namespace

FLYBALL_PLUGIN(swept_cylinder) {
  registry.add<flyball::CollisionChecker>("swept_cylinder",
                                          [] { return std::make_unique<SweptCylinder>(); });
}
