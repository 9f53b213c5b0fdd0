// SPDX-License-Identifier: BSD-3-Clause
// tested-in: flyball
#include "lattice_mapper.h"

#include "flyball/runtime/text/number_text.h"

#include "brick_contents.h"
#include "brick_view.h"
#include "chunk_log.h"
#include "map_file.h"
#include "maps/shown_cells.h"
#include "scans/exact_scan.h"
#include "scans/pyramid_scan.h"
#include "scans/ray_scan.h"
#include "scans/scan.h"
#include "scans/work_limit.h"
#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>

namespace flyball {
namespace {

constexpr int coarsest_level = 3;

Error invalid(std::string message) {
  return {ErrorCode::invalid_input, std::move(message)};
}

enum class FrontEnd : std::uint8_t { exact, rays, pyramid };

class LatticeMapper final : public Mapper {
 public:
  [[nodiscard]] std::vector<ParameterSpec> parameters() const override {
    return {
        {"finest_m", 0.15, 0.01, 10.0,
         "finest cells; the map's resolution is this times 1, 2, 4, 8"},
        {"front_end",
         "pyramid",
         0.0,
         0.0,
         "at the finest level: exact (stock OctoMap's cells), rays, or pyramid (coarse to fine)",
         {"exact", "pyramid", "rays"}},
        {"cost_of",
         "flyball",
         0.0,
         0.0,
         "whose work is reported: its own, or what stock OctoMap would do at this resolution",
         {"flyball", "octomap"}},
        {"most_traversals", 0.0, 0.0, 1e12,
         "cells a scan's rays may cross, near first; 0: no limit"},
        {"keep_radius_m", 0.0, 0.0, 1e5,
         "what lies farther from the vehicle is forgotten, but for the file of the whole map; 0: "
         "nothing is"},
    };
  }

  Status configure(const Parameters& chosen, const FindModel& /*find_model*/) override {
    const std::string& front_end = chosen.text("front_end");
    front_end_ = front_end == "exact"  ? FrontEnd::exact
                 : front_end == "rays" ? FrontEnd::rays
                                       : FrontEnd::pyramid;
    reports_stock_work_ = chosen.text("cost_of") == "octomap";
    most_traversals_ = chosen.number("most_traversals");
    keep_radius_m_ = chosen.number("keep_radius_m");
    begin(chosen.number("finest_m"));
    return Done{};
  }

  [[nodiscard]] std::vector<double> resolutions_m() const override {
    std::vector<double> cells_m;
    for (int level = 0; level <= coarsest_level; ++level) {
      cells_m.push_back(map_.lattice().cell_m(level));
    }
    return cells_m;
  }

  [[nodiscard]] double longest_range_m(double resolution_m) const override {
    return RayScan::most_cells_per_ray * lattice_for(resolution_m).cell_m(0);
  }

  Result<Work> prepare(const PointCloud& cloud_C,
                       const Pose& X_WC,
                       const MapperSettings& settings) override {
    return prepare_scan(cloud_C, nullptr, X_WC, settings);
  }
  Result<Work> prepare_frame(const PointCloudFrame& frame,
                             const Pose& X_WC,
                             const MapperSettings& settings) override {
    if (auto status = check_image(frame); !status) {
      pending_ = nullptr;
      return status.error();
    }
    return prepare_scan(frame.cloud_C.value(), frame.pixels ? &frame : nullptr, X_WC, settings);
  }

  void commit() override {
    if (pending_ == nullptr) {
      return;
    }
    map_.apply(pending_->bricks);
    if (keep_radius_m_ > 0.0) {
      map_.drop_beyond(camera_W_, std::max(keep_radius_m_, range_m_), [this](const Chunk& chunk) {
        if (forgotten_) {
          forgotten_->append(chunk);
        }
      });
    }
    view_.activate(pending_level_);
    pending_ = nullptr;
  }

  void declare_clear(const Vec3& centre_W, const Cylinder& space) override {
    view_.declare_clear(centre_W, space);
  }

