// SPDX-License-Identifier: BSD-3-Clause
#include "depth_pyramid.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {

void DepthPyramid::build(const PointCloud& cloud_C, double range_m, const InnerLoops& loops) {
  FLYBALL_ASSERT(cloud_C.camera.has_value(), "scan %llu has no camera",
                 static_cast<unsigned long long>(cloud_C.sequence));
  const Intrinsics& camera = *cloud_C.camera;
  grid_ = {static_cast<float>(camera.focal_px), static_cast<float>(camera.centre_x_px + 0.5),
           static_cast<float>(camera.centre_y_px + 0.5), camera.width_px, camera.height_px};
  depth_m_.assign(
      static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px), 0.0F);
  put(cloud_C.hits_C, static_cast<float>(range_m), loops);
  put(cloud_C.clear_C, static_cast<float>(range_m), loops);
  build_scales();
}

void DepthPyramid::put(const std::vector<Eigen::Vector3f>& points_C,
                       float cut_m,
                       const InnerLoops& loops) {
  for (std::size_t first = 0; first < points_C.size(); first += lanes) {
    const std::size_t count = std::min(lanes, points_C.size() - first);
    PointBlock points;
    points.take(&points_C[first], count);
    Lanes<std::int32_t> pixels;
    loops.project_points(points, grid_, pixels);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const float x = points.p[0][lane];
      const float y = points.p[1][lane];
      const float z = points.p[2][lane];
      if (pixels[lane] >= 0) {
        depth_m_[static_cast<std::size_t>(pixels[lane])] =
            x * x + y * y + z * z > cut_m * cut_m ? std::numeric_limits<float>::infinity() : z;
      }
    }
  }
}

void DepthPyramid::build_scales() {
  scales_.clear();
  spans_.clear();
  scales_.push_back({0, grid_.width_px, grid_.height_px});
  for (const float depth : depth_m_) {
    spans_.push_back({depth, depth});
  }
  while (scales_.back().width > 1 || scales_.back().height > 1) {
    const Scale fine = scales_.back();
    const Scale coarse{spans_.size(), (fine.width + 1) / 2, (fine.height + 1) / 2};
    spans_.resize(coarse.first + static_cast<std::size_t>(coarse.width * coarse.height));
    DepthSpan* out = &spans_[coarse.first];
    for (int v = 0; v < coarse.height; ++v) {
      const DepthSpan* upper = &spans_[fine.first + static_cast<std::size_t>(2 * v * fine.width)];
      const DepthSpan* lower = 2 * v + 1 < fine.height ? upper + fine.width : upper;
      for (int u = 0; u < coarse.width; ++u) {
        const int left = 2 * u;
        const int right = std::min(left + 1, fine.width - 1);
        const DepthSpan parts[4] = {upper[left], upper[right], lower[left], lower[right]};
        *out++ = {std::min(std::min(parts[0].least, parts[1].least),
                           std::min(parts[2].least, parts[3].least)),
                  std::max(std::max(parts[0].most, parts[1].most),
                           std::max(parts[2].most, parts[3].most))};
      }
    }
    scales_.push_back(coarse);
  }
}

DepthSpan DepthPyramid::span(const PixelBlock& block) const {
  // The scale at which the block is two or three texels wide: coarser ones see far beside it.
  const int edge = std::max(block.u1 - block.u0, block.v1 - block.v0);
  unsigned scale = 0;
  while (edge >> scale > 1 && scale + 1 < scales_.size()) {
    ++scale;
  }
  const Scale& at = scales_[scale];
  DepthSpan whole{std::numeric_limits<float>::infinity(), 0.0F};
  for (int v = block.v0 >> scale; v <= block.v1 >> scale; ++v) {
    const DepthSpan* row = &spans_[at.first + static_cast<std::size_t>(v * at.width)];
    for (int u = block.u0 >> scale; u <= block.u1 >> scale; ++u) {
      whole.least = std::min(whole.least, row[u].least);
      whole.most = std::max(whole.most, row[u].most);
    }
  }
  return whole;
}

}  // namespace flyball
