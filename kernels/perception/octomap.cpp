// flyball-package: octomap
// flyball-link: octomap octomath
// SPDX-License-Identifier: BSD-3-Clause
//
// OctoMap's log-odds octree: Hornung et al. 2013, doi:10.1007/s10514-012-9321-0. The trees are
// those that stock insertion makes, byte for byte, and so is the work that is counted; the host is
// spared: bricks/ray_scan.h walks the rays, bricks/octree_record.h writes the cells. One tree per
// resolution that was used.

#include "flyball/kernels/mapper.h"
#include "flyball/runtime/registry.h"

#include "bricks/clear_cells.h"
#include "bricks/octree_record.h"
#include "bricks/ray_scan.h"
#include "octomap_view.h"
#include "octree_file.h"
#include <algorithm>
#include <cmath>
#include <exception>

namespace {

using flyball::Error;
using flyball::ErrorCode;

constexpr double half_keys = 32768.0;  // OctoMap's keys have 16 bits

Error invalid(std::string message) {
  return {ErrorCode::invalid_input, std::move(message)};
}

bool is_finite(const std::vector<Eigen::Vector3f>& points) {
  for (const Eigen::Vector3f& p : points) {
    if (!p.allFinite()) {
      return false;
    }
  }
  return true;
}

flyball::Status check(const flyball::PointCloud& cloud_C,
                      const flyball::Pose& X_WC,
                      const flyball::MapperSettings& settings) {
  const auto is_positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  if (!is_positive(settings.resolution_m) || !is_positive(settings.range_m)) {
    return invalid("map.resolution_m " + std::to_string(settings.resolution_m) +
                   " and map.range_m " + std::to_string(settings.range_m) + " must be positive");
  }
  if (settings.range_m > flyball::RayScan::most_cells_per_ray * settings.resolution_m) {
    return invalid("map.range_m " + std::to_string(settings.range_m) + " is over 250 cells of " +
                   std::to_string(settings.resolution_m) + " m; shorten it or coarsen the map");
  }
  if (!X_WC.matrix().allFinite() || !is_finite(cloud_C.hits_C) || !is_finite(cloud_C.clear_C)) {
    return invalid("scan " + std::to_string(cloud_C.sequence) +
                   " has a coordinate that is not finite");
  }
  const double edge_m = (half_keys - 4.0) * settings.resolution_m - settings.range_m;
  if (X_WC.translation().cwiseAbs().maxCoeff() >= edge_m) {
    return invalid("camera is over " + std::to_string(edge_m) + " m from the map's centre");
  }
  return flyball::Done{};
}

octomap::point3d to_octomap(const flyball::Vec3& p) {
  const Eigen::Vector3f single = p.cast<float>();
  return {single.x(), single.y(), single.z()};
}

// A finer map trusts only those free cells of this size and wider that surely hold no wall.
constexpr double coarse_cell_m = 0.3;
// In a cell wider than this the body can fly beside the wall that the cell contains, and rays that
// pass there without touching it would free the cell: stock OctoMap forgets the wall.
constexpr double wide_cell_m = 0.3;
constexpr float confirmed_log_odds = 2.2F;  // p = .9: three hits

/// The tree of one resolution as stock insertion makes it, and for wide cells the walls in it:
/// those cells that were once occupied beyond doubt. The view asks the walls first; obstacles are
/// static. For coarse cells also which of them surely hold no wall at all.
struct Layer {
  explicit Layer(double resolution_m)
      : rays{resolution_m, flyball::RayScan::Match::stock},
        tree{resolution_m},
        clear{resolution_m},
        walls{resolution_m} {
    tree.setClampingThresMin(0.12);  // both as in MAVBench's code
    tree.setClampingThresMax(0.97);
  }
  [[nodiscard]] bool is_coarse() const { return tree.getResolution() >= coarse_cell_m; }
  [[nodiscard]] bool is_wide() const { return tree.getResolution() > wide_cell_m; }

  void show_in(flyball::OctomapView& view) const {
    view.activate({&tree, is_coarse() ? &clear.cells() : nullptr});
    if (is_wide()) {
      view.activate(walls);
    }
  }

  void confirm(const std::vector<octomap::point3d>& hits_W) {
    octomap::OcTreeKey last;
    bool has_last = false;
    for (const octomap::point3d& hit_W : hits_W) {
      octomap::OcTreeKey key;
      // Neighbouring pixels mostly hit the same cell.
      if (!tree.coordToKeyChecked(hit_W, key) || (has_last && key == last)) {
        continue;
      }
      last = key;
      has_last = true;
      const octomap::OcTreeNode* node = tree.search(key);
      if (node != nullptr && node->getLogOdds() >= confirmed_log_odds &&
          walls.search(key) == nullptr) {
        walls.setNodeValue(key, confirmed_log_odds);
      }
    }
  }

  flyball::RayScan rays;
  octomap::OcTree tree;
  flyball::ClearCells clear;
  octomap::OcTree walls;
};

flyball::MapLevel counts_of(const octomap::OcTree& tree) {
  flyball::MapLevel counts{tree.getResolution()};
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const std::uint64_t cells = std::uint64_t{1} << 3 * (tree.getTreeDepth() - leaf.getDepth());
    counts.known_cells += cells;
    counts.occupied_cells += tree.isNodeOccupied(*leaf) ? cells : 0;
  }
  return counts;
}