  void doubt_obstacles(const Vec3& p_W, double radius_m) override {
    map_.forget_occupied(p_W, radius_m);
    if (forgotten_) {
      forgotten_->forget_occupied(p_W, radius_m);
    }
  }

  [[nodiscard]] const OccupancyView& view() const override { return view_; }

  [[nodiscard]] std::shared_ptr<const OccupancyView> revision() override {
    return view_.of_revision(map_.revision());
  }

  [[nodiscard]] std::vector<OccupiedCell> occupied() const override { return shown_cells(view_); }

  [[nodiscard]] MapContents contents() const override { return contents_of(map_, coarsest_level); }

  [[nodiscard]] Status write(const std::string& path,
                             std::optional<double> resolution_m) const override {
    if (!forgotten_ || forgotten_->is_empty()) {
      return write_map_file(map_, resolution_m, path);
    }
    BrickMap whole{map_.lattice().cell_m(0)};
    if (auto status = forgotten_->add_to(whole); !status) {
      return status;
    }
    for (const Chunk* chunk : map_.cells().chunks()) {
      add_chunk(*chunk, whole);
    }
    return write_map_file(whole, resolution_m, path);
  }

  [[nodiscard]] Status keep_forgotten(const std::string& path) override {
    if (!(keep_radius_m_ > 0.0)) {
      return Done{};
    }
    forgotten_ = std::make_unique<ChunkLog>(path);
    return forgotten_->status();
  }

  [[nodiscard]] Status read(const std::string& path) override {
    auto map = read_map_file(path);
    if (!map) {
      return map.error();
    }
    begin(map->lattice().cell_m(0));
    map_ = std::move(*map);
    view_.activate(0);
    return Done{};
  }

 private:
  static constexpr double default_finest_m = 0.15;

  void begin(double finest_m) {
    map_ = BrickMap{finest_m};
    pending_ = nullptr;
    exact_.clear();
    for (int level = 0; level <= coarsest_level; ++level) {
      exact_.push_back(std::make_unique<ExactScan>(map_.lattice().cell_m(level)));
    }
    close_ = std::make_unique<RayScan>(finest_m, RayScan::Match::close);
    pyramid_ = std::make_unique<PyramidScan>(finest_m);
    pyramid_->refine_near_camera();
  }

  /// @param frame  With the image of the cloud, if there is one.
  Result<Work> prepare_scan(const PointCloud& cloud_C,
                            const PointCloudFrame* frame,
                            const Pose& X_WC,
                            const MapperSettings& settings) {
    pending_ = nullptr;
    if (auto status = check(cloud_C, X_WC, settings); !status) {
      return status.error();
    }
    const auto level = level_of(settings.resolution_m);
    if (!level) {
      return level.error();
    }
    const auto exact = [&](int at_level, double range_m) {
      ExactScan& scan = *exact_[static_cast<std::size_t>(at_level)];
      return frame != nullptr ? &scan.compute(*frame, X_WC, range_m)
                              : &scan.walk(cloud_C, X_WC, range_m);
    };
    try {
      return integrate(cloud_C, X_WC, settings, *level, exact);
    } catch (const std::exception& e) {
      return Error{ErrorCode::failed, std::string{"flyball map: "} + e.what()};
    }
  }

  [[nodiscard]] std::optional<int> level_with(double resolution_m) const {
    for (int level = 0; level <= coarsest_level; ++level) {
      if (std::abs(map_.lattice().cell_m(level) - resolution_m) < 1e-9) {
        return level;
      }
    }
    return std::nullopt;
  }

  /// A map that is still empty takes a resolution off its lattice as its finest.
  [[nodiscard]] bool begins_anew_with(double resolution_m) const {
    return map_.cells().chunks().empty() && !level_with(resolution_m);
  }

  [[nodiscard]] Lattice lattice_for(double resolution_m) const {
    return begins_anew_with(resolution_m) ? Lattice{resolution_m} : map_.lattice();
  }

