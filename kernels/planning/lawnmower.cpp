// SPDX-License-Identifier: BSD-3-Clause
//
// Lanes to and fro, as one mows a lawn or ploughs a field (the boustrophedon of Choset and Pignon
// 1997, doi:10.1007/978-1-4471-1273-0_32, in a single cell). Of the four corners to begin at, the
// one with the shortest path from start to end is taken.

#include "flyball/kernels/coverage_planner.h"
#include "flyball/runtime/registry.h"
#include "flyball/runtime/text/number_text.h"

#include <cmath>
#include <limits>
#include <utility>

namespace {

using flyball::CoveragePath;
using flyball::CoverageRequest;
using flyball::Vec3;

bool is_sound(const CoverageRequest& request) {
  return request.length_m > 0.0 && std::isfinite(request.length_m) && request.width_m > 0.0 &&
         std::isfinite(request.width_m) && request.lanes > 0 && request.corner_W.allFinite() &&
         request.start_W.allFinite() && request.end_W.allFinite();
}

/// Where the first lane begins.
struct Entry {
  bool far_lane{};  ///< The lane with the largest y.
  bool far_end{};   ///< The end with the largest x.
};

std::vector<Vec3> lanes_from(const CoverageRequest& request, const Entry& entry) {
  const double spacing_m = request.width_m / request.lanes;
  std::vector<Vec3> points_W{request.start_W};
  bool at_far_end = entry.far_end;
  for (int i = 0; i < request.lanes; ++i) {
    const int lane = entry.far_lane ? request.lanes - 1 - i : i;
    const double y_m = (lane + 0.5) * spacing_m;
    const Vec3 near_W = request.corner_W + Vec3{0.0, y_m, 0.0};
    const Vec3 far_W = request.corner_W + Vec3{request.length_m, y_m, 0.0};
    points_W.push_back(at_far_end ? far_W : near_W);
    points_W.push_back(at_far_end ? near_W : far_W);
    at_far_end = !at_far_end;
  }
  points_W.push_back(request.end_W);
  return points_W;
}

double length_m(const std::vector<Vec3>& points_W) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < points_W.size(); ++i) {
    sum_m += (points_W[i] - points_W[i - 1]).norm();
  }
  return sum_m;
}

class Lawnmower final : public flyball::CoveragePlanner {
 public:
  flyball::Result<CoveragePath> cover(const CoverageRequest& request) override {
    if (!is_sound(request)) {
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "coverage of " + flyball::short_number_text(request.length_m) +
                                " m x " + flyball::short_number_text(request.width_m) + " m in " +
                                std::to_string(request.lanes) +
                                " lanes needs an area, a lane and finite places"};
    }
    CoveragePath best;
    double best_m = std::numeric_limits<double>::infinity();
    for (const Entry entry : {Entry{false, false}, {false, true}, {true, false}, {true, true}}) {
      std::vector<Vec3> points_W = lanes_from(request, entry);
      best.work.add("waypoints", static_cast<double>(points_W.size()));
      const double total_m = length_m(points_W);
      if (total_m < best_m) {
        best_m = total_m;
        best.waypoints_W = std::move(points_W);
      }
    }
    const auto& points_W = best.waypoints_W;
    best.out_m = (points_W[1] - points_W[0]).norm();
    best.back_m = (points_W.back() - points_W[points_W.size() - 2]).norm();
    return best;
  }
};

}  // namespace

FLYBALL_PLUGIN(lawnmower) {
  registry.add<flyball::CoveragePlanner>("lawnmower", [] { return std::make_unique<Lawnmower>(); });
}
