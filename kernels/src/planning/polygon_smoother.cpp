// SPDX-License-Identifier: BSD-3-Clause
// tested-in: minimum_snap
//
// Edges stay exactly straight, and corners are rounded inside the triangle that their control
// points span, so that only corners can hit something. A corner that does is cut less. If it still
// hits something when it is not cut at all, the vehicle stops there.
//
// Rejected: knots only at the polygon's points. Such a curve leaves long edges by metres, and more
// knots mend that only when there is one for each metre.

#include "planning/polygon_smoother.h"

#include "planning/minimum_snap_knots.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace flyball {
namespace {

constexpr double same_point_m = 1e-6;
// Chosen by hand.
constexpr int rounds = 6;  // Of smaller cuts; the vehicle stops where all of them collide.
constexpr double chord_margin_m =
    0.002;  // The curve is checked and flown as chords, not the same ones.
constexpr double chord_tolerance_m = 0.0005;  // A quarter of that margin.
constexpr double longest_chord_m = 1.0;
constexpr double bend_tolerance_m = 0.05;  // A bend may leave bounds and polygon's heights by this.
constexpr int samples_per_piece = 64;
constexpr double sampling_reserve = 1.002;  // Peaks between samples.

/// Start and end stay; points on top of each other go.
std::vector<Vec3> without_repeats(const std::vector<Vec3>& points_W) {
  std::vector<Vec3> kept{points_W.front()};
  for (std::size_t i = 1; i < points_W.size(); ++i) {
    if ((points_W[i] - kept.back()).norm() > same_point_m) {
      kept.push_back(points_W[i]);
    } else if (i + 1 == points_W.size() && kept.size() > 1) {
      kept.back() = points_W[i];
    }
  }
  return kept;
}

bool is_sound(const SmoothRequest& request) {
  return request.waypoints_W.size() >= 2 && request.max_speed_m_s > 0.0 &&
         request.max_acceleration_m_s2 > 0.0 && std::isfinite(request.max_speed_m_s) &&
         std::isfinite(request.max_acceleration_m_s2) && request.start_velocity_W.allFinite() &&
         std::all_of(request.waypoints_W.begin(), request.waypoints_W.end(),
                     [](const Vec3& p) { return p.allFinite(); });
}

/// Smooths one request; counts what it does.
class Smoothing {
 public:
  Smoothing(const SmoothRequest& request, const OccupancyView& map, int derivative)
      : map_{map},
        body_{request.body},
        bend_bounds_W_{request.bounds_W},
        max_rise_{std::tan(request.max_slope_rad)},
        derivative_{derivative} {
    polygon_.points_W = without_repeats(request.waypoints_W);
    polygon_.start_velocity_W = request.start_velocity_W;
    polygon_.limits = {request.max_speed_m_s, request.max_acceleration_m_s2};
    const auto [lowest, highest] =
        std::minmax_element(polygon_.points_W.begin(), polygon_.points_W.end(),
                            [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
    bend_bounds_W_.min.z() = std::max(bend_bounds_W_.min.z(), lowest->z());
    bend_bounds_W_.max.z() = std::min(bend_bounds_W_.max.z(), highest->z());
    bend_bounds_W_.min.array() -= bend_tolerance_m;
    bend_bounds_W_.max.array() += bend_tolerance_m;
  }

  Result<SmoothPath> run() {
    if (polygon_.points_W.size() < 2) {
      return Error{ErrorCode::invalid_input, "all way-points are the same place; give two apart"};
    }
    for (std::size_t i = 0; i + 1 < polygon_.points_W.size(); ++i) {
      if (hits(polygon_.points_W[i], polygon_.points_W[i + 1], body_)) {
        return Error{ErrorCode::failed, "edge " + std::to_string(i) +
                                            " of the polygon hits an occupied cell; plan again"};
      }
    }
    if (!leads_in()) {
      round_corners();
    }
    keep_limits();
    SmoothPath path;
    path.work.add("pieces", static_cast<double>(pieces_.size()));
    path.work.add("solves", solves_);
    path.work.add("collision_queries", queries_);
    path.trajectory.pieces = std::move(pieces_);
    return path;
  }

 private:
  /// With one more corner straight ahead, where that makes a wider curve than bending in at once.
  bool leads_in() {
    const RoundedPolygon planned = polygon_;
    const std::vector<Vec3> places_W = lead_ins_W(planned);
    const auto place = std::find_if(places_W.begin(), places_W.end(), [&](const Vec3& p_W) {
      return bend_bounds_W_.contains(p_W) && is_flat_enough(planned.points_W[1] - p_W) &&
             !hits(planned.points_W[0], p_W, body_) && !hits(p_W, planned.points_W[1], body_);
    });
    if (place == places_W.end()) {
      return false;
    }
    polygon_.points_W.insert(polygon_.points_W.begin() + 1, *place);
    round_corners();
    const bool is_wider = curve_radius_m(polygon_, 1) > widest_bend_m(planned);
    if (!is_wider) {
      polygon_ = planned;
    }
    return is_wider;
  }

  [[nodiscard]] bool is_flat_enough(const Vec3& edge_W) const {
    return std::abs(edge_W.z()) <= max_rise_ * edge_W.head<2>().norm();
  }

  void round_corners() {
    polygon_.cut_m = largest_cuts(polygon_);
    solve();
    for (int round = 1; cut_less(round >= rounds); ++round) {
      solve();
    }
  }

  void solve() {
    curve_ = knots_of(polygon_);
    do {
      minimise(derivative_, curve_.knots, curve_.durations_s);
      ++solves_;
    } while (pin_disorderly_knots());
    pieces_.clear();
    for (std::size_t i = 0; i < curve_.durations_s.size(); ++i) {
      pieces_.push_back(piece_between(curve_.knots[i], curve_.knots[i + 1], curve_.durations_s[i]));
    }
  }

  /// Where control points pass each other or the corner, the curve might leave its hull: there the
  /// first guess, which never does, replaces the optimum.
  bool pin_disorderly_knots() {
    const auto first_guess = knots_of(polygon_).knots;
    const auto pin = [&](std::size_t k) {
      const bool was_free = !curve_.knots[k].is_fixed;
      if (was_free) {
        curve_.knots[k] = first_guess[k];
        curve_.knots[k].is_fixed = true;
      }
      return was_free;
    };
    bool pinned = false;
    for (std::size_t i = 0; i < curve_.durations_s.size(); ++i) {
      if (!is_orderly(i)) {
        pinned = pin(i) || pinned;
        pinned = pin(i + 1) || pinned;
      }
    }
    return pinned;
  }

  [[nodiscard]] bool is_orderly(std::size_t i) const {
    double forward_m = 0.0;
    double backward_m = 0.0;
    const bool ordered =
        control_reach_m(curve_.knots[i], curve_.durations_s[i], true, forward_m) &&
        control_reach_m(curve_.knots[i + 1], curve_.durations_s[i], false, backward_m);
    const int corner = curve_.corner[i];
    if (corner < 0) {
      const double length_m = (curve_.knots[i + 1].p_W - curve_.knots[i].p_W).norm();
      return ordered && forward_m + backward_m <= length_m * (1.0 + 1e-9);
    }
    const double cut_m = polygon_.cut_m[static_cast<std::size_t>(corner)];
    return ordered && std::max(forward_m, backward_m) <= cut_m;
  }

  /// Shrinks the cuts of corners that hit something; false when none does.
  bool cut_less(bool to_stops) {
    bool changed = false;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (curve_.corner[i] < 0 || is_clear(pieces_[i])) {
        continue;
      }
      const auto corner = static_cast<std::size_t>(curve_.corner[i]);
      polygon_.cut_m[corner] = to_stops ? 0.0 : smaller_cut(polygon_, corner);
      changed = true;
    }
    return changed;
  }

  bool is_clear(const PolynomialPiece& piece) {
    constexpr int parts = 8;  // A bend may end where it began: look at its parts.
    for (int i = 0; i < parts; ++i) {
      if (!is_clear(piece, piece.duration_s * i / parts, piece.duration_s * (i + 1) / parts)) {
        return false;
      }
    }
    return true;
  }

  bool is_clear(const PolynomialPiece& piece, double from_s, double to_s) {
    const double middle_s = 0.5 * (from_s + to_s);
    const Vec3 from = piece.derivative(0, from_s);
    const Vec3 middle = piece.derivative(0, middle_s);
    const Vec3 to = piece.derivative(0, to_s);
    if (!bend_bounds_W_.contains(middle)) {
      return false;
    }
    const Vec3 chord = to - from;
    const Vec3 off =
        middle - from - chord * ((middle - from).dot(chord) / std::max(chord.squaredNorm(), 1e-12));
    if (chord.norm() > longest_chord_m || off.norm() > chord_tolerance_m) {
      return is_clear(piece, from_s, middle_s) && is_clear(piece, middle_s, to_s);
    }
    return !hits(from, to, {body_.radius_m + chord_margin_m, body_.half_height_m + chord_margin_m});
  }

  bool hits(const Vec3& from, const Vec3& to, const Cylinder& body) {
    ++queries_;
    return map_.segment_hits(from, to, body);
  }

  /// One factor on time for the whole curve: its shape stays.
  void keep_limits() {
    double slower = 0.0;
    for (const PolynomialPiece& piece : pieces_) {
      for (int i = 0; i <= samples_per_piece; ++i) {
        const double t_s = piece.duration_s * i / samples_per_piece;
        const double speed = piece.derivative(1, t_s).norm() / polygon_.limits.max_speed_m_s;
        const double acceleration =
            piece.derivative(2, t_s).norm() / polygon_.limits.max_acceleration_m_s2;
        slower = std::max({slower, speed, std::sqrt(acceleration)});
      }
    }
    slower *= sampling_reserve;
    for (PolynomialPiece& piece : pieces_) {
      piece.duration_s *= slower;
      double power = 1.0;
      for (int k = 0; k < 8; ++k) {
        piece.c.col(k) /= power;
        power *= slower;
      }
    }
  }

  const OccupancyView& map_;
  Cylinder body_;
  Aabb bend_bounds_W_;  ///< A bend stays in them, and between the polygon's heights.
  double max_rise_;     ///< For each metre to the side.
  int derivative_;
  RoundedPolygon polygon_;
  SnapKnots curve_;
  std::vector<PolynomialPiece> pieces_;
  int solves_{};
  int queries_{};
};

}  // namespace

Result<SmoothPath> smooth_polygon(const SmoothRequest& request,
                                  const OccupancyView& map,
                                  int derivative) {
  if (!is_sound(request)) {
    return Error{ErrorCode::invalid_input,
                 "smoothing " + std::to_string(request.waypoints_W.size()) +
                     " way-points needs two or more finite ones and positive limits"};
  }
  return Smoothing{request, map, derivative}.run();
}

}  // namespace flyball
