// SPDX-License-Identifier: BSD-3-Clause
#include "map_revisions.h"

#include "flyball/kernels/kernels.h"
#include "flyball/kernels/mapper.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <limits>

#include <benchmark/benchmark.h>

namespace flyball::bench {
namespace {

constexpr double coarse_m = 0.60;

std::unique_ptr<Mapper> made(const RevisedMapper& kind) {
  Registry registry;
  register_kernels(registry);
  auto mapper = registry.make<Mapper>(kind.mapper);
  std::map<std::string, ParameterValue> given;
  if (kind.layers != nullptr) {
    given["layers"] = std::string{kind.layers};
  }
  if (kind.front_end != nullptr) {
    given["front_end"] = std::string{kind.front_end};
  }
  const auto chosen = Parameters::resolve("mapper", mapper->parameters(), given);
  if (!mapper->configure(std::get<Parameters>(chosen), no_models)) {
    std::fprintf(stderr, "mapper %s refuses its parameters\n", kind.mapper);
    std::exit(2);
  }
  return mapper;
}

/// CPU time of each frame of a flight, in seconds: the least of several flights.
struct Times {
  explicit Times(std::size_t frames)
      : insert_s(frames, std::numeric_limits<double>::max()), hand_on_s{insert_s} {}
  std::vector<double> insert_s;
  std::vector<double> hand_on_s;
  std::size_t bytes{};  ///< Of the map in the end, with its reader.
};

double sum_of(const std::vector<double>& times_s) {
  double sum_s = 0.0;
  for (const double time_s : times_s) {
    sum_s += time_s;
  }
  return sum_s;
}

struct Flight {
  const std::vector<Frame>& frames;
  const RevisedMapper& kind;
  bool changes_cells;
};

void fly(const Flight& flight, bool has_reader, Times& times) {
  const auto mapper = made(flight.kind);
  std::shared_ptr<const OccupancyView> held;
  for (std::size_t i = 0; i < flight.frames.size(); ++i) {
    const Frame& frame = flight.frames[i];
    const double cell_m = flight.changes_cells && i % 2 == 1 ? coarse_m : finest_m;
    const double start_s = thread_s();
    (void)mapper->prepare_frame(frame.pixels, frame.X_WC, {cell_m, scene_range_m});
    mapper->commit();
    const double inserted_s = thread_s();
    times.insert_s[i] = std::min(times.insert_s[i], inserted_s - start_s);
    if (has_reader) {
      auto next = mapper->revision();
      times.hand_on_s[i] = std::min(times.hand_on_s[i], thread_s() - inserted_s);
      held = std::move(next);
    }
  }
  times.bytes = mapper->contents().bytes;
}

/// Milliseconds a frame with a reader, and what else is worth knowing. In turn with and without, so
/// that what slows the host down slows both.
void revise(benchmark::State& state, const Plan& plan, const Flight& flight) {
  for (auto _ : state) {
    Times alone{flight.frames.size()};
    Times read{flight.frames.size()};
    for (int i = 0; i < plan.repetitions; ++i) {
      fly(flight, false, alone);
      fly(flight, true, read);
    }
    const auto count = static_cast<double>(flight.frames.size());
    state.SetIterationTime(sum_of(read.insert_s) / count);
    state.counters["alone_ms"] = 1e3 * sum_of(alone.insert_s) / count;
    state.counters["times"] = sum_of(read.insert_s) / sum_of(alone.insert_s);
    state.counters["hand_on_us"] = 1e6 * sum_of(read.hand_on_s) / count;
    state.counters["most_us"] =
        1e6 * *std::max_element(read.hand_on_s.begin(), read.hand_on_s.end());
    state.counters["MB"] = 1e-6 * static_cast<double>(alone.bytes);
    state.counters["read_MB"] = 1e-6 * static_cast<double>(read.bytes);
  }
}

/// A brick in each of `count` chunks of a square, 100 chunks wide.
std::vector<BrickMasks> scattered(int count) {
  std::vector<BrickMasks> changes;
  for (int i = 0; i < count; ++i) {
    changes.push_back({{8 * (i % 100), 8 * (i / 100), 0}, 1, 2});
  }
  return changes;
}

/// Microseconds to hand on a revision; the reader holds the one before.
void hand_on(benchmark::State& state, int chunks) {
  BrickMap map{finest_m};
  map.apply(scattered(chunks));
  const auto change = scattered(100);
  auto held = map.revision();
  for (auto _ : state) {
    map.apply(change);
    const double start_s = thread_s();
    auto next = map.revision();
    state.SetIterationTime(thread_s() - start_s);
    held = std::move(next);
  }
}

}  // namespace

std::string revision_name(const std::string& scene,
                          const std::string& mapper,
                          const std::string& cells) {
  return "revise/" + scene + "/" + cells + "/" + mapper;
}

std::string index_name(int chunks) {
  return "hand_on/" + std::to_string(chunks);
}

void register_revisions(const Plan& plan, Scene scene) {
  for (const RevisedMapper& kind : revised_mappers) {
    for (const char* cells : revised_cells) {
      benchmark::RegisterBenchmark(
          revision_name(name_of(scene), kind.name, cells).c_str(),
          [&kind, plan, scene, cells](benchmark::State& state) {
            revise(state, plan,
                   {frames(scene, plan.sizes.front()), kind, cells != revised_cells[0]});
          })
          ->UseManualTime()
          ->Iterations(1)
          ->Unit(benchmark::kMillisecond);
    }
  }
}

void register_indexes(const Plan& plan) {
  for (const int chunks : index_chunks) {
    benchmark::RegisterBenchmark(index_name(chunks).c_str(),
                                 [=](benchmark::State& state) { hand_on(state, chunks); })
        ->UseManualTime()
        ->Iterations(100)
        ->Repetitions(plan.repetitions)
        ->Unit(benchmark::kMicrosecond);
  }
}

}  // namespace flyball::bench
