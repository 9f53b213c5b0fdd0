// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/sim/observable_space.h"

#include "sensors/scan_grid.h"
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace flyball {
namespace {

constexpr std::array<GridCell, 6> neighbours{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
constexpr double between_views_m = 0.9;
constexpr double between_heights_m = 0.6;
constexpr double two_pi = 6.283185307179586;

/// A box of cells, each with a number.
class Lattice {
 public:
  Lattice(const Aabb& box_W, double cell_m)
      : cell_m_{cell_m},
        first_{grid_cell_of(box_W.min, cell_m)},
        last_{grid_cell_of(box_W.max - Vec3::Constant(1e-6), cell_m)} {}

  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(extent(0)) * static_cast<std::size_t>(extent(1)) *
           static_cast<std::size_t>(extent(2));
  }
  [[nodiscard]] bool contains(const GridCell& cell) const {
    return cell[0] >= first_[0] && cell[0] <= last_[0] && cell[1] >= first_[1] &&
           cell[1] <= last_[1] && cell[2] >= first_[2] && cell[2] <= last_[2];
  }
  [[nodiscard]] std::size_t index(const GridCell& cell) const {
    return static_cast<std::size_t>(((cell[2] - first_[2]) * extent(1) + cell[1] - first_[1]) *
                                        extent(0) +
                                    cell[0] - first_[0]);
  }
  [[nodiscard]] GridCell cell_at(std::size_t index) const {
    const auto wide = static_cast<std::size_t>(extent(0));
    const auto deep = static_cast<std::size_t>(extent(1));
    return {first_[0] + static_cast<int>(index % wide),
            first_[1] + static_cast<int>(index / wide % deep),
            first_[2] + static_cast<int>(index / (wide * deep))};
  }
  [[nodiscard]] double cell_m() const { return cell_m_; }
  /// Calls `visit` with each cell that a box of this half width around a point touches.
  template <class Visit>
  void around(const Vec3& p_W, double half_m, const Visit& visit) const {
    const GridCell from = grid_cell_of(p_W - Vec3::Constant(half_m), cell_m_);
    const GridCell to = grid_cell_of(p_W + Vec3::Constant(half_m), cell_m_);
    using Index = ScanGrid::Index;
    for_each_cell(Index{from.data()}.cwiseMax(Index{first_.data()}),
                  Index{to.data()}.cwiseMin(Index{last_.data()}), [&](const Index& cell) {
                    visit(GridCell{cell.x(), cell.y(), cell.z()});
                  });
  }

 private:
  [[nodiscard]] int extent(std::size_t axis) const { return last_[axis] - first_[axis] + 1; }

  double cell_m_;
  GridCell first_;
  GridCell last_;
};

/// Cells in whose centres the body can stand, as far as it gets.
std::vector<GridCell> reached(const World& world,
                              const ObservableRequest& request,
                              const Lattice& lattice) {
  const Clearance clearance{world};
  constexpr double touch_m = 0.01;
  const auto is_open = [&](const GridCell& cell) {
    const Vec3 p_W = centre_of(cell, lattice.cell_m());
    return world.bounds_W.contains(p_W) &&
           clearance.distance_m(p_W, request.body, touch_m, true) > 0.0;
  };
  std::vector<bool> seen(lattice.size(), false);
  std::vector<GridCell> queue;
  const auto enter = [&](const GridCell& cell) {
    if (lattice.contains(cell) && !seen[lattice.index(cell)]) {
      seen[lattice.index(cell)] = true;
      if (is_open(cell)) {
        queue.push_back(cell);
      }
    }
  };
  enter(grid_cell_of(request.start_W, lattice.cell_m()));
  for (std::size_t i = 0; i < queue.size(); ++i) {
    for (const GridCell& step : neighbours) {
      const GridCell cell = queue[i];
      enter({cell[0] + step[0], cell[1] + step[1], cell[2] + step[2]});
    }
  }
  return queue;
}

/// One place in each block of the given size: that which the flood reached first.
std::vector<Vec3> views(const std::vector<GridCell>& reached, const Lattice& lattice) {
  const int across = std::max(1, static_cast<int>(std::lround(between_views_m / lattice.cell_m())));
  const int up = std::max(1, static_cast<int>(std::lround(between_heights_m / lattice.cell_m())));
  const auto block = [](int i, int size) {
    return static_cast<int>(std::floor(static_cast<double>(i) / size));
  };
  std::vector<GridCell> blocks;
  std::vector<std::pair<GridCell, std::size_t>> sorted;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const GridCell& cell = reached[i];
    sorted.push_back({{block(cell[0], across), block(cell[1], across), block(cell[2], up)}, i});
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<Vec3> places_W;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || sorted[i].first != sorted[i - 1].first) {
      places_W.push_back(centre_of(reached[sorted[i].second], lattice.cell_m()));
    }
  }
  return places_W;
}

