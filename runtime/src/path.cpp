// SPDX-License-Identifier: BSD-3-Clause
//
// Tangents and curvature come from the sampled points, not from derivatives: where a trajectory
// starts, stops or turns on the spot its speed is zero and the quotient v x a / |v|^3 is noise,
// while the points are as good as anywhere else.

#include "flyball/runtime/assert.h"
#include "flyball/runtime/trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double same_place_m = 1e-6;
/// Below it a change of direction between two pieces is a bend that is flown, not a corner that is
/// stopped at: 0.05 rad at 5 m/s asks for 0.25 m/s of lateral speed, within the tracking tube.
constexpr double corner_rad = 0.05;

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

struct Point {
  Vec3 p_W;
  bool is_stop{};
};

/// Points of a trajectory, at most `step_m` apart.
class Flattening {
 public:
  Flattening(const Trajectory& trajectory, double step_m)
      : limit_m_{0.95 * step_m}, merge_m_{0.2 * step_m} {
    for (std::size_t i = 0; i < trajectory.pieces.size(); ++i) {
      const PolynomialPiece& piece = trajectory.pieces[i];
      add_point(piece.derivative(0, 0.0));
      if (i > 0) {
        join(piece.derivative(0, 0.0), is_at_rest(trajectory.pieces[i - 1], piece));
      }
      // Eight parts first: a loop could bring the ends of a whole piece together.
      constexpr int parts = 8;
      for (int part = 0; part < parts; ++part) {
        const double part_s = piece.duration_s / parts;
        split(piece, part * part_s, (part + 1) * part_s, 0);
      }
    }
    if (points_.size() > 1) {
      points_.back().p_W = trajectory.derivative(0, trajectory.duration_s());
    }
  }
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }

 private:
  void add_point(const Vec3& p_W) {
    // A chord that is too short has no direction, and where a trajectory comes to rest its last
    // millimetres would pass for a sharp bend.
    if (points_.empty() || (points_.back().p_W - p_W).norm() >= merge_m_) {
      points_.push_back({p_W, false});
    }
  }
  /// Where two pieces meet. Merging must not move a corner.
  void join(const Vec3& p_W, bool is_stop) {
    points_.back().is_stop = is_stop;
    if (is_stop) {
      points_.back().p_W = p_W;
    }
  }
  void split(const PolynomialPiece& piece, double from_s, double to_s, int depth) {
    constexpr int max_depth = 24;  // 16 million parts of an eighth of a piece
    const double middle_s = 0.5 * (from_s + to_s);
    const Vec3 from = piece.derivative(0, from_s);
    const Vec3 middle = piece.derivative(0, middle_s);
    const Vec3 to = piece.derivative(0, to_s);
    const bool is_long = (middle - from).norm() + (to - middle).norm() > limit_m_;
    if (depth == max_depth || !is_long) {
      add_point(to);
      return;
    }
    split(piece, from_s, middle_s, depth + 1);
    split(piece, middle_s, to_s, depth + 1);
  }
  static bool is_at_rest(const PolynomialPiece& before, const PolynomialPiece& after) {
    const double usual_m_s = before.derivative(1, 0.5 * before.duration_s).norm() +
                             after.derivative(1, 0.5 * after.duration_s).norm();
    return before.derivative(1, before.duration_s).norm() <= 1e-3 * usual_m_s &&
           after.derivative(1, 0.0).norm() <= 1e-3 * usual_m_s;
  }

  double limit_m_;
  double merge_m_;
  std::vector<Point> points_;
};

/// Tangent of the parabola through three points at the middle one.
Vec3 tangent_at_middle(const Vec3& before, const Vec3& here, const Vec3& after) {
  const double h_in = (here - before).norm();
  const double h_out = (after - here).norm();
  const Vec3 tangent = (here - before) * (h_out / h_in) + (after - here) * (h_in / h_out);
  return tangent.norm() > 1e-9 * (h_in + h_out) ? Vec3{tangent.normalized()}
                                                : Vec3{(after - here).normalized()};
}

}  // namespace

void Path::append(const Vec3& p_W, const Vec3& tangent_W, double curvature_1_m) {
  const double s_m = empty() ? 0.0 : length_m() + (p_W - samples_.back().p_W).norm();
  samples_.push_back({s_m, p_W, tangent_W, curvature_1_m});
}

Path::Path(const Trajectory& trajectory, double step_m) {
  FLYBALL_ASSERT(step_m > 0.0, "step_m=%g", step_m);
  const Flattening flattening{trajectory, step_m};
  const std::vector<Point>& points = flattening.points();
  if (points.size() == 1) {
    append(points[0].p_W, Vec3::UnitX(), 0.0);
  }
  if (points.size() < 2) {
    return;
  }
  append(points[0].p_W, (points[1].p_W - points[0].p_W).normalized(), 0.0);
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vec3 in = points[i].p_W - points[i - 1].p_W;
    const Vec3 out = points[i + 1].p_W - points[i].p_W;
    const double turn_rad = angle_between(in, out);
    if (points[i].is_stop && turn_rad > corner_rad) {
      append(points[i].p_W, out.normalized(), infinite);
    } else {
      append(points[i].p_W, tangent_at_middle(points[i - 1].p_W, points[i].p_W, points[i + 1].p_W),
             2.0 * turn_rad / (in.norm() + out.norm()));
    }
  }
  append(points.back().p_W, (points.back().p_W - points[points.size() - 2].p_W).normalized(), 0.0);
  finish_ends();
}

