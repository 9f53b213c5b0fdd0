// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Stock OctoMap's map of several resolutions: each has cells of its own, which every ray that
/// crosses them frees, and `LayeredView` makes one map of them. Trees or bricks keep the cells: a
/// `Store`. The work is counted as stock does it. What questions find is stock's map with the walls
/// that it would lose (`KeptWalls`).
///
/// A store has
///   Store(cell_m), cells()             what LayeredView looks at; empty at first
///   revision()                         the cells as they are now, which stay so: a shared pointer
///   write(masks)                       of one scan
///   show(brick)                        sets what questions find in a brick, until it is written
///   is_occupied(cell)                  by its log-odds, whatever is shown
///   is_confirmed(cell), confirm(cell)  whether a cell is occupied beyond doubt; makes it so
///   counts(), bytes()                  as in MapContents
///   write_file(path), read_file(path)  as Mapper's; the latter is static and gives a store

#include "flyball/kernels/mapper.h"
#include "flyball/runtime/text/number_text.h"

#include "bricks/bits.h"
#include "maps/kept_walls.h"
#include "maps/layered_view.h"
#include "maps/octomap_tree.h"
#include "maps/shown_cells.h"
#include "scans/clear_cells.h"
#include "scans/exact_scan.h"
#include "scans/ray_scan.h"
#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

namespace flyball {

/// p = .9: three hits. Log-odds of a wall that stays, also where rays pass beside it.
inline constexpr float confirmed_log_odds = 2.2F;

template <class Store>
class LayeredMapper final : public Mapper {
 public:
  [[nodiscard]] double longest_range_m(double resolution_m) const override {
    return RayScan::most_cells_per_ray * resolution_m;
  }

  Result<Work> prepare(const PointCloud& cloud_C,
                       const Pose& X_WC,
                       const MapperSettings& settings) override {
    if (auto status = check_points(cloud_C, X_WC); !status) {
      pending_ = nullptr;
      return status.error();
    }
    return integrate(X_WC, settings, [&](ExactScan& exact) -> const ScanMasks& {
      return exact.walk(cloud_C, X_WC, settings.range_m);
    });
  }
  Result<Work> prepare_frame(const PointCloudFrame& frame,
                             const Pose& X_WC,
                             const MapperSettings& settings) override {
    if (!frame.pixels) {
      return prepare(frame.cloud_C.value(), X_WC, settings);
    }
    if (auto status = check_image(frame); !status) {
      pending_ = nullptr;
      return status.error();
    }
    const WholeView view{*frame.pixels, X_WC, settings.range_m};
    return integrate(
        X_WC, settings,
        [&](ExactScan& exact) -> const ScanMasks& {
          return exact.compute(frame, X_WC, settings.range_m);
        },
        &view);
  }

  void commit() override {
    if (pending_ != nullptr) {
      pending_->store.write(masks_->bricks);
      pending_->kept.restore(pending_->store);
      if (pending_->is_coarse()) {
        pending_->clear.add(masks_->bricks);
        for (const auto& [centre_W, space] : view_.declared().all()) {
          pending_->clear.declare(centre_W, space);
        }
      }
      if (pending_->is_wide()) {
        pending_->confirm(masks_->bricks);
      }
      pending_->show_in(view_);
      note_use_of(*pending_);
      pending_ = nullptr;
    }
  }

  void declare_clear(const Vec3& centre_W, const Cylinder& space) override {
    view_.declare_clear(centre_W, space);
  }

  [[nodiscard]] const OccupancyView& view() const override { return view_; }

  [[nodiscard]] std::shared_ptr<const OccupancyView> revision() override {
    const auto revision = std::make_shared<Revision>();
    for (auto shown = view_.layers().rbegin(); shown != view_.layers().rend(); ++shown) {
      for (const auto& layer : layers_) {
        layer->add_to(*revision, *shown);
      }
    }
    revision->view.declare_clear(view_.declared());
    return {revision, &revision->view};
  }

  [[nodiscard]] std::vector<OccupiedCell> occupied() const override { return shown_cells(view_); }

  [[nodiscard]] MapContents contents() const override {
    MapContents contents;
    for (const Layer* layer : by_resolution()) {
      contents.levels.push_back(layer->store.counts());
      contents.bytes += layer->store.bytes() + layer->clear.bytes() + layer->walls.bytes();
    }
    return contents;
  }

  [[nodiscard]] Status write(const std::string& path,
                             std::optional<double> resolution_m) const override {
    try {
      for (const Layer* layer : by_resolution()) {
        if (!resolution_m || std::abs(layer->cell_m - *resolution_m) < 1e-9) {
          return layer->store.write_file(path);
        }
      }
      return Error{
          ErrorCode::invalid_input,
          "map file \"" + path + "\": nothing has been mapped" +
              (resolution_m ? " at " + short_number_text(*resolution_m) + " m" : std::string{})};
    } catch (const std::exception& e) {
      return failure(e);
    }
  }

  [[nodiscard]] Status read(const std::string& path) override {
    auto store = Store::read_file(path);
    if (!store) {
      return store.error();
    }
    auto layer = std::make_unique<Layer>(std::move(*store));
    if (layer->is_coarse()) {
      layer->clear.add(layer->store.cells());
    }
    view_.forget_layers();
    layers_.clear();
    pending_ = nullptr;
    layers_.emplace_back(std::move(layer))->show_in(view_);
    return Done{};
  }