  Result<int> level_of(double resolution_m) {
    if (begins_anew_with(resolution_m)) {
      begin(resolution_m);
    }
    if (const auto level = level_with(resolution_m)) {
      return *level;
    }
    return invalid("map.resolution_m " + short_number_text(resolution_m) +
                   " must be 1, 2, 4 or 8 times " + short_number_text(map_.lattice().cell_m(0)));
  }

  [[nodiscard]] Status check(const PointCloud& cloud_C,
                             const Pose& X_WC,
                             const MapperSettings& settings) const {
    const Lattice lattice = lattice_for(settings.resolution_m);
    const double finest_m = lattice.cell_m(0);
    // A pyramid looks at the whole box around its view, up to the next chunk.
    const double edge_m = lattice.edge_m() - settings.range_m - 64.0 * finest_m;
    if (auto status = check_points(cloud_C, X_WC); !status) {
      return status;
    }
    return check_view(X_WC, settings, finest_m, edge_m);
  }

  /// @param exact  Stock's masks at a level and a range.
  template <class Exact>
  Work integrate(const PointCloud& cloud_C,
                 const Pose& X_WC,
                 const MapperSettings& settings,
                 int level,
                 Exact&& exact) {
    camera_W_ = X_WC.translation();
    range_m_ = settings.range_m;
    const bool looks = cloud_C.camera && (level > 0 || front_end_ == FrontEnd::pyramid);
    const ScanMasks* stock = nullptr;
    if (reports_stock_work_) {
      stock = exact(level, range_m_);
    }
    Work work = work_of(stock);
    const bool is_limited = most_traversals_ > 0.0;
    const bool is_exact = front_end_ == FrontEnd::exact;
    if (is_limited || !(looks || is_exact)) {
      to_world(cloud_C, X_WC, scan_);
      scan_.range_m = range_m_;
    }
    if (is_limited) {
      range_m_ = range_within(scan_, map_.lattice().cell_m(0), most_traversals_);
      scan_.range_m = range_m_;
    }
    const bool is_done = stock != nullptr && !looks && level == 0 && is_exact && !is_limited;
    pending_ = is_done    ? stock
               : looks    ? &pyramid_->compute(cloud_C, X_WC, range_m_, level)
               : is_exact ? exact(0, range_m_)
                          : &close_->compute(scan_);
    pending_level_ = level;
    return reports_stock_work_ ? work : work_of(pending_);
  }

  static Work work_of(const ScanMasks* masks) {
    Work work;
    if (masks != nullptr) {
      work.add("frame", 1.0);
      work.add("rays", masks->rays);
      work.add("traversals", masks->traversals);
      work.add("updates", masks->updates);
      if (masks->blocks > 0.0) {
        work.add("blocks", masks->blocks);
      }
    }
    return work;
  }

  FrontEnd front_end_{FrontEnd::pyramid};
  bool reports_stock_work_{};
  double most_traversals_{};
  double keep_radius_m_{};

  BrickMap map_{default_finest_m};
  BrickView view_{map_.cells()};
  std::unique_ptr<ChunkLog>
      forgotten_{};  ///< Null where nothing is forgotten, or it is not asked for.
  std::vector<std::unique_ptr<ExactScan>> exact_{};  ///< One for each level, which sets its counts.
  std::unique_ptr<RayScan> close_{};
  std::unique_ptr<PyramidScan> pyramid_{};
  Scan scan_{};
  double range_m_{};  ///< Of the pending scan.
  const ScanMasks* pending_{};
  int pending_level_{};
  Vec3 camera_W_{Vec3::Zero()};  ///< Of the pending scan.

 public:
  LatticeMapper() { begin(default_finest_m); }
};

}  // namespace

std::unique_ptr<Mapper> make_lattice_mapper() {
  return std::make_unique<LatticeMapper>();
}

}  // namespace flyball