void Path::finish_ends() {
  const std::size_t last = samples_.size() - 1;
  if (last < 2) {
    return;
  }
  const auto mirror = [](Sample& end, const Sample& inner) {
    if (std::isfinite(inner.curvature_1_m)) {  // a corner tells nothing about its neighbours
      end.curvature_1_m = inner.curvature_1_m;
      // a chord has the direction of its middle: as much again leads to the end
      end.tangent_W =
          (2.0 * end.tangent_W.dot(inner.tangent_W) * end.tangent_W - inner.tangent_W).normalized();
    }
  };
  mirror(samples_[0], samples_[1]);
  mirror(samples_[last], samples_[last - 1]);
}

Path Path::joined(const Path& head, double from_m, double to_m, const Path& tail) {
  if (head.empty()) {
    return tail;
  }
  const double first_m = std::clamp(from_m, 0.0, head.length_m());
  const double last_m = std::clamp(to_m, first_m, head.length_m());
  // A little inside, so that a corner exactly at a cut keeps its direction but is no corner.
  const double inside_m = std::min(same_place_m, 0.5 * (last_m - first_m));
  Path path;
  const Sample start = head.at(first_m + inside_m);
  path.append(head.at(first_m).p_W, start.tangent_W, start.curvature_1_m);
  for (const Sample& sample : head.samples_) {
    if (sample.s_m > first_m + same_place_m && sample.s_m < last_m - same_place_m) {
      path.append(sample.p_W, sample.tangent_W, sample.curvature_1_m);
    }
  }
  const Sample end = head.at(last_m - inside_m);
  if (last_m > first_m) {
    path.append(head.at(last_m).p_W, end.tangent_W, end.curvature_1_m);
  }
  if (!tail.empty()) {
    path.append_tail(tail);
  }
  return path;
}

void Path::append_tail(const Path& tail) {
  const Sample& start = tail.samples_.front();
  const Vec3 gap = start.p_W - samples_.back().p_W;
  if (gap.norm() > same_place_m) {  // a straight piece leads over
    bend(gap.normalized());
    append(start.p_W, gap.normalized(), 0.0);
  }
  bend(start.tangent_W);
  Sample& joint = samples_.back();
  joint.curvature_1_m = std::max(joint.curvature_1_m, start.curvature_1_m);
  for (std::size_t i = 1; i < tail.samples_.size(); ++i) {
    const Sample& sample = tail.samples_[i];
    append(sample.p_W, sample.tangent_W, sample.curvature_1_m);
  }
}

void Path::bend(const Vec3& tangent_W) {
  Sample& joint = samples_.back();
  if (samples_.size() > 1 && angle_between(joint.tangent_W, tangent_W) > corner_rad) {
    joint.curvature_1_m = infinite;
  }
  joint.tangent_W = tangent_W;
}

Path Path::polyline(const std::vector<Vec3>& points_W, double step_m) {
  FLYBALL_ASSERT(step_m > 0.0, "step_m=%g", step_m);
  Path path;
  for (const Vec3& point : points_W) {
    if (path.empty()) {
      path.append(point, Vec3::UnitX(), 0.0);
      continue;
    }
    const Vec3 start = path.samples_.back().p_W;
    const Vec3 line = point - start;
    if (line.norm() < same_place_m) {
      continue;
    }
    const Vec3 tangent = line.normalized();
    Sample& joint = path.samples_.back();
    if (path.samples_.size() > 1 && angle_between(joint.tangent_W, tangent) > same_place_m) {
      joint.curvature_1_m = infinite;
    }
    joint.tangent_W = tangent;
    const int parts = static_cast<int>(std::ceil(line.norm() / step_m));
    for (int part = 1; part <= parts; ++part) {
      path.append(start + line * (static_cast<double>(part) / parts), tangent, 0.0);
    }
  }
  return path;
}

Path::Sample Path::at(double s_m) const {
  FLYBALL_ASSERT(!empty(), "a path without samples has no place at %g m", s_m);
  const auto after =
      std::upper_bound(samples_.begin(), samples_.end(), s_m,
                       [](double s, const Sample& sample) { return s < sample.s_m; });
  if (after == samples_.begin()) {
    return samples_.front();
  }
  const Sample& a = *(after - 1);
  if (after == samples_.end() || s_m == a.s_m) {
    return a;
  }
  const Sample& b = *after;
  const double w = (s_m - a.s_m) / (b.s_m - a.s_m);
  Sample here{s_m, a.p_W + w * (b.p_W - a.p_W), a.tangent_W, a.curvature_1_m};
  if (std::isfinite(b.curvature_1_m)) {
    const Vec3 tangent = (1.0 - w) * a.tangent_W + w * b.tangent_W;
    here.tangent_W = tangent.norm() > same_place_m ? Vec3{tangent.normalized()} : b.tangent_W;
    here.curvature_1_m = std::isfinite(a.curvature_1_m)
                             ? (1.0 - w) * a.curvature_1_m + w * b.curvature_1_m
                             : b.curvature_1_m;
  } else if (!std::isfinite(a.curvature_1_m)) {
    here.curvature_1_m = 0.0;  // the straight line between two corners
  }
  return here;
}

}  // namespace flyball
