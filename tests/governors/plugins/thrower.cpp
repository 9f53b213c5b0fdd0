// SPDX-License-Identifier: BSD-3-Clause
//
// C++ without the wrapper: its exceptions come straight through the C functions.

#include "flyball/governors/plugin_abi.h"

#include <stdexcept>

namespace {

void* create(const FlyballHost* /*host*/, const FlyballStart* start) {
  static int state = 0;
  if (start->parameters[0] == 1.0) {
    throw std::runtime_error{"no licence"};
  }
  return &state;
}

void destroy(void* /*policy*/) {}

std::int32_t decide(void* /*policy*/, const FlyballObservation* seen, FlyballDecision* decision) {
  if (seen->speed_m_s > 3.0) {
    throw std::runtime_error{"too fast for me"};
  }
  if (seen->speed_m_s > 2.0) {
    throw 7;  // NOLINT(hicpp-exception-baseclass): the point
  }
  decision->wish_count = 0;
  return 0;
}

const FlyballParameter at_start{
    sizeof(FlyballParameter), 0, "at_start", "1: throws when started.", 0.0, 0.0, 1.0};
const FlyballParameter* const parameters[] = {&at_start};

const FlyballPolicy thrower{sizeof(FlyballPolicy),
                            flyball_abi_version,
                            "thrower",
                            "Throws",
                            parameters,
                            1,
                            0,
                            create,
                            destroy,
                            decide,
                            nullptr};

}  // namespace

const FlyballPolicy* flyball_policy() {
  return &thrower;
}
