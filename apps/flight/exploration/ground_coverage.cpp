// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/exploration/ground_coverage.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

/// On which side of the line from a to b, seen from above: positive to the left.
double side(const Vec3& a, const Vec3& b, const Vec3& p) {
  return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
}

/// For a convex quadrangle of either sense; its edge belongs to it.
bool holds(const Footprint& quad, const Vec3& p) {
  bool any_left = false;
  bool any_right = false;
  for (std::size_t i = 0; i < quad.size(); ++i) {
    const double s = side(quad[i], quad[(i + 1) % quad.size()], p);
    any_left = any_left || s > 0.0;
    any_right = any_right || s < 0.0;
  }
  return !(any_left && any_right);
}

/// Cells whose centres lie in [low, high], clipped to the grid: first, and one past the last.
std::pair<int, int> cells_between(double low, double high, double cell_m, int count) {
  const double first = std::ceil(low / cell_m - 0.5);
  const double last = std::floor(high / cell_m - 0.5);
  return {static_cast<int>(std::clamp(first, 0.0, static_cast<double>(count))),
          static_cast<int>(std::clamp(last + 1.0, 0.0, static_cast<double>(count)))};
}

}  // namespace

Pose downward_camera_pose(const Pose& X_WB) {
  const double yaw = yaw_of(X_WB.linear().col(0));
  Eigen::Matrix3d R_BC;  // clang-format off
  R_BC << 0, -1,  0,
         -1,  0,  0,
          0,  0, -1;  // clang-format on
  Pose X_WC = Pose::Identity();
  X_WC.linear() = Eigen::AngleAxisd{yaw, Vec3::UnitZ()}.toRotationMatrix() * R_BC;
  X_WC.translation() = X_WB.translation();
  return X_WC;
}

std::optional<Footprint> footprint_of(const Pose& X_WC,
                                      const Intrinsics& camera,
                                      double ground_z_m) {
  const std::array<std::array<double, 2>, 4> corners_px{
      {{0.0, 0.0},
       {static_cast<double>(camera.width_px), 0.0},
       {static_cast<double>(camera.width_px), static_cast<double>(camera.height_px)},
       {0.0, static_cast<double>(camera.height_px)}}};
  Footprint footprint{};
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    // A pixel has its centre at its whole number, so the image begins half a pixel before the
    // first.
    const Vec3 ray_C{(corners_px[i][0] - 0.5 - camera.centre_x_px) / camera.focal_px,
                     (corners_px[i][1] - 0.5 - camera.centre_y_px) / camera.focal_px, 1.0};
    const Vec3 ray_W = X_WC.linear() * ray_C;
    const double reach = (ground_z_m - X_WC.translation().z()) / ray_W.z();
    if (!(ray_W.z() < 0.0) || !(reach > 0.0) || !std::isfinite(reach)) {
      return std::nullopt;
    }
    footprint[i] = X_WC.translation() + reach * ray_W;
  }
  return footprint;
}

std::vector<Field> row_of(const Footprint& footprint) {
  constexpr std::array<const char*, 8> names{"x0_m", "y0_m", "x1_m", "y1_m",
                                             "x2_m", "y2_m", "x3_m", "y3_m"};
  std::vector<Field> row;
  for (std::size_t i = 0; i < footprint.size(); ++i) {
    row.push_back({names[2 * i], footprint[i].x()});
    row.push_back({names[2 * i + 1], footprint[i].y()});
  }
  return row;
}

GroundCoverage::GroundCoverage(const Aabb& area_W, double cell_m)
    : area_W_{area_W}, cell_m_{cell_m} {
  const Vec3 extent = area_W.max - area_W.min;
  FLYBALL_ASSERT(extent.x() > 0.0 && extent.y() > 0.0 && cell_m > 0.0, "%g m x %g m, cell %g m",
                 extent.x(), extent.y(), cell_m);
  columns_ = std::max(1, static_cast<int>(std::lround(extent.x() / cell_m)));
  rows_ = std::max(1, static_cast<int>(std::lround(extent.y() / cell_m)));
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
}

void GroundCoverage::add(const Footprint& footprint) {
  ++pictures_;
  Vec3 low = footprint[0];
  Vec3 high = footprint[0];
  for (const Vec3& corner : footprint) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  low -= area_W_.min;
  high -= area_W_.min;
  const auto [first_column, end_column] = cells_between(low.x(), high.x(), cell_m_, columns_);
  const auto [first_row, end_row] = cells_between(low.y(), high.y(), cell_m_, rows_);
  for (int row = first_row; row < end_row; ++row) {
    look_along(row, first_column, end_column, footprint);
  }
}

void GroundCoverage::look_along(int row,
                                int first_column,
                                int end_column,
                                const Footprint& footprint) {
  for (int column = first_column; column < end_column; ++column) {
    const Vec3 centre_W = area_W_.min + Vec3{(column + 0.5) * cell_m_, (row + 0.5) * cell_m_, 0.0};
    if (!holds(footprint, centre_W)) {
      continue;
    }
    Cell& cell = cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                        static_cast<std::size_t>(column)];
    const bool stayed_in_view = cell.last_picture != 0 && cell.last_picture == pictures_ - 1;
    cell.visits += stayed_in_view ? 0 : 1;
    cell.last_picture = pictures_;
  }
}

double GroundCoverage::percent(int least_visits, std::size_t of) const {
  const auto seen = std::count_if(cells_.begin(), cells_.end(), [least_visits](const Cell& cell) {
    return cell.visits >= least_visits;
  });
  return of == 0 ? 0.0 : 100.0 * static_cast<double>(seen) / static_cast<double>(of);
}

double GroundCoverage::covered_percent() const {
  return percent(1, cells_.size());
}

double GroundCoverage::overlap_percent() const {
  const auto covered =
      std::count_if(cells_.begin(), cells_.end(), [](const Cell& cell) { return cell.visits > 0; });
  return percent(2, static_cast<std::size_t>(covered));
}

}  // namespace flyball
