// SPDX-License-Identifier: BSD-3-Clause
// tested-in: power_measurement
#include "studies/busy_cores.h"

#include "flyball/runtime/realtime/cpus.h"

#include <future>
#include <optional>
#include <string>
#include <utility>

namespace flyball {

BusyCores::~BusyCores() {
  ends_ = true;
  for (std::thread& one : threads_) {
    one.join();
  }
}

Status BusyCores::take(int cpu) {
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

void BusyCores::work() {
  double x = 1.0;
  while (!ends_) {
    for (int i = 0; i < 1000; ++i) {
      x = 1.0 + 1.0 / x;  // Towards the golden ratio: neither overflows nor ends.
    }
  }
  last_ = x;
}

}  // namespace flyball
