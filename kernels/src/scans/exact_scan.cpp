// SPDX-License-Identifier: BSD-3-Clause
#include "exact_scan.h"

#include "flyball/runtime/assert.h"

#include "bricks/bits.h"
#include "maps/ray_walk.h"
#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr std::size_t few = 16;  ///< If more rays than this part are walked, all may as well be.

/// What floats up to this size, and sums of a few of them, may be off, with some to spare: a float
/// is right to 6e-8 of it.
double slack_at(double greatest_m) {
  constexpr double least_m = 1e-6;
  constexpr double share = 5e-7;
  return least_m + share * greatest_m;
}

}  // namespace

ExactScan::ExactScan(double cell_m, Simd simd)
    : lattice_{cell_m},
      stock_lattice_{cell_m},
      loops_{inner_loops(simd)},
      rays_{cell_m, RayScan::Match::stock, simd},
      view_{cell_m, loops_} {
  frame_.cell_m = cell_m;
  frame_.cells_per_m = lattice_.cells_per_m();
}

const ScanMasks& ExactScan::compute(const PointCloudFrame& frame,
                                    const Pose& X_WC,
                                    double range_m) {
  FLYBALL_ASSERT(frame.pixels.has_value(), "scan %llu has no image",
                 static_cast<unsigned long long>(frame.sequence));
  constexpr double least_px = 2.0;  // measured with map_bench
  const double cell_px = frame_.cell_m * frame.pixels->image.value().camera.focal_px / range_m;
  return cell_px < least_px ? walk(frame.cloud_C.value(), X_WC, range_m)
                            : descend(frame, X_WC, range_m);
}

const ScanMasks& ExactScan::descend(const PointCloudFrame& frame,
                                    const Pose& X_WC,
                                    double range_m) {
  walked_ = 0;
  measured_ = 0;
  traversals_ = 0;
  masks_.bricks.clear();
  look(*frame.pixels, X_WC, range_m);
  settle();
  bool is_settled = walked_ <= measured_ / few;
  if (is_settled) {
    free_seen(X_WC.inverse());
    walk_doubtful();
    is_settled = knows_corner();
  }
  masks_.updates = static_cast<double>(window_.collect(masks_.bricks));
  masks_.rays = static_cast<double>(measured_);
  masks_.traversals = static_cast<double>(traversals_);
  return is_settled ? masks_ : walk(frame.cloud_C.value(), X_WC, range_m);
}

const ScanMasks& ExactScan::walk(const PointCloud& cloud_C, const Pose& X_WC, double range_m) {
  to_world(cloud_C, X_WC, scan_);
  scan_.range_m = range_m;
  walked_ = scan_.hits_W.size() + scan_.clear_W.size();
  return rays_.compute(scan_);
}

void ExactScan::look(const RangeImage& pixels, const Pose& X_WC, double range_m) {
  const Eigen::Vector3f origin_W = X_WC.translation().cast<float>();
  camera_W_ = origin_W.cast<double>();
  const CellKey cell = lattice_.cell(camera_W_);
  const Vec3 slack_m =
      camera_W_.cwiseAbs().unaryExpr([&](double m) { return slack_at(m + range_m); });
  beside_ = borders_near(camera_W_, cell, 3.0 * slack_m);
  corner_m_ = 4.0 * slack_m.maxCoeff();
  const DepthImage& image = pixels.image.value();
  image_rays_.look(image, pixels.reach_m, range_m);
  image_rays_.lay_ends(X_WC, slack_m.maxCoeff(), view_.begin(image.camera), loops_);
  const double block_slack_m =
      slack_at(camera_W_.cwiseAbs().maxCoeff() + range_m + lattice_.cell_m(chunk_level));
  view_.look(X_WC, range_m, {block_slack_m, block_slack_m, true});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box_.half[axis] = static_cast<float>(0.5 * frame_.cell_m);
    box_.slack[axis] = static_cast<float>(slack_m(static_cast<int>(axis)));
  }
  constexpr double ball_px = 0.75;  // a disc that wide holds the middle of a pixel
  ball_reach_m_ = (0.5 * frame_.cell_m - block_slack_m) * image.camera.focal_px / ball_px;
  frame_.range_m = range_m;
  frame_.origin_W = {origin_W.x(), origin_W.y(), origin_W.z()};
  frame_.start = {cell.x, cell.y, cell.z};
  rows_ = rows_of(X_WC);
  span_window(X_WC);
  aim_ends(cell, range_m);
}

