// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/studies/power_measurement.h"

#include "studies/busy_cores.h"
#include <thread>

namespace flyball {
namespace {

Watts mean_power(const PowerMeasurement& how) {
  std::this_thread::sleep_for(how.settling);
  double sum_w = 0.0;
  for (int i = 0; i < how.readings; ++i) {
    std::this_thread::sleep_for(how.period);
    sum_w += how.meter().value();
  }
  return Watts{sum_w / how.readings};
}

}  // namespace

Result<std::vector<MeasuredPower>> measure_power(const PowerMeasurement& how) {
  std::vector<MeasuredPower> samples;
  for (const Hertz clock : how.clocks) {
    if (const Status set = how.set ? how.set(clock) : Done{}; !set) {
      return set.error();
    }
    BusyCores busy;
    samples.push_back({clock, 0.0, mean_power(how)});
    for (std::size_t n = 0; n < how.cpus.size(); ++n) {
      if (const Status taken = busy.take(how.cpus[n]); !taken) {
        return taken.error();
      }
      samples.push_back({clock, static_cast<double>(n + 1), mean_power(how)});
    }
  }
  return samples;
}

}  // namespace flyball
