// SPDX-License-Identifier: BSD-3-Clause
//
// The brick map against stock OctoMap, in one run: insertion at every level, in two scenes, with
// two image sizes and every front-end and instruction set; questions; inflation; the switch of
// level; revisions for readers. CPU time, the least of the repetitions, so that other programs on
// the host count little.
// One command makes the tables:
//
//     ninja map_bench && bin/map_bench --table=map_bench.md
//
// `--small` measures little of everything, in about a second: a test that all of it still works.
// The program fails when any answer differs from stock's. Other options are Google Benchmark's:
// --benchmark_filter='indoor/320x240' measures a part.

#include "map_pipeline.h"
#include "map_questions.h"
#include "map_revisions.h"
#include "map_table.h"

#include <benchmark/benchmark.h>

namespace flyball::bench {
namespace {

/// Milliseconds a frame.
void insert(
    benchmark::State& state, Scene scene, ImageSize size, int level, const Variant& variant) {
  const auto& flight = frames(scene, size);
  const auto count = static_cast<double>(flight.size());
  for (auto _ : state) {
    Pipeline pipeline{variant, level};
    pipeline.warm_up(flight.front());
    const double start_s = thread_s();
    for (const Frame& frame : flight) {
      pipeline.insert(frame);
    }
    state.SetIterationTime((thread_s() - start_s) / count);
    state.counters["cells"] = pipeline.updates / count;
    state.counters["bytes"] = 128.0 * pipeline.bricks / count;  // a brick is read and written
  }
}

void register_insertion(const Plan& plan, Scene scene, ImageSize size) {
  for (int level = 0; level < plan.levels; ++level) {
    const auto add = [&](const Variant& variant) {
      const std::string name =
          insertion_name({name_of(scene), size.width_px, size.height_px, level, variant.front_end,
                          variant.writes_record, name_of(variant.simd)});
      benchmark::RegisterBenchmark(
          name.c_str(),
          [=](benchmark::State& state) { insert(state, scene, size, level, variant); })
          ->UseManualTime()
          ->Iterations(1)
          ->Repetitions(variant.front_end == "stock" ? (plan.repetitions + 1) / 2
                                                     : plan.repetitions)
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

}  // namespace

void register_all(const Plan& plan) {
  for (const Scene scene : {Scene::indoor, Scene::outdoor}) {
    for (const ImageSize size : plan.sizes) {
      register_insertion(plan, scene, size);
    }
    register_questions(plan, scene);
    register_revisions(plan, scene);
  }
  register_indexes(plan);
  register_switch(plan);
}

}  // namespace flyball::bench

int main(int argc, char** argv) {
  flyball::bench::Plan plan;
  const std::string file = flyball::bench::take_option(argc, argv, "--table=").value_or("");
  if (flyball::bench::take_option(argc, argv, "--small")) {
    plan = {{{64, 48}}, 2, 1, 2000};
  }
  flyball::bench::register_all(plan);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 1;
  }
  flyball::bench::TableReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  const bool is_written = file.empty() || reporter.write(file, plan);
  return is_written && !reporter.has_differences() ? 0 : 1;
}
