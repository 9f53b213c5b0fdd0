// SPDX-License-Identifier: BSD-3-Clause
#include "work_limit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace flyball {
namespace {

constexpr std::size_t shells = 64;

/// What the rays would cost if they went on for ever, by the shell in which they end.
class Shells {
 public:
  Shells(const Scan& scan, double cell_m)
      : origin_W_{scan.origin_W}, cell_m_{cell_m}, width_m_{scan.range_m / shells} {
    for (const auto* ends : {&scan.hits_W, &scan.clear_W}) {
      for (const octomap::point3d& end_W : *ends) {
        add(end_W);
      }
    }
  }

  /// Rays that end in this shell or beyond it: cells that they cross on one metre.
  [[nodiscard]] double cells_per_m(std::size_t shell) const {
    double sum = 0.0;
    for (std::size_t i = shell; i < shells; ++i) {
      sum += cells_per_m_[i];
    }
    return sum;
  }

 private:
  void add(const octomap::point3d& end_W) {
    const octomap::point3d ray = end_W - origin_W_;
    const double length_m = ray.norm();
    if (length_m <= 0.0) {
      return;
    }
    const double along_axes_m = static_cast<double>(std::abs(ray.x()) + std::abs(ray.y())) +
                                static_cast<double>(std::abs(ray.z()));
    const double shell = std::min(length_m / width_m_, static_cast<double>(shells - 1));
    cells_per_m_[static_cast<std::size_t>(shell)] += along_axes_m / (length_m * cell_m_);
  }

  octomap::point3d origin_W_;
  double cell_m_;
  double width_m_;
  std::array<double, shells> cells_per_m_{};
};

}  // namespace

double range_within(const Scan& scan, double cell_m, double traversals) {
  const Shells rays{scan, cell_m};
  const double width_m = scan.range_m / shells;
  double left = traversals;
  for (std::size_t shell = 0; shell < shells; ++shell) {
    const double cells = rays.cells_per_m(shell) * width_m;
    if (cells > left) {
      return std::max((static_cast<double>(shell) + left / cells) * width_m, cell_m);
    }
    left -= cells;
  }
  return scan.range_m;
}

}  // namespace flyball
