// SPDX-License-Identifier: BSD-3-Clause
#include "mcap/map_changes.h"

#include "flyball/kernels/pixel_point.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

// A cell's number on each axis, in 21 bits: at 5 cm, 52 km in each direction.
constexpr unsigned axis_bits = 21;
constexpr std::int64_t middle = std::int64_t{1} << (axis_bits - 1);
constexpr std::uint64_t axis_mask = (std::uint64_t{1} << axis_bits) - 1;

std::uint64_t key_of(const Vec3& p_W, double resolution_m) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<std::int64_t>(std::floor(p_W[axis] / resolution_m));
    key = (key << axis_bits) | (static_cast<std::uint64_t>(cell + middle) & axis_mask);
  }
  return key;
}

Vec3 centre_of(std::uint64_t key, double resolution_m) {
  Vec3 centre_W;
  for (int axis = 2; axis >= 0; --axis, key >>= axis_bits) {
    const auto cell = static_cast<std::int64_t>(key & axis_mask) - middle;
    centre_W[axis] = (static_cast<double>(cell) + 0.5) * resolution_m;
  }
  return centre_W;
}

std::vector<Vec3> hits_of_image(const DepthImage& image, double reach_m, const Pose& X_WC) {
  std::vector<Vec3> hits_W;
  const Intrinsics& camera = image.camera;
  std::size_t at = 0;
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u, ++at) {
      const auto point = point_of_pixel((u + 0.5 - camera.centre_x_px) / camera.focal_px,
                                        (v + 0.5 - camera.centre_y_px) / camera.focal_px,
                                        static_cast<double>(image.depth_m[at]), reach_m);
      if (point && point->is_hit) {
        hits_W.emplace_back(X_WC * point->p_C.cast<double>());
      }
    }
  }
  return hits_W;
}

}  // namespace

std::vector<CellChange> MapChanges::since_last(const MapRevision& revision,
                                               const std::vector<Vec3>& hits_W) {
  if (revision.resolution_m != resolution_m_) {
    resolution_m_ = revision.resolution_m;
    told_.clear();
    list_.clear();
    oldest_ = next_look_ = 0;
  }
  std::vector<CellChange> changes;
  look_back(revision, changes);
  look_at_hits(revision, hits_W, changes);
  return changes;
}

void MapChanges::look_at_hits(const MapRevision& revision,
                              const std::vector<Vec3>& hits_W,
                              std::vector<CellChange>& changes) {
  std::vector<Key> keys;
  for (const Vec3& hit_W : hits_W) {
    const Key key = key_of(hit_W, resolution_m_);
    if ((keys.empty() || keys.back() != key) && told_.count(key) == 0) {  // Neighbours often share.
      keys.push_back(key);
    }
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  for (const Key key : keys) {
    const Vec3 centre_W = centre_of(key, resolution_m_);
    if (revision.map->state(centre_W) == CellState::occupied) {
      remember(key);
      changes.push_back({centre_W, true});
    }
  }
}

void MapChanges::look_back(const MapRevision& revision, std::vector<CellChange>& changes) {
  for (std::size_t n = std::min(looks_back, list_.size()); n > 0; --n) {
    next_look_ = next_look_ < list_.size() ? next_look_ : 0;
    const Key key = list_[next_look_++];
    const Vec3 centre_W = centre_of(key, resolution_m_);
    if (told_.count(key) > 0 && revision.map->state(centre_W) != CellState::occupied) {
      told_.erase(key);
      changes.push_back({centre_W, false});
    }
  }
}

void MapChanges::remember(Key key) {
  told_.insert(key);
  if (list_.size() < most_cells) {
    list_.push_back(key);
    return;
  }
  told_.erase(list_[oldest_]);
  told_.insert(key);  // It may have been the oldest one itself.
  list_[oldest_] = key;
  oldest_ = (oldest_ + 1) % most_cells;
}

std::vector<Vec3> hits_of(const PointCloudFrame& frame, const Pose& X_WC) {
  if (frame.pixels) {
    return hits_of_image(frame.pixels->image.value(), frame.pixels->reach_m, X_WC);
  }
  std::vector<Vec3> hits_W;
  for (const Eigen::Vector3f& hit_C : frame.cloud_C.value().hits_C) {
    hits_W.emplace_back(X_WC * hit_C.cast<double>());
  }
  return hits_W;
}

}  // namespace flyball
