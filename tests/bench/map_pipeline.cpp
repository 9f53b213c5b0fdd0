// SPDX-License-Identifier: BSD-3-Clause
#include "map_pipeline.h"

#include <ctime>
#include <map>
#include <tuple>

namespace flyball::bench {

std::string name_of(Simd simd) {
  return simd == Simd::avx512 ? "AVX-512" : simd == Simd::avx2 ? "AVX2" : "portable";
}

std::string name_of(Scene scene) {
  return scene == Scene::indoor ? "indoor" : "outdoor";
}

double thread_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

const std::vector<Frame>& frames(Scene scene, ImageSize size) {
  constexpr int stride = 5;
  static std::map<std::tuple<Scene, int>, std::vector<Frame>> made;
  auto& kept = made[{scene, size.width_px}];
  if (kept.empty()) {
    kept = frames_of(scene, size, stride);
  }
  return kept;
}

const ScanMasks* Pipeline::masks_of(const Frame& frame) {
  if (variant_.front_end == "stock") {
    return nullptr;
  }
  if (variant_.front_end == "exact") {
    return &exact_.compute(frame.pixels, frame.X_WC, scene_range_m);
  }
  const bool looks = variant_.front_end == "pyramid" || variant_.front_end == "knob";
  return looks ? &pyramid_.compute(frame.cloud_C, frame.X_WC, scene_range_m, level_)
               : &rays_.compute(frame.scan);
}

void Pipeline::insert(const Frame& frame) {
  const ScanMasks* masks = masks_of(frame);
  if (masks == nullptr) {
    tree_.insertPointCloud(frame.points_W, frame.scan.origin_W, scene_range_m);
    return;
  }
  map_.apply(masks->bricks);
  if (variant_.writes_record) {
    record_.write(masks->bricks, tree_);
  }
  updates += masks->updates;
  bricks += static_cast<double>(masks->bricks.size());
}

}  // namespace flyball::bench
