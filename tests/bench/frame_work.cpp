// SPDX-License-Identifier: BSD-3-Clause
//
// Work on depth images, to be counted from outside: `frame_work WHAT FRAMES`, where WHAT is
// `points` (a depth image becomes points of C, and those points of W), `map` (its cells are found
// and written into the brick map) or `walk` (its rays are walked, as where the image alone does not
// tell). Two runs with different numbers of frames differ by these frames alone:
// frame_instructions.sh counts with that. A sum over all results is printed, which must be the same
// for every build.

#include "flyball/kernels/point_cloud.h"
#include "flyball/runtime/registry.h"

#include "bricks/brick_map.h"
#include "map_scenes.h"
#include "scans/exact_scan.h"
#include "scans/ray_scan.h"
#include "scans/scan.h"
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

extern "C" void flyball_plugin_depth_to_points(flyball::Registry& registry);

namespace flyball::bench {
namespace {

constexpr double cell_m = 0.15;  // the finest that scenarios map with
constexpr int flight_stride = 5;
constexpr ImageSize size{320, 240};
constexpr int pixels = size.width_px * size.height_px;

/// FNV-1a over bytes.
class Sum {
 public:
  template <class T>
  void add(const T& value) {
    unsigned char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    for (const unsigned char byte : bytes) {
      sum_ = (sum_ ^ byte) * 0x100000001b3;
    }
  }
  [[nodiscard]] std::uint64_t value() const { return sum_; }

 private:
  std::uint64_t sum_{0xcbf29ce484222325};
};

class FrameWork {
 public:
  FrameWork(Registry& registry, Simd simd)
      : points_{registry.make<PointCloudBuilder>("depth_to_points")},
        exact_{cell_m, simd},
        rays_{cell_m, RayScan::Match::close, simd},
        map_{cell_m, simd} {}

  void to_points(const Frame& frame) {
    const DepthFrame depths{{}, 0, pixels, frame.pixels.pixels->image, {}};
    Work work;
    const PointCloudFrame cloud = points_->build(depths, scene_range_m, work);
    to_world(cloud.cloud_C.value(), frame.X_WC, scan_);
    sum.add(scan_.hits_W.size());
    sum.add(scan_.hits_W.front().x() + scan_.hits_W.back().z());
  }
  void to_map(const Frame& frame) {
    const ScanMasks& masks = exact_.compute(frame.pixels, frame.X_WC, scene_range_m);
    map_.apply(masks.bricks);
    sum.add(masks.updates);
    sum.add(masks.traversals);
  }
  void walk(const Frame& frame) {
    const ScanMasks& masks = rays_.compute(frame.scan);
    sum.add(masks.updates);
    sum.add(masks.traversals);
  }

  Sum sum;

 private:
  std::unique_ptr<PointCloudBuilder> points_;
  ExactScan exact_;
  RayScan rays_;
  BrickMap map_;
  Scan scan_;
};

}  // namespace
}  // namespace flyball::bench

int main(int argc, char** argv) {
  using flyball::bench::FrameWork;
  const bool is_portable = argc == 4 && std::string{argv[3]} == "portable";
  const std::string what = argc == 3 || is_portable ? argv[1] : "";
  const auto step = what == "points" ? &FrameWork::to_points
                    : what == "map"  ? &FrameWork::to_map
                    : what == "walk" ? &FrameWork::walk
                                     : nullptr;
  const long frames = step == nullptr ? 0 : std::strtol(argv[2], nullptr, 10);
  if (frames < 1) {
    std::fputs("frame_work points|map|walk FRAMES [portable]\n", stderr);
    return 2;
  }
  flyball::Registry registry;
  flyball_plugin_depth_to_points(registry);
  const auto flight = flyball::bench::frames_of(flyball::bench::Scene::indoor, flyball::bench::size,
                                                flyball::bench::flight_stride);
  FrameWork work{registry, is_portable ? flyball::Simd::portable : flyball::widest_simd()};
  for (long i = 0; i < frames; ++i) {
    (work.*step)(flight[static_cast<std::size_t>(i) % flight.size()]);
  }
  std::printf("%016llx\n", static_cast<unsigned long long>(work.sum.value()));
  return 0;
}
