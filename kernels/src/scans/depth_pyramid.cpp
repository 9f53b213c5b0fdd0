// SPDX-License-Identifier: BSD-3-Clause
// tested-in: depth_view
#include "depth_pyramid.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <limits>

namespace flyball {
namespace {

constexpr std::size_t spare = lanes;  // so many are read from the last one on

}  // namespace

void DepthPyramid::build(const PointCloud& cloud_C, double range_m, const InnerLoops& loops) {
  FLYBALL_ASSERT(cloud_C.camera.has_value(), "scan %llu has no camera",
                 static_cast<unsigned long long>(cloud_C.sequence));
  (void)begin(*cloud_C.camera);
  std::fill(depth_m_.begin(), depth_m_.end(), 0.0F);
  put(cloud_C.hits_C, static_cast<float>(range_m), loops);
  put(cloud_C.clear_C, static_cast<float>(range_m), loops);
  finish(loops);
}

float* DepthPyramid::begin(const Intrinsics& camera) {
  lay_out(camera);
  return depth_m_.data();
}

void DepthPyramid::finish(const InnerLoops& loops) {
  for (std::size_t scale = 1; scale < scales_.size(); ++scale) {
    build_scale(scale, loops);
  }
}

void DepthPyramid::lay_out(const Intrinsics& camera) {
  grid_ = {static_cast<float>(camera.focal_px), static_cast<float>(camera.centre_x_px + 0.5),
           static_cast<float>(camera.centre_y_px + 0.5), camera.width_px, camera.height_px};
  scales_.clear();
  scales_.push_back({0, camera.width_px, camera.height_px});
  std::size_t texels = 0;
  while (scales_.back().width > 1 || scales_.back().height > 1) {
    const Scale fine = scales_.back();
    scales_.push_back({texels, (fine.width + 1) / 2, (fine.height + 1) / 2});
    texels += static_cast<std::size_t>(scales_.back().width) *
              static_cast<std::size_t>(scales_.back().height);
  }
  depth_m_.resize(static_cast<std::size_t>(camera.width_px) *
                      static_cast<std::size_t>(camera.height_px) +
                  spare);
  least_m_.resize(texels + spare);
  most_m_.resize(texels + spare);
  views_.clear();
  for (std::size_t scale = 0; scale < scales_.size(); ++scale) {
    const DepthRows first = rows(scale, 0, 0);
    views_.push_back({first.least[0], first.most[0], scales_[scale].width});
  }
}

void DepthPyramid::put(const std::vector<Eigen::Vector3f>& points_C,
                       float range_m,
                       const InnerLoops& loops) {
  for (std::size_t first = 0; first < points_C.size(); first += lanes) {
    const std::size_t count = std::min(lanes, points_C.size() - first);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): filled next
    PointBlock points;
    take_points(loops, &points_C[first], count, points);
    loops.put_depths(points, grid_, range_m * range_m, depth_m_.data());
  }
}

DepthRows DepthPyramid::rows(std::size_t scale, int upper, int lower) const {
  const Scale& at = scales_[scale];
  const float* least = scale == 0 ? depth_m_.data() : least_m_.data() + at.first;
  const float* most = scale == 0 ? depth_m_.data() : most_m_.data() + at.first;
  const auto up = static_cast<std::ptrdiff_t>(upper) * at.width;
  const auto low = static_cast<std::ptrdiff_t>(lower) * at.width;
  return {{least + up, least + low}, {most + up, most + low}};
}

void DepthPyramid::build_scale(std::size_t scale, const InnerLoops& loops) {
  const Scale& fine = scales_[scale - 1];
  const Scale& coarse = scales_[scale];
  const auto pairs = static_cast<std::size_t>(fine.width / 2);
  for (int v = 0; v < coarse.height; ++v) {
    const DepthRows from = rows(scale - 1, 2 * v, std::min(2 * v + 1, fine.height - 1));
    const std::size_t first = coarse.first + static_cast<std::size_t>(v * coarse.width);
    loops.halve_rows(from, pairs, &least_m_[first], &most_m_[first]);
    if (fine.width % 2 != 0) {  // the last texel has no neighbour
      least_m_[first + pairs] = std::min(from.least[0][2 * pairs], from.least[1][2 * pairs]);
      most_m_[first + pairs] = std::max(from.most[0][2 * pairs], from.most[1][2 * pairs]);
    }
  }
}

DepthSpan DepthPyramid::span(const PixelBlock& block, int texels) const {
  // Coarser scales see far beside the block.
  const int edge = std::max(block.u1 - block.u0, block.v1 - block.v0);
  unsigned scale = 0;
  while (edge >> scale > texels && scale + 1 < scales_.size()) {
    ++scale;
  }
  DepthSpan whole{std::numeric_limits<float>::infinity(), 0.0F};
  for (int v = block.v0 >> scale; v <= block.v1 >> scale; ++v) {
    const DepthRows row = rows(scale, v, v);
    for (int u = block.u0 >> scale; u <= block.u1 >> scale; ++u) {
      whole.least = std::min(whole.least, row.least[0][u]);
      whole.most = std::max(whole.most, row.most[0][u]);
    }
  }
  return whole;
}

}  // namespace flyball
