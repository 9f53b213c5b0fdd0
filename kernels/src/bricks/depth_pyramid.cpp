// SPDX-License-Identifier: BSD-3-Clause
#include "depth_pyramid.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flyball {

void DepthPyramid::build(const PointCloud& cloud_C, double range_m) {
  FLYBALL_ASSERT(cloud_C.camera.has_value(), "scan %llu has no camera",
                 static_cast<unsigned long long>(cloud_C.sequence));
  const Intrinsics& camera = *cloud_C.camera;
  width_ = camera.width_px;
  height_ = camera.height_px;
  depth_m_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0.0F);
  put(cloud_C.hits_C, camera, static_cast<float>(range_m));
  put(cloud_C.clear_C, camera, static_cast<float>(range_m));
  build_scales();
}

void DepthPyramid::put(const std::vector<Eigen::Vector3f>& points_C,
                       const Intrinsics& camera,
                       float cut_m) {
  const auto focal = static_cast<float>(camera.focal_px);
  // A pixel's ray passes through its middle, which is a whole number.
  const auto centre_u = static_cast<float>(camera.centre_x_px + 0.5);
  const auto centre_v = static_cast<float>(camera.centre_y_px + 0.5);
  for (const Eigen::Vector3f& p : points_C) {
    const float scale = focal / p.z();
    const float u = p.x() * scale + centre_u;
    const float v = p.y() * scale + centre_v;
    if (!(p.z() > 0.0F && u >= 0.0F && v >= 0.0F && u < static_cast<float>(width_) &&
          v < static_cast<float>(height_))) {
      continue;
    }
    const auto pixel = static_cast<std::size_t>(static_cast<int>(v) * width_ + static_cast<int>(u));
    depth_m_[pixel] =
        p.squaredNorm() > cut_m * cut_m ? std::numeric_limits<float>::infinity() : p.z();
  }
}

void DepthPyramid::build_scales() {
  scales_.clear();
  spans_.clear();
  scales_.push_back({0, width_, height_});
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