 private:
  // A finer map trusts only those free cells of this size and wider that surely hold no wall.
  static constexpr double coarse_cell_m = 0.3;
  // Chosen: four times as many as one lattice has. A policy that asks for another
  // resolution with each frame would otherwise fill the memory, and each question asks every layer.
  static constexpr std::size_t most_layers = 16;
  // In a cell wider than this the body can fly beside the wall that the cell contains, and rays
  // that pass there without touching it would free the cell: stock OctoMap forgets the wall.
  static constexpr double wide_cell_m = 0.3;

  /// Cells that stay as they are, and the view of them.
  struct Revision {
    std::vector<std::shared_ptr<const BrickCells>> cells{};  ///< Owners: see BrickMap::revision.
    LayeredView view{};
  };

  /// The cells of one resolution as stock insertion makes them. Questions find the walls that it
  /// would lose: in wide cells those that were once occupied beyond doubt, for obstacles are
  /// static, and the view asks them first; in others what no scan has seen through. For coarse
  /// cells also which of them surely hold no wall at all.
  struct Layer {
    explicit Layer(Store of_cells)
        : cell_m{of_cells.cell_m()},
          exact{cell_m},
          store{std::move(of_cells)},
          clear{cell_m},
          walls{cell_m} {}
    [[nodiscard]] bool is_coarse() const { return cell_m >= coarse_cell_m; }
    [[nodiscard]] bool is_wide() const { return cell_m > wide_cell_m; }

    void show_in(LayeredView& view) const {
      view.activate({&store.cells(), is_coarse() ? &clear.cells() : nullptr});
      if (is_wide()) {
        view.activate(walls.cells());
      }
    }

    /// If it is this layer, or its walls, that the view shows.
    void add_to(Revision& revision, const LayeredView::Layer& shown) {
      if (shown.cells != &store.cells() && shown.cells != &walls.cells()) {
        return;
      }
      Store& from = shown.cells == &store.cells() ? store : walls;
      const BrickCells* trusted = nullptr;
      if (shown.trusted_by_finer != nullptr) {
        trusted = revision.cells.emplace_back(clear.revision()).get();
      }
      revision.view.activate({revision.cells.emplace_back(from.revision()).get(), trusted});
    }

    void confirm(const std::vector<BrickMasks>& changes) {
      for (const BrickMasks& change : changes) {
        for (std::uint64_t left = change.hit; left != 0; left &= left - 1) {
          const CellKey cell = cell_of(change.brick, static_cast<unsigned>(lowest_bit(left)));
          if (store.is_confirmed(cell) && !walls.is_confirmed(cell)) {
            walls.confirm(cell);
          }
        }
      }
    }

    double cell_m;
    ExactScan exact;
    Store store;
    ClearCells clear;
    KeptWalls kept{};
    Store walls;
  };

  /// @param masks_of  What a front-end makes of the scan.
  /// @param view      Of its image, if it has one.
  template <class MasksOf>
  Result<Work> integrate(const Pose& X_WC,
                         const MapperSettings& settings,
                         MasksOf&& masks_of,
                         const WholeView* view = nullptr) {
    pending_ = nullptr;
    constexpr double half_keys = 32768.0;  // OctoMap's keys have 16 bits
    const double edge_m = (half_keys - 4.0) * settings.resolution_m - settings.range_m;
    if (auto status = check_view(X_WC, settings, settings.resolution_m, edge_m); !status) {
      return status.error();
    }
    try {
      Layer& layer = layer_of(settings.resolution_m);
      masks_ = &masks_of(layer.exact);
      pending_ = &layer;
      if (!layer.is_wide()) {
        layer.kept.look(masks_->bricks, layer.store.cells(), view);
      }
      Work work;
      work.add("frame", 1.0);
      work.add("rays", masks_->rays);
      work.add("traversals", masks_->traversals);
      work.add("updates", masks_->updates);
      return work;
    } catch (const std::exception& e) {
      return failure(e);
    }
  }

  static Error failure(const std::exception& e) {
    return {ErrorCode::failed, std::string{"octomap: "} + e.what()};
  }

  /// Finest first.
  [[nodiscard]] std::vector<const Layer*> by_resolution() const {
    std::vector<const Layer*> layers;
    for (const auto& layer : layers_) {
      layers.push_back(layer.get());
    }
    std::sort(layers.begin(), layers.end(),
              [](const Layer* a, const Layer* b) { return a->cell_m < b->cell_m; });
    return layers;
  }

  Layer& layer_of(double resolution_m) {
    for (const auto& layer : layers_) {
      if (std::abs(layer->cell_m - resolution_m) < 1e-9) {
        return *layer;
      }
    }
    return *layers_.emplace_back(std::make_unique<Layer>(Store{resolution_m}));
  }

  /// Forgets those that were used longest ago where there are too many. They answered, also by
  /// their walls, only where no later one knows anything, so what they knew becomes unknown, and
  /// never free.
  void note_use_of(const Layer& used) {
    const auto here = std::find_if(layers_.begin(), layers_.end(),
                                   [&](const auto& layer) { return layer.get() == &used; });
    std::rotate(here, here + 1, layers_.end());
    while (layers_.size() > most_layers) {
      view_.forget(layers_.front()->store.cells());
      view_.forget(layers_.front()->walls.cells());
      layers_.erase(layers_.begin());
    }
  }

  std::vector<std::unique_ptr<Layer>> layers_{};  ///< That used last comes last.
  LayeredView view_{};
  const ScanMasks* masks_{};  ///< Of the pending layer.
  Layer* pending_{};
};

}  // namespace flyball