class OctomapMapper final : public flyball::Mapper {
 public:
  flyball::Result<flyball::Work> prepare(const flyball::PointCloud& cloud_C,
                                         const flyball::Pose& X_WC,
                                         const flyball::MapperSettings& settings) override {
    pending_ = nullptr;
    if (auto status = check(cloud_C, X_WC, settings); !status) {
      return status.error();
    }
    try {
      Layer& layer = layer_of(settings.resolution_m);
      take(cloud_C, X_WC, settings.range_m);
      masks_ = &layer.rays.compute(scan_);
      pending_ = &layer;
      flyball::Work work;
      work.add("frame", 1.0);
      work.add("rays", masks_->rays);
      work.add("traversals", masks_->traversals);
      work.add("updates", masks_->updates);
      return work;
    } catch (const std::exception& e) {
      return Error{ErrorCode::failed, std::string{"octomap: "} + e.what()};
    }
  }

  void commit() override {
    if (pending_ != nullptr) {
      record_.write(masks_->bricks, pending_->tree);
      if (pending_->is_coarse()) {
        pending_->clear.add(masks_->bricks);
        for (const auto& [centre_W, space] : view_.declared()) {
          pending_->clear.declare(centre_W, space);
        }
      }
      if (pending_->is_wide()) {
        pending_->confirm(scan_.hits_W);
      }
      pending_->show_in(view_);
      pending_ = nullptr;
    }
  }

  void declare_clear(const flyball::Vec3& centre_W, const flyball::Cylinder& space) override {
    view_.declare_clear(centre_W, space);
  }

  [[nodiscard]] const flyball::OccupancyView& view() const override { return view_; }

  [[nodiscard]] std::vector<flyball::OccupiedCell> occupied() const override {
    std::vector<flyball::OccupiedCell> cells;
    view_.for_each_occupied([&](const flyball::Aabb& cube) {
      cells.push_back({0.5 * (cube.min + cube.max), cube.max.x() - cube.min.x()});
    });
    return cells;
  }

  [[nodiscard]] flyball::MapContents contents() const override {
    flyball::MapContents contents;
    for (const Layer* layer : by_resolution()) {
      contents.levels.push_back(counts_of(layer->tree));
      contents.bytes +=
          layer->tree.memoryUsage() + layer->clear.bytes() + layer->walls.memoryUsage();
    }
    return contents;
  }

  [[nodiscard]] flyball::Status write(const std::string& path,
                                      std::optional<double> resolution_m) const override {
    try {
      for (const Layer* layer : by_resolution()) {
        if (!resolution_m || std::abs(layer->tree.getResolution() - *resolution_m) < 1e-9) {
          octomap::OcTree copy{layer->tree};  // Writing .bt rounds a tree.
          return flyball::write_octree(copy, path);
        }
      }
      return invalid("nothing has been mapped" +
                     (resolution_m ? " at " + std::to_string(*resolution_m) + " m" : ""));
    } catch (const std::exception& e) {
      return Error{ErrorCode::failed, std::string{"octomap: "} + e.what()};
    }
  }

  [[nodiscard]] flyball::Status read(const std::string& path) override {
    auto tree = flyball::read_octree(path);
    if (!tree) {
      return tree.error();
    }
    view_.forget_trees();
    layers_.clear();
    pending_ = nullptr;
    Layer& layer = layer_of((*tree)->getResolution());
    layer.tree.swapContent(**tree);
    if (layer.is_coarse()) {
      layer.clear.add(layer.tree);
    }
    layer.show_in(view_);
    return flyball::Done{};
  }

 private:
  /// Finest first.
  [[nodiscard]] std::vector<const Layer*> by_resolution() const {
    std::vector<const Layer*> layers;
    for (const auto& layer : layers_) {
      layers.push_back(layer.get());
    }
    std::sort(layers.begin(), layers.end(), [](const Layer* a, const Layer* b) {
      return a->tree.getResolution() < b->tree.getResolution();
    });
    return layers;
  }

  Layer& layer_of(double resolution_m) {
    for (const auto& layer : layers_) {
      if (std::abs(layer->tree.getResolution() - resolution_m) < 1e-9) {
        return *layer;
      }
    }
    return *layers_.emplace_back(std::make_unique<Layer>(resolution_m));
  }

  void take(const flyball::PointCloud& cloud_C, const flyball::Pose& X_WC, double range_m) {
    const auto to_world = [&](const auto& points_C, auto& points_W) {
      points_W.clear();
      for (const Eigen::Vector3f& p_C : points_C) {
        points_W.push_back(to_octomap(X_WC * p_C.template cast<double>()));
      }
    };
    to_world(cloud_C.hits_C, scan_.hits_W);
    to_world(cloud_C.clear_C, scan_.clear_W);
    scan_.origin_W = to_octomap(X_WC.translation());
    scan_.range_m = range_m;
  }

  std::vector<std::unique_ptr<Layer>> layers_{};
  flyball::OctomapView view_{};
  flyball::Scan scan_{};
  flyball::OctreeRecord record_{};
  const flyball::ScanMasks* masks_{};  ///< Of the pending layer.
  Layer* pending_{};
};

}  // namespace

FLYBALL_PLUGIN(octomap) {
  registry.add<flyball::Mapper>("octomap", [] { return std::make_unique<OctomapMapper>(); });
}
