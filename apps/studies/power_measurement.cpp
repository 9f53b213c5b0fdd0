// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/studies/power_measurement.h"

#include "flyball/runtime/realtime/cpus.h"

#include <atomic>
#include <future>
#include <thread>

namespace flyball {
namespace {

/// Keeps cores busy with arithmetic while it lives.
class BusyCores {
 public:
  BusyCores() = default;
  BusyCores(const BusyCores&) = delete;
  BusyCores& operator=(const BusyCores&) = delete;
  ~BusyCores() {
    ends_ = true;
    for (std::thread& one : threads_) {
      one.join();
    }
  }

  /// One more.
  Status take(int cpu) {
    std::promise<std::optional<std::string>> bound;
    auto failure = bound.get_future();
    threads_.emplace_back([this, cpu, bound = std::move(bound)]() mutable {
      bound.set_value(bind_thread(0, {cpu}));
      work();
    });
    if (const auto sentence = failure.get()) {
      return Error{ErrorCode::unavailable, *sentence};
    }
    return Done{};
  }

 private:
  void work() {
    double x = 1.0;
    while (!ends_) {
      for (int i = 0; i < 1000; ++i) {
        x = 1.0 + 1.0 / x;  // Towards the golden ratio: neither overflows nor ends.
      }
    }
    last_ = x;
  }

  std::vector<std::thread> threads_{};
  std::atomic<bool> ends_{};
  std::atomic<double> last_{};  ///< Read by nobody; without it there would be nothing to compute.
};

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