/// The camera of the request, with as many pixels as the cells need, and no noise.
DepthCameraSpec coarse_camera(const ObservableRequest& request) {
  DepthCameraSpec camera = request.camera;
  const double tan_across = std::tan(0.5 * camera.horizontal_field_rad);
  const double ratio = static_cast<double>(camera.height_px) / camera.width_px;
  camera.width_px =
      static_cast<int>(std::ceil(2.0 * tan_across * request.range_m / request.cell_m));
  camera.height_px = std::max(8, static_cast<int>(std::lround(ratio * camera.width_px)));
  camera.rgbd_noise = false;
  camera.extra_noise_m = 0.0;
  camera.max_range_m = 1.1 * request.range_m * std::hypot(1.0, tan_across * std::hypot(1.0, ratio));
  return camera;
}

/// Of a level body at `p_W`.
Pose mounted_camera(const DepthCameraSpec& mount, const Vec3& p_W, double yaw_rad) {
  Eigen::Matrix3d R_BC;  // clang-format off
  R_BC << 0, 0, 1,
         -1, 0, 0,
          0, -1, 0;  // clang-format on
  Pose X_WC = Pose::Identity();
  const Eigen::Matrix3d R_WB = Eigen::AngleAxisd{yaw_rad, Vec3::UnitZ()}.toRotationMatrix();
  X_WC.linear() = R_WB * R_BC;
  if (mount.pitch_down_rad != 0.0) {
    const Eigen::AngleAxisd tilt{mount.pitch_down_rad, Vec3::UnitY()};
    X_WC.linear() = R_WB * tilt.toRotationMatrix() * R_BC;
  }
  X_WC.translation() = p_W + R_WB * Vec3{mount.forward_m, 0.0, mount.up_m};
  return X_WC;
}

/// Looks from place to place. A cell that was seen is not asked for again, and one out of range
/// only once for all headings, so most views are cheap.
class Observer {
 public:
  Observer(const World& world, const ObservableRequest& request, const Lattice& lattice)
      : lattice_{lattice},
        range_m_{request.range_m},
        camera_{world, coarse_camera(request), 0},
        rays_{rays_of(camera_.spec().intrinsics())},
        headings_{headings_of(request.camera)},
        seen_(lattice.size(), unseen) {}

  void look_around(const Vec3& p_W) {
    missing_.clear();
    lattice_.around(p_W, range_m_, [&](const GridCell& cell) {
      const std::size_t index = lattice_.index(cell);
      if (seen_[index] != unseen) {
        return;
      }
      const Vec3 centre_W = centre_of(cell, lattice_.cell_m());
      if ((centre_W - p_W).squaredNorm() <= range_m_ * range_m_) {
        missing_.push_back({index, centre_W});
      }
    });
    for (int i = 0; i < headings_; ++i) {
      look(mounted_camera(camera_.spec(), p_W, two_pi * i / headings_));
    }
  }

