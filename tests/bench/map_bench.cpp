// SPDX-License-Identifier: BSD-3-Clause
//
// The brick map against stock OctoMap, in one run: insertion at every level, in two scenes, with
// two image sizes and every front-end and instruction set; questions; the switch of level. CPU
// time, the least of the repetitions, so that other programs on the host count little. One command
// makes the tables:
//
//     ninja map_bench && bin/map_bench --table=map_bench.md
//
// Other options are Google Benchmark's: --benchmark_filter='indoor/320x240' measures a part.

#include "../../kernels/src/bricks/brick_view.h"
#include "../../kernels/src/bricks/octree_record.h"
#include "../../kernels/src/bricks/pyramid_scan.h"
#include "../../kernels/src/bricks/ray_scan.h"
#include "../../kernels/src/octomap_view.h"
#include "map_scenes.h"
#include "map_table.h"
#include <ctime>
#include <map>
#include <random>
#include <string>
#include <tuple>

#include <benchmark/benchmark.h>

namespace flyball::bench {
namespace {

constexpr int stride = 5;  // ten frames of the flight
constexpr double finest_m = 0.15;
constexpr int levels = 4;
constexpr Cylinder body{0.45, 0.25};

struct Variant {
  std::string front_end;  ///< stock, exact, rays, pyramid, knob.
  bool writes_record;
  Simd simd;
};

std::string name_of(Simd simd) {
  return simd == Simd::avx512 ? "AVX-512" : simd == Simd::avx2 ? "AVX2" : "portable";
}

double thread_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

const std::vector<Frame>& frames(Scene scene, ImageSize size) {
  static std::map<std::tuple<Scene, int>, std::vector<Frame>> made;
  auto& kept = made[{scene, size.width_px}];
  if (kept.empty()) {
    kept = frames_of(scene, size, stride);
  }
  return kept;
}

/// One way of mapping a frame.
class Pipeline {
 public:
  /// A map with cells of `level`; for `knob` one of the finest cells that is freed at that level.
  Pipeline(const Variant& variant, int level)
      : variant_{variant},
        level_{variant.front_end == "knob" ? level : 0},
        cell_m_{variant.front_end == "knob" ? finest_m : finest_m * (1 << level)},
        rays_{cell_m_, variant.front_end == "rays" ? RayScan::Match::close : RayScan::Match::stock,
              variant.simd},
        pyramid_{cell_m_, variant.simd},
        map_{cell_m_, variant.simd},
        tree_{cell_m_} {
    map_.reserve(500);
    tree_.setClampingThresMin(0.12);  // both as in MAVBench's code
    tree_.setClampingThresMax(0.97);
  }

  void insert(const Frame& frame) {
    if (variant_.front_end == "stock") {
      tree_.insertPointCloud(frame.points_W, frame.scan.origin_W, scene_range_m);
      return;
    }
    const bool looks = variant_.front_end == "pyramid" || variant_.front_end == "knob";
    const ScanMasks& masks =
        looks ? pyramid_.compute(frame.cloud_C, frame.X_WC, scene_range_m, level_)
              : rays_.compute(frame.scan);
    map_.apply(masks.bricks);
    if (variant_.writes_record) {
      record_.write(masks.bricks, tree_);
    }
    updates += masks.updates;
    bricks += static_cast<double>(masks.bricks.size());
  }

  [[nodiscard]] const BrickMap& map() const { return map_; }
  [[nodiscard]] const octomap::OcTree& tree() const { return tree_; }

  double updates{};
  double bricks{};

 private:
  Variant variant_;
  int level_;
  double cell_m_;
  RayScan rays_;
  PyramidScan pyramid_;
  BrickMap map_;
  OctreeRecord record_{};
  octomap::OcTree tree_;
};

/// Milliseconds a frame.
void insert(
    benchmark::State& state, Scene scene, ImageSize size, int level, const Variant& variant) {
  const auto& flight = frames(scene, size);
  const auto count = static_cast<double>(flight.size());
  for (auto _ : state) {
    Pipeline pipeline{variant, level};
    const double start_s = thread_s();
    for (const Frame& frame : flight) {
      pipeline.insert(frame);
    }
    state.SetIterationTime((thread_s() - start_s) / count);
    state.counters["cells"] = pipeline.updates / count;
    state.counters["bytes"] = 128.0 * pipeline.bricks / count;  // a brick is read and written
  }
}

struct Questions {
  std::vector<Vec3> places;
  std::vector<Vec3> ends;  ///< At most 5 m away.
};

Questions questions(Scene scene, std::size_t count) {
  std::mt19937 generator{5};
  const Aabb space = flight_space(scene);
  const auto unit = [&] { return static_cast<double>(generator()) / 4294967296.0; };
  const auto place = [&] {
    const Vec3 share{unit(), unit(), unit()};
    return Vec3{space.min + share.cwiseProduct(space.max - space.min)};
  };
  Questions asked;
  for (std::size_t i = 0; i < count; ++i) {
    asked.places.push_back(place());
    const Vec3 way = place() - asked.places.back();
    asked.ends.push_back(asked.places.back() + std::min(1.0, 5.0 / way.norm()) * way);
  }
  return asked;
}

/// The same flight in both maps.
struct Maps {
  Pipeline bricks;
  Pipeline octree;
  BrickView brick_view{bricks.map()};
  OctomapView tree_view{};