void ExactScan::aim_ends(const CellKey& own, double range_m) {
  constexpr double share = 1.2e-7;  // of a place in W: what stock's floats may be off, twice
  const Vec3 in_cell = camera_W_ - lattice_.cube(own, 0).min;
  ends_.range_m = static_cast<float>(range_m);
  ends_.cells_per_m = static_cast<float>(frame_.cells_per_m);
  ends_.range_doubt_m =
      static_cast<float>(3.0 * slack_at(camera_W_.cwiseAbs().maxCoeff() + range_m));
  ends_.window = window_.chunks();
  // A cut moves its end along the ray by what the farthest coordinate's float is off.
  ends_.cut_doubt = static_cast<float>(frame_.cells_per_m * 2.0 * share *
                                       (camera_W_.cwiseAbs().maxCoeff() + range_m));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto row = static_cast<int>(axis);
    for (std::size_t column = 0; column < 3; ++column) {
      ends_.R_WC[axis][column] = static_cast<float>(rows_[axis][column]);
    }
    ends_.in_cell[axis] = static_cast<float>(in_cell(row));
    ends_.start[axis] = frame_.start[axis] - ends_.window.first[axis];
    ends_.doubt[axis] =
        static_cast<float>(frame_.cells_per_m * (2.0 * slack_at(range_m) +
                                                 share * (std::abs(camera_W_(row)) + range_m)));
  }
}

/// Along each axis, to which neighbour of a cell a point in it is as near as that: -1, 0 or 1.
std::array<int, 3> ExactScan::borders_near(const Vec3& p_W,
                                           const CellKey& cell,
                                           const Vec3& near_m) const {
  const Aabb cube = lattice_.cube(cell, 0);
  std::array<int, 3> beside{};
  for (int axis = 0; axis < 3; ++axis) {
    beside[static_cast<std::size_t>(axis)] = p_W(axis) - cube.min(axis) < near_m(axis)   ? -1
                                             : cube.max(axis) - p_W(axis) < near_m(axis) ? 1
                                                                                         : 0;
  }
  return beside;
}

/// Where the rays begin on a border of cells they may touch cells around it without any length, as
/// stock's ties decide: a few rays are walked. False if a cell there, towards which some ray
/// points, is still not known to be free: few rays cannot tell that.
bool ExactScan::knows_corner() {
  if (beside_ == std::array<int, 3>{}) {
    return true;
  }
  constexpr int apart_px = 16;
  for (int v = 0; v < image_rays_.height_px(); v += apart_px) {
    for (int u = 0; u < image_rays_.width_px(); u += apart_px) {
      free_pixel(v * image_rays_.width_px() + u);
    }
  }
  for (unsigned which = 1; which < 8; ++which) {
    std::array<int, 3> key = frame_.start;
    bool is_beside = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool turns = (which >> axis & 1U) != 0;
      key[axis] += turns ? beside_[axis] : 0;
      is_beside = is_beside && (!turns || image_rays_.any_towards(axis, beside_[axis]));
    }
    const CellKey cell{key[0], key[1], key[2]};
    if (is_beside && (window_.marks(window_.place_of_cell(cell)) >> bit_in_brick(cell) & 1U) == 0) {
      return false;
    }
  }
  return true;
}

void ExactScan::span_window(const Pose& X_WC) {
  // A walk in OctoMap's arithmetic may step past its end by a cell.
  const Aabb box = view_.box_of_view(X_WC, frame_.range_m, 2.0 * frame_.cell_m);
  first_chunk_ = lattice_.cell(box.min).above(chunk_level);
  last_chunk_ = lattice_.cell(box.max).above(chunk_level);
  window_.span(first_chunk_, last_chunk_);
}