  [[nodiscard]] ObservableSpace space() const {
    ObservableSpace space;
    space.cell_m = lattice_.cell_m();
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      if (seen_[i] != unseen) {
        space.cells.push_back(lattice_.cell_at(i));
      }
      if (seen_[i] == surface) {
        space.surfaces.push_back(lattice_.cell_at(i));
      }
    }
    return space;
  }

 private:
  static constexpr std::uint8_t unseen = 0;
  static constexpr std::uint8_t open = 1;
  static constexpr std::uint8_t surface = 2;
  struct Missing {
    std::size_t index;
    Vec3 centre_W;
  };
  struct PixelRay {
    Vec3 at_1m_C;       ///< Where a depth of 1 m lies.
    double range_1m_m;  ///< How far from the camera that is.
  };

  /// A tilted camera sees less of the circle at each height, so it looks twice as often.
  static int headings_of(const DepthCameraSpec& camera) {
    const int level = static_cast<int>(std::ceil(two_pi / camera.horizontal_field_rad));
    return camera.pitch_down_rad == 0.0 ? level : 2 * level;
  }
  static std::vector<PixelRay> rays_of(const Intrinsics& camera) {
    std::vector<PixelRay> rays;
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) {
        const Vec3 at_1m_C{(u - camera.centre_x_px) / camera.focal_px,
                           (v - camera.centre_y_px) / camera.focal_px, 1.0};
        rays.push_back({at_1m_C, at_1m_C.norm()});
      }
    }
    return rays;
  }

  void look(const Pose& X_WC) {
    const DepthImage image = camera_.capture(X_WC, MissionTime{}, 0);
    for (std::size_t pixel = 0; pixel < rays_.size(); ++pixel) {
      mark_surface(rays_[pixel], static_cast<double>(image.depth_m[pixel]), X_WC);
    }
    const Pose X_CW = X_WC.inverse();
    for (const Missing& cell : missing_) {
      if (seen_[cell.index] == unseen && is_in_sight(image, X_CW * cell.centre_W)) {
        seen_[cell.index] = open;
      }
    }
  }

  void mark_surface(const PixelRay& ray, double depth_m, const Pose& X_WC) {
    if (depth_m * ray.range_1m_m > range_m_) {
      return;
    }
    const GridCell end = grid_cell_of(X_WC * Vec3{ray.at_1m_C * depth_m}, lattice_.cell_m());
    if (lattice_.contains(end)) {
      seen_[lattice_.index(end)] = surface;
    }
  }

  [[nodiscard]] bool is_in_sight(const DepthImage& image, const Vec3& p_C) const {
    if (p_C.z() <= 0.0) {
      return false;
    }
    const Intrinsics& camera = image.camera;
    const double scale = camera.focal_px / p_C.z();
    const auto u = static_cast<int>(std::lround(camera.centre_x_px + scale * p_C.x()));
    const auto v = static_cast<int>(std::lround(camera.centre_y_px + scale * p_C.y()));
    return u >= 0 && v >= 0 && u < camera.width_px && v < camera.height_px &&
           p_C.z() <= static_cast<double>(
                          image.depth_m[static_cast<std::size_t>(v) * camera.width_px + u]);
  }

  const Lattice& lattice_;
  double range_m_;
  DepthCamera camera_;
  std::vector<PixelRay> rays_;  ///< Of each pixel, row by row.
  int headings_;
  std::vector<std::uint8_t> seen_;
  std::vector<Missing> missing_{};  ///< In range of the place that is looked around from.
};

}  // namespace

ObservableSpace observable_space(const World& world, const ObservableRequest& request) {
  Aabb box = world.bounds_W;
  box.min = box.min.cwiseMin(request.start_W);
  box.max = box.max.cwiseMax(request.start_W);
  const Lattice places{box, request.cell_m};
  const Lattice volume{world.volume_W, request.cell_m};
  Observer observer{world, request, volume};
  for (const Vec3& p_W : views(reached(world, request, places), places)) {
    observer.look_around(p_W);
  }
  return observer.space();
}

}  // namespace flyball
