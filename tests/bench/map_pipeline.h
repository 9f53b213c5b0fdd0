// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What map_bench measures: ways of mapping the frames of a flight.

#include "bricks/brick_map.h"
#include "bricks/octree_record.h"
#include "map_scenes.h"
#include "scans/exact_scan.h"
#include "scans/pyramid_scan.h"
#include "scans/ray_scan.h"
#include <string>
#include <vector>

namespace flyball::bench {

/// How much is measured.
struct Plan {
  std::vector<ImageSize> sizes{{320, 240}, {640, 480}};  ///< Questions are asked after the first.
  int levels{4};
  int repetitions{5};
  std::size_t questions{1000000};
};

inline constexpr double finest_m = 0.15;

struct Variant {
  std::string front_end;  ///< stock, exact, rays, pyramid, knob.
  bool writes_record;
  Simd simd;
};

[[nodiscard]] std::string name_of(Simd simd);
[[nodiscard]] std::string name_of(Scene scene);
/// CPU time of this thread.
[[nodiscard]] double thread_s();
/// Ten frames of the flight.
[[nodiscard]] const std::vector<Frame>& frames(Scene scene, ImageSize size);

/// One way of mapping a frame.
class Pipeline {
 public:
  /// A map with cells of `level`; for `knob` one of the finest cells that is freed at that level.
  Pipeline(const Variant& variant, int level)
      : variant_{variant},
        level_{variant.front_end == "knob" ? level : 0},
        cell_m_{variant.front_end == "knob" ? finest_m : finest_m * (1 << level)},
        exact_{cell_m_, variant.simd},
        rays_{cell_m_, RayScan::Match::close, variant.simd},
        pyramid_{cell_m_, variant.simd},
        map_{cell_m_, variant.simd},
        tree_{cell_m_} {
    map_.reserve(500);
    tree_.setClampingThresMin(0.12);  // both as in MAVBench's code
    tree_.setClampingThresMax(0.97);
  }

  /// Lets the front-end grow to the size of such a frame; nothing is mapped.
  void warm_up(const Frame& frame) { (void)masks_of(frame); }
  void insert(const Frame& frame);

  [[nodiscard]] const BrickMap& map() const { return map_; }
  [[nodiscard]] const octomap::OcTree& tree() const { return tree_; }

  double updates{};
  double bricks{};

 private:
  /// Null for stock.
  const ScanMasks* masks_of(const Frame& frame);

  Variant variant_;
  int level_;
  double cell_m_;
  ExactScan exact_;
  RayScan rays_;
  PyramidScan pyramid_;
  BrickMap map_;
  OctreeRecord record_{};
  octomap::OcTree tree_;
};

}  // namespace flyball::bench