/// Counts what rays cross, and marks hits.
void ExactScan::settle() {
  for (int v = 0; v < image_rays_.height_px(); ++v) {
    for (int u = 0; u < image_rays_.width_px(); u += static_cast<int>(lanes)) {
      settle_block(u, v);
    }
  }
}

void ExactScan::settle_block(int u, int v) {
  // NOLINTBEGIN(cppcoreguidelines-pro-type-member-init): filled next
  PointBlock points;
  PixelKinds kinds;
  RayEnds settled;
  // NOLINTEND(cppcoreguidelines-pro-type-member-init)
  image_rays_.points_from(u, v, points, kinds, loops_);
  loops_.settle_rays(points, kinds, ends_, settled);
  measured_ += count_bits(settled.rays);
  traversals_ += static_cast<std::size_t>(settled.steps);
  for (std::uint64_t left = settled.rays & ~settled.sure; left != 0; left &= left - 1) {
    traversals_ += count_pixel(v * image_rays_.width_px() + u + static_cast<int>(lowest_bit(left)));
  }
  for (const std::int32_t at : settled.cells) {
    if (at >= 0) {
      const auto cell = static_cast<std::size_t>(at);
      window_.add_hit(cell >> 6U, std::uint64_t{1} << (cell & 63U));
    }
  }
}

void ExactScan::free_cell(const CellKey& cell) {
  window_.add_free(window_.place_of_cell(cell), std::uint64_t{1} << bit_in_brick(cell));
}

/// The rays of the pixels in question. What they cross is counted already.
void ExactScan::walk_doubtful() {
  std::sort(doubtful_px_.begin(), doubtful_px_.end());
  doubtful_px_.erase(std::unique(doubtful_px_.begin(), doubtful_px_.end()), doubtful_px_.end());
  for (const int pixel : doubtful_px_) {
    free_pixel(pixel);
  }
  doubtful_px_.clear();
}

/// The ray of a pixel in OctoMap's arithmetic. Nothing where nothing was measured.
std::optional<ExactScan::StockRay> ExactScan::stock_ray(int pixel) {
  const auto end_C = image_rays_.point(pixel);
  if (!end_C) {
    return std::nullopt;
  }
  ++walked_;
  PointBlock point{};
  std::array<float, 3 * lanes> end_W{};
  point.take(&end_C->p_C, 1);
  loops_.move_to_world(point, rows_, end_W.data());
  PointBlock end{};
  const octomap::point3d uncut_W{end_W[0], end_W[1], end_W[2]};
  end.take(&uncut_W, 1);
  loops_.cut_rays(end, frame_);
  const octomap::point3d from{frame_.origin_W[0], frame_.origin_W[1], frame_.origin_W[2]};
  const octomap::point3d to{end.p[0][0], end.p[1][0], end.p[2][0]};
  return StockRay{RayWalk{stock_lattice_, from, to},
                  {end.key[0][0], end.key[1][0], end.key[2][0]},
                  end_C->is_hit && end.reaches[0] != 0};
}

/// How many cells it crosses. Marks its hit; what it frees is found with all others.
std::size_t ExactScan::count_pixel(int pixel) {
  const auto ray = stock_ray(pixel);
  if (!ray) {
    return 0;
  }
  if (ray->hits) {
    window_.add_hit(window_.place_of_cell(ray->end), std::uint64_t{1} << bit_in_brick(ray->end));
  }
  return ray->walk.visit_free([](const RayWalk::Cell&) {});
}

/// Frees what it crosses.
void ExactScan::free_pixel(int pixel) {
  if (const auto ray = stock_ray(pixel)) {
    (void)ray->walk.visit_free([this](const RayWalk::Cell& at) {
      free_cell({at[0], at[1], at[2]});
    });
  }
}

}  // namespace flyball