  Maps(Scene scene, int level)
      : bricks{{"exact", false, widest_simd()}, 0},
        octree{{"stock", false, Simd::portable}, level} {
    for (const Frame& frame : frames(scene, {320, 240})) {
      bricks.insert(frame);
      octree.insert(frame);
    }
    brick_view.activate(level);
    tree_view.activate(octree.tree());
  }
};

const Maps& maps(Scene scene, int level) {
  static std::map<std::tuple<Scene, int>, std::unique_ptr<Maps>> made;
  auto& kept = made[{scene, level}];
  if (!kept) {
    kept = std::make_unique<Maps>(scene, level);
  }
  return *kept;
}

int answer(const OccupancyView& view,
           const std::string& kind,
           const Questions& asked,
           std::size_t i) {
  return kind == "point" ? static_cast<int>(view.state(asked.places[i]))
         : kind == "body"
             ? static_cast<int>(view.body_state(asked.places[i], body))
             : static_cast<int>(view.segment_hits(asked.places[i], asked.ends[i], body));
}

/// Nanoseconds a question. At the finest level, a million of them are compared with stock.
void ask(benchmark::State& state, Scene scene, int level, const std::string& kind, bool stock) {
  const Maps& both = maps(scene, level);
  const OccupancyView& view =
      stock ? static_cast<const OccupancyView&>(both.tree_view) : both.brick_view;
  const std::size_t count = kind == "point" ? 1000000 : 50000;
  const Questions asked = questions(scene, count);
  int sum = 0;
  for (auto _ : state) {
    const double start_s = thread_s();
    for (std::size_t i = 0; i < count; ++i) {
      sum += answer(view, kind, asked, i);
    }
    state.SetIterationTime((thread_s() - start_s) / static_cast<double>(count));
  }
  benchmark::DoNotOptimize(sum);
  if (!stock && level == 0) {
    std::size_t differing = 0;
    for (std::size_t i = 0; i < count; ++i) {
      differing +=
          answer(both.brick_view, kind, asked, i) != answer(both.tree_view, kind, asked, i) ? 1 : 0;
    }
    state.counters["differing"] = static_cast<double>(differing);
  }
}

/// Nanoseconds for the switch itself, there and back.
void switch_level(benchmark::State& state) {
  Pipeline pipeline{{"knob", false, widest_simd()}, 0};
  for (const Frame& frame : frames(Scene::indoor, {320, 240})) {
    pipeline.insert(frame);
  }
  BrickView view{pipeline.map()};
  for (auto _ : state) {
    view.activate(3);
    benchmark::DoNotOptimize(view);
    view.activate(0);
    benchmark::DoNotOptimize(view);
  }
}

std::string label(Scene scene) {
  return scene == Scene::indoor ? "indoor" : "outdoor";
}

void register_insertion(Scene scene, ImageSize size) {
  for (int level = 0; level < levels; ++level) {
    const auto add = [&](const Variant& variant) {
      const std::string name =
          insertion_name({label(scene), size.width_px, size.height_px, level, variant.front_end,
                          variant.writes_record, name_of(variant.simd)});
      benchmark::RegisterBenchmark(
          name.c_str(),
          [=](benchmark::State& state) { insert(state, scene, size, level, variant); })
          ->UseManualTime()
          ->Iterations(1)
          ->Repetitions(variant.front_end == "stock" ? 2 : 5)
          ->Unit(benchmark::kMillisecond);
    };
    add({"stock", false, Simd::portable});
    for (const Simd simd : supported_simd()) {
      for (const char* front_end : {"exact", "rays", "pyramid", "knob"}) {
        add({front_end, false, simd});
      }
      add({"exact", true, simd});
    }
  }
}

void register_questions(Scene scene) {
  for (int level = 0; level < levels; ++level) {
    for (const char* kind : {"point", "body", "segment"}) {
      for (const bool stock : {false, true}) {
        benchmark::RegisterBenchmark(
            question_name({label(scene), level, kind, stock}).c_str(),
            [=](benchmark::State& state) { ask(state, scene, level, kind, stock); })
            ->UseManualTime()
            ->Iterations(1)
            ->Repetitions(3)
            ->Unit(benchmark::kNanosecond);
      }
    }
  }
}

}  // namespace

void register_all() {
  for (const Scene scene : {Scene::indoor, Scene::outdoor}) {
    for (const ImageSize size : {ImageSize{320, 240}, ImageSize{640, 480}}) {
      register_insertion(scene, size);
    }
    register_questions(scene);
  }
  benchmark::RegisterBenchmark("switch", switch_level);
}

}  // namespace flyball::bench

int main(int argc, char** argv) {
  const std::string file = flyball::bench::take_table_option(argc, argv);
  flyball::bench::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 1;
  }
  flyball::bench::TableReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return file.empty() || reporter.write(file) ? 0 : 1;
}
