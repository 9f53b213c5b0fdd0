// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/platform.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flyball {

namespace {

double in_ghz(Hertz frequency) {
  return frequency.value() * 1e-9;
}

}  // namespace

ModeledPlatform::ModeledPlatform(PlatformModel model) : model_{std::move(model)} {}

Duration ModeledPlatform::job_time(std::string_view kernel,
                                   const Work& work,
                                   Hertz frequency) const {
  const auto entry = model_.kernels.find(kernel);
  if (entry == model_.kernels.end()) {
    return Duration::zero();
  }
  FLYBALL_ASSERT(frequency.value() > 0.0, "frequency=%g Hz", frequency.value());
  const KernelCost& cost = entry->second;
  double at_one_ghz_s = 0.0;
  for (const WorkItem& item : work.items()) {
    FLYBALL_ASSERT(item.count >= 0.0 && std::isfinite(item.count), "count=%g of one job",
                   item.count);
    if (const auto price = cost.seconds_per.find(item.name); price != cost.seconds_per.end()) {
      at_one_ghz_s += item.count * price->second;
    }
  }
  const double time_s = cost.scale * at_one_ghz_s * (cost.a / in_ghz(frequency) + waiting(cost));
  // A platform's file may ask for any price. No mission lasts so long, and sums of it still fit.
  constexpr double longest_s = 1e9;
  return from_seconds(time_s < longest_s ? time_s : longest_s);
}

double ModeledPlatform::waiting(const KernelCost& cost) const {
  return cost.on_gpu && model_.gpu ? cost.b / in_ghz(model_.gpu->clock) : cost.b;
}

bool ModeledPlatform::runs_on_gpu(std::string_view kernel) const {
  const auto entry = model_.kernels.find(kernel);
  return model_.gpu && entry != model_.kernels.end() && entry->second.on_gpu;
}

Watts ModeledPlatform::gpu_power() const {
  return Watts{model_.gpu ? model_.gpu->busy_w : 0.0};
}

double ModeledPlatform::slowdown(std::string_view kernel, Hertz clock, double other_cores) const {
  const auto entry = model_.kernels.find(kernel);
  if (entry == model_.kernels.end() || entry->second.on_gpu || !(other_cores > 0.0)) {
    return 1.0;
  }
  const auto& [a, b] = std::pair{entry->second.a, entry->second.b};
  return 1.0 + b * model_.memory_contention * other_cores / (a / in_ghz(clock) + b);
}

double ModeledPlatform::speedup(std::string_view kernel, double cores) const {
  const auto entry = model_.kernels.find(kernel);
  if (entry == model_.kernels.end() || cores <= 1.0) {
    return 1.0;
  }
  const double p = entry->second.parallel_fraction;
  return 1.0 / ((1.0 - p) + p / cores);  // Amdahl 1967
}

bool ModeledPlatform::knows(std::string_view kernel) const {
  return model_.kernels.find(kernel) != model_.kernels.end();
}

Watts ModeledPlatform::power(const OperatingPoint& point, double busy_cores) const {
  const double cores_on = std::max<double>(point.cores, busy_cores);
  return model_.power.power(point.frequency, busy_cores,
                            std::max(0.0, model_.max_cores - cores_on));
}

Watts PowerCost::core_power(Hertz clock) const {
  const double f = in_ghz(clock);
  return Watts{core_linear_w * f + core_cubic_w * f * f * f};
}

Hertz PowerCost::memory_clock(Hertz clock) const {
  Hertz memory{};
  for (const MemoryClock& step : memory_clocks) {
    if (!(clock < step.from)) {
      memory = step.memory;
    }
  }
  return memory;
}

Watts PowerCost::power(Hertz clock, double busy_cores, double cores_off) const {
  const double cpu_w = cpu_constant_w - cores_off * idle_core_w + cpu_linear_w * in_ghz(clock) +
                       busy_cores * core_power(clock).value();
  const double ram_w = memory_w + memory_linear_w * in_ghz(memory_clock(clock));
  return Watts{board_w + converter * (soc_w + ram_w + cpu_w)};
}

}  // namespace flyball
