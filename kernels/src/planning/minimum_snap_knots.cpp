// SPDX-License-Identifier: BSD-3-Clause
#include "planning/minimum_snap_knots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace flyball {
namespace {

constexpr double edge_share = 0.45;        // Of an edge for the cut at each of its ends.
constexpr double whole_share = 0.9;        // Of the first edge, where the path comes in motion.
constexpr double largest_cut_m = 6.0;      // Longer curves leave the planned polygon by metres.
constexpr double smallest_cut_m = 0.02;    // Chosen: on less, the vehicle stops as quickly.
constexpr double shrink = 0.6;             // Chosen: six rounds make a cut 20 times smaller.
constexpr double sharpest_turn_rad = 2.6;  // Beyond 150 degrees a round is no shorter than a stop.
constexpr double widest_bend_rad = 2.0;
constexpr double smallest_radius_m =
    0.3;  // .9 m/s at 3 m/s^2; tighter, stopping costs little more.
constexpr double straight_rad = 1e-3;
// In a corner the speed rises by a sixth while the curvature peaks at 1.3 times the arc's; speeding
// up from one speed to another peaks at 1.9 times its mean (a quintic step in speed).
constexpr double curve_share = 0.55;
constexpr double speed_up_share = 0.5;
constexpr double shortest_lead_in_m = 0.5;  // Chosen: a shorter one is a bend.
constexpr double lead_in_ratio = 1.5;       // Chosen: seven places up to the largest cut.
constexpr double bend_reach = 0.84;     // v T / cut of a bend: its control points stay in order.
constexpr double bend_sharpness = 5.0;  // Its peak curvature is up to this much times turn / cut.

Vec3 edge(const RoundedPolygon& polygon, std::size_t i) {
  return polygon.points_W[i + 1] - polygon.points_W[i];
}

double angle_rad(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// How much the direction changes at a point; at the first one, from the start velocity.
double turn_rad(const RoundedPolygon& polygon, std::size_t point) {
  const Vec3 before = point == 0 ? polygon.start_velocity_W : edge(polygon, point - 1);
  return angle_rad(before, edge(polygon, point));
}

bool starts_moving(const RoundedPolygon& polygon) {
  return polygon.start_velocity_W.norm() > 1e-3;
}

double radius_m(double cut_m, double turn) {
  return cut_m / std::tan(0.5 * std::max(turn, 1e-6));
}

/// So wide a curve is flown at the largest speed.
double useful_radius_m(const RoundedPolygon& polygon) {
  const double v = polygon.limits.max_speed_m_s;
  return v * v / (curve_share * polygon.limits.max_acceleration_m_s2);
}

double largest_bend_m(const RoundedPolygon& polygon) {
  const double turn = turn_rad(polygon, 0);
  const bool bends = starts_moving(polygon) && turn > straight_rad && turn < widest_bend_rad;
  const double useful_m = bend_sharpness * turn * useful_radius_m(polygon);
  return bends ? std::min({edge_share * edge(polygon, 0).norm(), useful_m, largest_cut_m}) : 0.0;
}

/// What the start leaves of the edge before a point.
double room_before_m(const RoundedPolygon& polygon, std::size_t point, double bend_m) {
  const double edge_m = edge(polygon, point - 1).norm();
  return point == 1 && starts_moving(polygon) ? whole_share * edge_m - bend_m : edge_share * edge_m;
}

double largest_cut(const RoundedPolygon& polygon, std::size_t point, double bend_m) {
  const double turn = turn_rad(polygon, point);
  if (turn > sharpest_turn_rad) {
    return 0.0;
  }
  const double useful_m = useful_radius_m(polygon) * std::tan(0.5 * turn);
  return std::min({room_before_m(polygon, point, bend_m), edge_share * edge(polygon, point).norm(),
                   std::clamp(useful_m, 0.5, largest_cut_m)});
}

double radius_with_m(const RoundedPolygon& polygon, std::size_t point, double cut_m) {
  const double turn = turn_rad(polygon, point);
  return point == 0 ? cut_m / (bend_sharpness * std::max(turn, 1e-6)) : radius_m(cut_m, turn);
}

double without_tight_curves(const RoundedPolygon& polygon, std::size_t point, double cut_m) {
  const double radius = radius_with_m(polygon, point, cut_m);
  const bool tight = radius < (point == 0 ? smallest_radius_m / 2.0 : smallest_radius_m);
  return cut_m < smallest_cut_m || tight ? 0.0 : cut_m;
}

/// v T / cut of a rounded corner. The speed at its ends, with no acceleration and jerk, puts three
/// control points on each edge, the last one 3/7 of this before the cut. From half a radian the
/// curvature peaks at 1.25 to 1.35 times that of the arc with the same cut (the least of all such
/// values, found by search); where the ends' derivatives minimise snap too, it peaks at 1.9 to 4
/// times, and flight is that much slower. Slighter turns keep their speed instead (2 / cut).
double duration_per_cut(double turn) {
  return (7.0 / 3.0) * std::max(6.0 / 7.0 - 0.2 * turn, 0.74 - 0.05 * turn * turn);
}

/// Writes knots and durations along the polygon, edge by edge.
class KnotWriter {
 public:
  explicit KnotWriter(const RoundedPolygon& polygon) : polygon_{polygon} { limit_speeds(); }

  SnapKnots write() {
    start();
    for (std::size_t point = 1; point < polygon_.points_W.size(); ++point) {
      const Vec3 along = edge(polygon_, point - 1).normalized();
      const Vec3& corner = polygon_.points_W[point];
      const double cut_m = polygon_.cut_m[point];
      go_straight(corner - cut_m * along, along, speed_m_s_[point]);
      if (cut_m > 0.0) {
        round(point);
      } else {
        result_.knots.back() = {corner, along, Vec3::Zero(), true};
      }
    }
    return result_;
  }

 private:
  /// Speeds at the points: what the curve allows, then what can be reached and left in time.
  void limit_speeds() {
    const std::size_t points = polygon_.points_W.size();
    const double top = polygon_.limits.max_speed_m_s;
    const double a = polygon_.limits.max_acceleration_m_s2;
    speed_m_s_.assign(points, 0.0);
    for (std::size_t i = 1; i + 1 < points; ++i) {
      if (polygon_.cut_m[i] > 0.0) {
        speed_m_s_[i] = std::min(top, std::sqrt(curve_share * a * curve_radius_m(polygon_, i)));
      }
    }
    if (polygon_.cut_m[0] > 0.0) {
      speed_m_s_[0] = std::min(top, std::sqrt(curve_share * a * curve_radius_m(polygon_, 0)));
    } else if (starts_moving(polygon_) && turn_rad(polygon_, 0) <= straight_rad) {
      speed_m_s_[0] = std::min(top, polygon_.start_velocity_W.norm());
    }
    for (std::size_t i = 1; i < points; ++i) {
      speed_m_s_[i] = std::min(speed_m_s_[i], reachable(speed_m_s_[i - 1], straight_m(i - 1)));
    }
    for (std::size_t i = points - 1; i-- > 0;) {
      speed_m_s_[i] = std::min(speed_m_s_[i], reachable(speed_m_s_[i + 1], straight_m(i)));
    }
  }
  [[nodiscard]] double acceleration() const {
    return speed_up_share * polygon_.limits.max_acceleration_m_s2;
  }
  [[nodiscard]] double reachable(double speed, double distance_m) const {
    return std::sqrt(speed * speed + 2.0 * acceleration() * distance_m);
  }
  [[nodiscard]] double straight_m(std::size_t i) const {
    return std::max(0.0, edge(polygon_, i).norm() - polygon_.cut_m[i] - polygon_.cut_m[i + 1]);
  }

  void start() {
    const Vec3& p_W = polygon_.points_W[0];
    const Vec3 along = edge(polygon_, 0).normalized();
    const double cut_m = polygon_.cut_m[0];
    speed_ = speed_m_s_[0];
    if (cut_m == 0.0) {
      result_.knots.push_back({p_W, along, {speed_, 0.0, 0.0}, true});
      return;
    }
    const Vec3 direction = polygon_.start_velocity_W.normalized();
    result_.knots.push_back({p_W, direction, {speed_, 0.0, 0.0}, true});
    add({p_W + cut_m * along, along, {speed_, 0.0, 0.0}, true}, bend_reach * cut_m / speed_, 0);
  }

  void add(const SnapKnot& knot, double duration_s, int corner) {
    result_.knots.push_back(knot);
    result_.durations_s.push_back(duration_s);
    result_.corner.push_back(corner);
  }

  void round(std::size_t point) {
    const double cut_m = polygon_.cut_m[point];
    const Vec3 along = edge(polygon_, point).normalized();
    add({polygon_.points_W[point] + cut_m * along, along, {speed_, 0.0, 0.0}, true},
        cut_m * duration_per_cut(turn_rad(polygon_, point)) / speed_, static_cast<int>(point));
  }

  /// To `end` with speeding up, cruising and slowing down as separate pieces, because one
  /// polynomial over a long edge would spend most of it below its top speed.
  void go_straight(const Vec3& end, const Vec3& along, double end_speed) {
    const Vec3 from = result_.knots.back().p_W;
    const double length_m = (end - from).norm();
    const double a = acceleration();
    const double peak =
        std::min(polygon_.limits.max_speed_m_s,
                 std::sqrt(a * length_m + 0.5 * (speed_ * speed_ + end_speed * end_speed)));
    const double up_m = std::max(0.0, (peak * peak - speed_ * speed_) / (2.0 * a));
    const double down_m = std::max(0.0, (peak * peak - end_speed * end_speed) / (2.0 * a));
    struct Part {
      double length_m;
      double end_speed;
    };
    double begin_m = 0.0;
    const std::array<Part, 3> parts{
        {{up_m, peak}, {length_m - up_m - down_m, peak}, {down_m, end_speed}}};
    for (const Part& part : parts) {
      const bool worth_a_piece = part.length_m > 0.02 * length_m;
      if (worth_a_piece) {
        begin_m += part.length_m;
        const double duration_s = 2.0 * part.length_m / (speed_ + part.end_speed);
        add({from + begin_m * along, along, {part.end_speed, 0.0, 0.0}, false}, duration_s, -1);
        speed_ = part.end_speed;
      }
    }
    result_.knots.back() = {end, along, {end_speed, 0.0, 0.0}, true};
    speed_ = end_speed;
  }

  const RoundedPolygon& polygon_;
  SnapKnots result_;
  std::vector<double> speed_m_s_;
  double speed_{};
};

}  // namespace

std::vector<double> largest_cuts(const RoundedPolygon& polygon) {
  std::vector<double> cuts(polygon.points_W.size(), 0.0);
  cuts[0] = without_tight_curves(polygon, 0, largest_bend_m(polygon));
  for (std::size_t i = 1; i + 1 < cuts.size(); ++i) {
    cuts[i] = without_tight_curves(polygon, i, largest_cut(polygon, i, cuts[0]));
  }
  return cuts;
}

std::vector<Vec3> lead_ins_W(const RoundedPolygon& polygon) {
  const double bend_radius_m = widest_bend_m(polygon);
  if (bend_radius_m == 0.0) {
    return {};
  }
  const Vec3 ahead = polygon.start_velocity_W.normalized();
  std::vector<std::pair<double, Vec3>> places;
  for (double on_m = shortest_lead_in_m; on_m * whole_share < largest_cut_m;
       on_m *= lead_in_ratio) {
    RoundedPolygon with = polygon;
    with.points_W.insert(with.points_W.begin() + 1, polygon.points_W[0] + on_m * ahead);
    const double radius = radius_with_m(with, 1, largest_cut(with, 1, 0.0));
    if (radius > bend_radius_m) {
      places.emplace_back(std::min(radius, useful_radius_m(polygon)), with.points_W[1]);
    }
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Vec3> places_W;
  places_W.reserve(places.size());
  for (const auto& place : places) {
    places_W.push_back(place.second);
  }
  return places_W;
}

double widest_bend_m(const RoundedPolygon& polygon) {
  return radius_with_m(polygon, 0, largest_bend_m(polygon));
}

double curve_radius_m(const RoundedPolygon& polygon, std::size_t point) {
  return radius_with_m(polygon, point, polygon.cut_m[point]);
}

double smaller_cut(const RoundedPolygon& polygon, std::size_t point) {
  return without_tight_curves(polygon, point, shrink * polygon.cut_m[point]);
}

SnapKnots knots_of(const RoundedPolygon& polygon) {
  return KnotWriter{polygon}.write();
}

}  // namespace flyball
