// SPDX-License-Identifier: BSD-3-Clause
#include "map_questions.h"

#include "bricks/brick_view.h"
#include "map_table.h"
#include "octree_walk.h"
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <tuple>

#include <benchmark/benchmark.h>

namespace flyball::bench {
namespace {

constexpr Cylinder body{0.45, 0.25};

struct Questions {
  std::vector<Vec3> places;
  std::vector<Vec3> ends;  ///< At most 5 m away.
  /// As many points on the first of these ways, a decimetre apart, as a mission asks for them;
  /// `places` is harder on the caches than any mission.
  std::vector<Vec3> on_ways;
};

constexpr double step_m = 0.1;

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
  for (std::size_t i = 0; asked.on_ways.size() < count; ++i) {
    const Vec3 way = asked.ends[i] - asked.places[i];
    const int steps = static_cast<int>(way.norm() / step_m);
    for (int step = 0; step <= steps && asked.on_ways.size() < count; ++step) {
      asked.on_ways.push_back(asked.places[i] + step * step_m * way.normalized());
    }
  }
  return asked;
}

/// The same flight in both maps.
struct Maps {
  Pipeline bricks;
  Pipeline octree;
  BrickView brick_view{bricks.map().cells()};
  std::optional<OctreeView> tree_view{};

  Maps(Scene scene, int level, ImageSize size)
      : bricks{{"exact", false, widest_simd()}, 0},
        octree{{"stock", false, Simd::portable}, level} {
    for (const Frame& frame : frames(scene, size)) {
      bricks.insert(frame);
      octree.insert(frame);
    }
    brick_view.activate(level);
    tree_view.emplace(octree.tree());
  }
};

const Maps& maps(Scene scene, int level, ImageSize size) {
  static std::map<std::tuple<Scene, int>, std::unique_ptr<Maps>> made;
  auto& kept = made[{scene, level}];
  if (!kept) {
    kept = std::make_unique<Maps>(scene, level, size);
  }
  return *kept;
}

template <class View>
using Answer = int (*)(const View& view, const Questions& asked, std::size_t i);

template <class View>
Answer<View> answer_of(const std::string& kind) {
  if (kind == "point") {
    return [](const View& view, const Questions& asked, std::size_t i) {
      return static_cast<int>(view.state(asked.places[i]));
    };
  }
  if (kind == "way") {
    return [](const View& view, const Questions& asked, std::size_t i) {
      return static_cast<int>(view.state(asked.on_ways[i]));
    };
  }
  if (kind == "body") {
    return [](const View& view, const Questions& asked, std::size_t i) {
      return static_cast<int>(view.body_state(asked.places[i], body));
    };
  }
  return [](const View& view, const Questions& asked, std::size_t i) {
    return view.segment_hits(asked.places[i], asked.ends[i], body) ? 1 : 0;
  };
}

/// Nanoseconds a question.
template <class View>
void time_answers(benchmark::State& state,
                  const View& view,
                  const Questions& asked,
                  const std::string& kind,
                  std::size_t count) {
  const Answer<View> answer = answer_of<View>(kind);
  int sum = 0;
  for (auto _ : state) {
    const double start_s = thread_s();
    for (std::size_t i = 0; i < count; ++i) {
      sum += answer(view, asked, i);
    }
    state.SetIterationTime((thread_s() - start_s) / static_cast<double>(count));
  }
  benchmark::DoNotOptimize(sum);
}

/// At the finest level, a million answers are compared with stock.
void ask(benchmark::State& state, const Plan& plan, Scene scene, const Question& question) {
  const Maps& both = maps(scene, question.level, plan.sizes.front());
  const std::size_t count =
      question.kind == "point" || question.kind == "way" ? plan.questions : plan.questions / 20;
  const Questions asked = questions(scene, count);
  if (question.stock) {
    time_answers(state, *both.tree_view, asked, question.kind, count);
    return;
  }
  time_answers(state, both.brick_view, asked, question.kind, count);
  if (question.level == 0) {
    const auto ours = answer_of<BrickView>(question.kind);
    const auto stock = answer_of<OctreeView>(question.kind);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < count; ++i) {
      differing += ours(both.brick_view, asked, i) != stock(*both.tree_view, asked, i) ? 1 : 0;
    }
    state.counters["differing"] = static_cast<double>(differing);
  }
}

/// Milliseconds for 24 x 24 x 6 m around the middle of the flight.
void inflate(benchmark::State& state, const Plan& plan, Scene scene) {
  const Maps& both = maps(scene, 0, plan.sizes.front());
  const auto& flight = frames(scene, plan.sizes.front());
  const Vec3 centre = flight[flight.size() / 2].X_WC.translation();
  const Vec3 half{12.0, 12.0, 3.0};
  InflatedWindow window;
  for (auto _ : state) {
    const double start_s = thread_s();
    both.brick_view.inflate({centre - half, centre + half}, body, Obstruction::occupied_or_unknown,
                            window);
    state.SetIterationTime(thread_s() - start_s);
  }
}

/// Nanoseconds for the switch itself, there and back.
void switch_level(benchmark::State& state, const Plan& plan) {
  Pipeline pipeline{{"knob", false, widest_simd()}, 0};
  for (const Frame& frame : frames(Scene::indoor, plan.sizes.front())) {
    pipeline.insert(frame);
  }
  BrickView view{pipeline.map().cells()};
  for (auto _ : state) {
    view.activate(3);
    benchmark::DoNotOptimize(view);
    view.activate(0);
    benchmark::DoNotOptimize(view);
  }
}

}  // namespace

void register_questions(const Plan& plan, Scene scene) {
  for (int level = 0; level < plan.levels; ++level) {
    for (const char* kind : question_kinds) {
      for (const bool stock : {false, true}) {
        const Question question{name_of(scene), level, kind, stock};
        benchmark::RegisterBenchmark(
            question_name(question).c_str(),
            [=](benchmark::State& state) { ask(state, plan, scene, question); })
            ->UseManualTime()
            ->Iterations(1)
            ->Repetitions(plan.repetitions)
            ->Unit(benchmark::kNanosecond);
      }
    }
  }
  benchmark::RegisterBenchmark(inflation_name(name_of(scene)).c_str(),
                               [=](benchmark::State& state) { inflate(state, plan, scene); })
      ->UseManualTime()
      ->Iterations(20)
      ->Repetitions(plan.repetitions)
      ->Unit(benchmark::kMillisecond);
}

void register_switch(const Plan& plan) {
  benchmark::RegisterBenchmark("switch",
                               [=](benchmark::State& state) { switch_level(state, plan); });
}

}  // namespace flyball::bench
