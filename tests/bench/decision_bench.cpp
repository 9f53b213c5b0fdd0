// SPDX-License-Identifier: BSD-3-Clause
//
// How long policies think, with a TX2's twelve clocks and a lattice of cells:
//   decision_bench                                    each built-in policy
//   decision_bench --benchmark_filter=mission_energy
// A decision's time is measured by itself, over and over the same mission's worth of plausible
// observations; p50, p99 and max are microseconds. `allocations` are those after the first round.

#include "counting_new.h"
#include "started_policy.h"
#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace {

using namespace flyball;

constexpr std::size_t observations = 1000;

KnobSettings knobs_of_a_tx2() {
  std::vector<KnobSpec> specs = conformance_knobs().specs();
  for (KnobSpec& spec : specs) {
    if (spec.name == "cpu.frequency_hz") {
      spec.legal.clear();
      for (const double mhz : {345.6, 499.2, 652.8, 806.4, 960.0, 1113.6, 1267.2, 1420.8, 1574.4,
                               1728.0, 1881.6, 2035.2}) {
        spec.legal.push_back(mhz * 1e6);
      }
    }
  }
  return KnobSettings{specs};
}

double share(const std::vector<double>& sorted, double q) {
  return sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))];
}

void decide(benchmark::State& state, const Registry& registry, const std::string& name) {
  const auto given = with_examples(registry.make<Policy>(name)->parameters(), {});
  const StartedPolicy started = start_policy(name, given, knobs_of_a_tx2());
  if (!started.status.ok()) {
    state.SkipWithError(started.status.error().message.c_str());
    return;
  }
  std::vector<Observation> seen = plausible_observations(observations);
  const Duration round = seen.back().now - seen.front().now + std::chrono::milliseconds{250};
  for (const Observation& one : seen) {
    benchmark::DoNotOptimize(started.policy->decide(one));
  }
  using Clock = std::chrono::steady_clock;
  std::vector<double> took_us;
  took_us.reserve(std::size_t{1} << 24U);
  const std::size_t before = allocation_count();
  std::size_t next = 0;
  for (auto _ : state) {
    Observation& one = seen[next];
    one.now += round;
    one.map_revision += observations;
    const Clock::time_point asked = Clock::now();
    benchmark::DoNotOptimize(started.policy->decide(one));
    took_us.push_back(std::chrono::duration<double, std::micro>(Clock::now() - asked).count());
    next = (next + 1) % observations;
  }
  const std::size_t after = allocation_count();
  std::sort(took_us.begin(), took_us.end());
  state.counters["p50"] = share(took_us, 0.50);
  state.counters["p99"] = share(took_us, 0.99);
  state.counters["max"] = took_us.back();
  state.counters["allocations"] = static_cast<double>(after - before);
}

}  // namespace

int main(int argc, char** argv) {
  Registry registry;
  register_policies(registry);
  for (const std::string& name : registry.names<Policy>()) {
    benchmark::RegisterBenchmark(name.c_str(),
                                 [&registry, name](auto& state) { decide(state, registry, name); });
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
    return 1;
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
