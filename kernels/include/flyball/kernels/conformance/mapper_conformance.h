// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The contract of mapper.h as checks: maps of a room are held against a march along every ray, and
/// what a view answers about bodies and boxes against its own cells, one by one.

#include "flyball/kernels/conformance/dense_map.h"
#include "flyball/kernels/conformance/kernel_conformance.h"
#include "flyball/kernels/conformance/painted_scan.h"
#include "flyball/kernels/mapper.h"
#include "flyball/runtime/random.h"

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace flyball {

class MapperConformance : public KernelConformance<Mapper> {
 public:
  using KernelConformance::KernelConformance;

  [[nodiscard]] std::vector<std::string> breaches() {
    return checked({"map.resolution_m", "map.range_m", "map.rate_hz"}, [this] {
      const auto resolutions_m = made()->resolutions_m();
      cell_m_ = resolutions_m.empty() ? 0.15 : resolutions_m.front();
      check_cells();
      check_queries();
      check_commit();
      check_revision();
      check_declared();
      check_doubted();
      check_resolutions(resolutions_m);
      check_refusals();
      check_work();
      check_missions();
    });
  }

 private:
  static constexpr double range_m = 4.0;
  static constexpr int frames = 4;
  using States = std::vector<CellState>;

  [[nodiscard]] MapperSettings settings() const { return {cell_m_, range_m}; }
  static Aabb region() { return {{-3.6, -2.6, -0.5}, {5.1, 2.6, 3.2}}; }

  Work insert(Mapper& mapper, int frame, double yaw_rad, const MapperSettings& settings) {
    const RoomScan scan = room_scan(frame, yaw_rad);
    // Half of what is beyond the range comes as hits that are too far, as a lidar has them.
    const PointCloud cloud = cloud_of(scan.image, 1.2 * range_m);
    const auto work = mapper.prepare(cloud, scan.X_WC, settings);
    require(work.ok(), work ? "" : "refuses an ordinary scan: " + work.error().message);
    mapper.commit();
    return work ? *work : Work{};
  }
  std::unique_ptr<Mapper> mapped() {
    auto mapper = made();
    for (int frame = 0; frame < frames; ++frame) {
      insert(*mapper, frame, 0.0, settings());
    }
    return mapper;
  }

  [[nodiscard]] States states_of(const OccupancyView& view) const {
    States states;
    CellEvidence{region(), cell_m_}.for_each(
        [&](const Vec3& p_W, const CellEvidence::Verdict&) { states.push_back(view.state(p_W)); });
    return states;
  }

  void check_cells() {
    CellEvidence evidence{region(), cell_m_};
    for (int frame = 0; frame < frames; ++frame) {
      const RoomScan scan = room_scan(frame, 0.0);
      evidence.add(cloud_of(scan.image, 1.2 * range_m), scan.X_WC, range_m);
    }
    const auto mapper = mapped();
    const OccupancyView& view = mapper->view();
    require(std::abs(view.resolution_m() - cell_m_) < 1e-9,
            "does not answer at the resolution that it was told");
    evidence.for_each([&](const Vec3& p_W, const CellEvidence::Verdict& verdict) {
      const CellState state = view.state(p_W);
      require(!verdict.is_occupied || state == CellState::occupied,
              "does not mark what every frame has hit");
      require(!verdict.is_free || state == CellState::free,
              "does not free what every frame has seen through");
      require(!verdict.is_unseen || state == CellState::unknown,
              "claims to know what no ray came near");
      require(!verdict.has_no_wall || state != CellState::occupied,
              "marks an obstacle where nothing was hit");
    });
    const auto occupied = mapper->occupied();
    require(!occupied.empty(), "lists no occupied cells");
    for (const OccupiedCell& cell : occupied) {
      require(view.state(cell.centre_W) == CellState::occupied && cell.size_m > 0.0,
              "lists a cell as occupied that its view does not call so");
    }
  }

  /// Every question about bodies and boxes must have the answer of the cells themselves.
  void check_queries() {
    const auto mapper = mapped();
    const OccupancyView& view = mapper->view();
    DenseMap cells{region(), cell_m_, CellState::unknown};
    const double half_m = 0.4 * cell_m_;
    CellEvidence{region(), cell_m_}.for_each([&](const Vec3& p_W, const CellEvidence::Verdict&) {
      cells.fill({p_W - Vec3::Constant(half_m), p_W + Vec3::Constant(half_m)}, view.state(p_W));
    });
    RandomStream random{1, "mapper_conformance"};
    const auto place = [&random] {
      return Vec3{random.uniform(-1.5, 3.4), random.uniform(-1.6, 1.6), random.uniform(0.4, 2.3)};
    };
    for (int i = 0; i < 300; ++i) {
      const Vec3 from = place();
      const Vec3 to = place();
      compare(view, cells, from, i % 3 == 0 ? from : to,
              {random.uniform(0.05, 0.6), random.uniform(0.05, 0.4)});
    }
  }

  /// Within a micrometre: the borders of cells are rounded.
  void compare(const OccupancyView& view,
               const DenseMap& cells,
               const Vec3& from,
               const Vec3& to,
               const Cylinder& body) {
    constexpr double tiny_m = 1e-6;
    const Cylinder less{body.radius_m - tiny_m, body.half_height_m - tiny_m};
    const Cylinder more{body.radius_m + tiny_m, body.half_height_m + tiny_m};
    const bool hits = view.segment_hits(from, to, body);
    require(hits || !cells.segment_hits(from, to, less), "misses a cell that a segment hits");
    require(!hits || cells.segment_hits(from, to, more), "has a segment hit what is not there");
    const CellState state = view.body_state(from, body);
    require(state >= cells.body_state(from, less), "calls a body's room better than its cells are");
    require(state <= cells.body_state(from, more), "calls a body's room worse than its cells are");
    const Vec3 half{body.radius_m, body.radius_m, body.half_height_m};
    const Vec3 tiny = Vec3::Constant(tiny_m);
    const bool has = view.has_occupied({from - half, from + half});
    require(has || !cells.has_occupied({from - half + tiny, from + half - tiny}),
            "misses an occupied cell in a box");
    require(!has || cells.has_occupied({from - half - tiny, from + half + tiny}),
            "finds an occupied cell in a box that has none");
  }

  void check_commit() {
    const auto mapper = mapped();
    const States before = states_of(mapper->view());
    const RoomScan behind = room_scan(0, 3.0);
    const RoomScan aside = room_scan(0, 1.5);
    const auto prepare = [&](Mapper& by, const RoomScan& scan) {
      return by.prepare(cloud_of(scan.image, range_m), scan.X_WC, settings()).ok();
    };
    require(prepare(*mapper, behind), "refuses an ordinary scan");
    require(states_of(mapper->view()) == before, "changes its view before the scan is committed");
    require(prepare(*mapper, aside), "refuses an ordinary scan");
    mapper->commit();
    const States replaced = states_of(mapper->view());
    mapper->commit();
    require(states_of(mapper->view()) == replaced, "commits a scan twice");
    const auto direct = mapped();
    require(prepare(*direct, aside), "refuses an ordinary scan");
    direct->commit();
    require(states_of(direct->view()) == replaced, "commits a scan that another one has replaced");
    check_frame(*mapped(), *mapped());
  }

  /// A frame with its image must come to the same map as its points.
  void check_frame(Mapper& by_points, Mapper& by_frame) {
    const RoomScan scan = room_scan(2, 1.5);
    const PointCloud cloud = cloud_of(scan.image, range_m);
    PointCloudFrame frame{cloud.captured, cloud.sequence, Deferred<PointCloud>::of(cloud), {}};
    frame.pixels = RangeImage{Deferred<DepthImage>::of(scan.image), range_m};
    const auto points = by_points.prepare(cloud, scan.X_WC, settings());
    const auto pixels = by_frame.prepare_frame(frame, scan.X_WC, settings());
    by_points.commit();
    by_frame.commit();
    require(points.ok() && pixels.ok() && is_same(*points, *pixels) &&
                states_of(by_points.view()) == states_of(by_frame.view()),
            "makes another map of a frame than of its points");
  }

  void check_revision() {
    auto mapper = mapped();
    const States before = states_of(mapper->view());
    const auto revision = mapper->revision();
    if (revision == nullptr) {
      require(false, "hands on no revision");
      return;
    }
    require(states_of(*revision) == before, "hands on another map than its view shows");
    insert(*mapper, 1, 1.5, settings());
    require(states_of(mapper->view()) != before, "learns nothing from a scan of something new");
    require(states_of(*revision) == before, "changes a revision that it has handed on");
    mapper.reset();
    require(states_of(*revision) == before, "changes a revision when it ends");
  }

  void check_declared() {
    const auto mapper = mapped();
    const Cylinder space{0.5, 0.5};
    const Vec3 unseen_W{-2.0, 0.0, 1.4};
    require(mapper->view().body_state(unseen_W, {0.2, 0.2}) == CellState::unknown,
            "claims to know what no ray came near");
    mapper->declare_clear(unseen_W, space);
    require(mapper->view().body_state(unseen_W, {0.2, 0.2}) == CellState::free,
            "does not free unknown space that is declared clear");
    const std::vector<OccupiedCell> occupied = mapper->occupied();
    for (std::size_t i = 0; i < occupied.size(); i += 1 + occupied.size() / 8) {
      mapper->declare_clear(occupied[i].centre_W, space);
      require(mapper->view().state(occupied[i].centre_W) == CellState::occupied,
              "frees an obstacle that lies in space that is declared clear");
    }
  }

  /// An obstacle in doubt stays, or is unknown until it is seen again.
  void check_doubted() {
    const auto mapper = mapped();
    const States before = states_of(mapper->view());
    const auto revision = mapper->revision();
    mapper->doubt_obstacles(Vec3::Zero(), 20.0);
    require(revision == nullptr || states_of(*revision) == before,
            "changes a revision that it has handed on");
    const States doubted = states_of(mapper->view());
    for (std::size_t i = 0; i < before.size(); ++i) {
      const bool was_occupied = before[i] == CellState::occupied;
      require(was_occupied ? doubted[i] != CellState::free : doubted[i] == before[i],
              "frees an obstacle that is in doubt, or forgets more than obstacles");
    }
    for (int frame = 0; frame < frames; ++frame) {
      insert(*mapper, frame, 0.0, settings());
    }
    require(states_of(mapper->view()) == before, "does not learn again what was in doubt");
  }

  /// What was mapped at one resolution stays when another one is in force.
  void check_resolutions(const std::vector<double>& resolutions_m) {
    if (resolutions_m.size() == 1) {
      return;
    }
    const double coarse_m = resolutions_m.empty() ? 4.0 * cell_m_ : resolutions_m.back();
    const auto mapper = mapped();
    std::vector<Vec3> walls_W;
    CellEvidence{region(), cell_m_}.for_each([&](const Vec3& p_W, const CellEvidence::Verdict&) {
      if (mapper->view().state(p_W) == CellState::occupied) {
        walls_W.push_back(p_W);
      }
    });
    insert(*mapper, 0, 3.14, {coarse_m, range_m});  // It looks the other way.
    require(std::abs(mapper->view().resolution_m() - coarse_m) < 1e-9,
            "does not answer at the resolution that it was told");
    int lost = 0;
    for (const Vec3& p_W : walls_W) {
      lost += p_W.x() > 1.0 && mapper->view().state(p_W) != CellState::occupied ? 1 : 0;
    }
    require(lost == 0, "forgets obstacles when the resolution changes");
    insert(*mapper, 0, 0.0, settings());
    require(std::abs(mapper->view().resolution_m() - cell_m_) < 1e-9,
            "does not resume a resolution that it had");
  }

  void check_refusals() {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto mapper = mapped();
    const States before = states_of(mapper->view());
    const RoomScan scan = room_scan(0, 1.5);
    PointCloud broken = cloud_of(scan.image, range_m);
    broken.hits_C.front().x() = std::numeric_limits<float>::quiet_NaN();
    Pose nowhere = scan.X_WC;
    nowhere.translation().y() = nan;
    const PointCloud sound = cloud_of(scan.image, range_m);
    const auto refuses = [&](const PointCloud& cloud, const Pose& X_WC,
                             const MapperSettings& with) {
      const auto work = mapper->prepare(cloud, X_WC, with);
      return !work && work.error().code == ErrorCode::invalid_input;
    };
    require(refuses(broken, scan.X_WC, settings()) && refuses(sound, nowhere, settings()),
            "accepts a point or a pose that is not finite");
    require(refuses(sound, scan.X_WC, {0.0, range_m}) &&
                refuses(sound, scan.X_WC, {cell_m_, -1.0}) &&
                refuses(sound, scan.X_WC, {nan, range_m}),
            "accepts a resolution or a range that is not positive");
    mapper->commit();
    require(states_of(mapper->view()) == before, "changes its map by what it refuses");
  }

  void check_work() {
    const RoomScan scan = room_scan(0, 0.0);
    PointCloud all = cloud_of(scan.image, range_m);
    all.camera.reset();  // Without an image, every ray is walked.
    PointCloud half = all;
    half.hits_C.resize(all.hits_C.size() / 2);
    half.clear_C.resize(all.clear_C.size() / 2);
    const auto less = made()->prepare(half, scan.X_WC, settings());
    const auto more = made()->prepare(all, scan.X_WC, settings());
    if (less && more) {
      require(more->count("rays") > 0.0 && more->count("updates") > 0.0,
              "counts no rays or no updates");
      require_work(*more, *less);
      require(more->count("rays") > less->count("rays"), "counts less work for a larger input");
    }
  }

  void check_missions() {
    const auto flown = [this] {
      const auto mapper = made();
      std::vector<double> trace;
      for (int frame = 0; frame < 3; ++frame) {
        const Work work = insert(*mapper, frame, 0.7 * frame, settings());
        for (const WorkItem& item : work.items()) {
          trace.push_back(item.count);
        }
      }
      for (const CellState state : states_of(mapper->view())) {
        trace.push_back(static_cast<double>(state));
      }
      return trace;
    };
    require(flown() == flown(), "begins a mission with what another one has mapped");
  }

  double cell_m_{0.15};
};

}  // namespace flyball
