// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/node_meter.h"

#include "computer_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

TEST(NodeMeter, tells_what_the_jobs_of_each_node_took) {
  ComputerRig rig;
  const int a = rig.add({100.0});
  const int b = rig.add({30.0});
  rig.start(1);
  NodeMeter meter;
  meter.connect(*rig.computer);
  EXPECT_EQ(meter.of(b).busy_core_s, 0.0);
  rig.trigger(a, 0.0);
  rig.trigger(b, 0.0);
  rig.run();
  // Both have half a core until b ends at 60 ms; a has it alone until 130 ms.
  EXPECT_NEAR(meter.of(a).busy_core_s, 0.100, 1e-9);
  EXPECT_NEAR(to_seconds(meter.of(a).latency), 0.130, 1e-6);
  EXPECT_NEAR(meter.of(b).busy_core_s, 0.030, 1e-9);
  EXPECT_NEAR(to_seconds(meter.of(b).latency), 0.060, 1e-6);
  const double ghz = rig.of(b).clock.value() * 1e-9;
  EXPECT_NEAR(meter.of(b).gigacycles, 0.030 * ghz, 1e-9);
  rig.trigger(b, 200.0);
  rig.run();
  EXPECT_NEAR(meter.of(b).busy_core_s, 0.060, 1e-9);
  EXPECT_NEAR(to_seconds(meter.of(b).latency), 0.030, 1e-6);
}

}  // namespace
}  // namespace flyball
