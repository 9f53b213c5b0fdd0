// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/modeled/drifting_platform.h"

#include "computer_rig.h"
#include <atomic>
#include <thread>

#include <gtest/gtest.h>

namespace flyball {
namespace {

Work ten_ms() {
  Work work;
  work.add("ms", 10.0);
  return work;
}

double cost_ms(const Platform& platform, const char* kernel, double ghz) {
  return ms(platform.job_time(kernel, ten_ms(), Hertz{ghz * 1e9}));
}

/// Some nodes on a computer that drifts; `strain` at a time.
struct DriftRig : ComputerRig {
  DriftRig() : drifting{rig_model(0.0)} {}
  void start_drifting(int cores, double ghz = 1.0) {
    computer = std::make_unique<VirtualExecutor>(graph, drifting, queue,
                                                 OperatingPoint{cores, Hertz{ghz * 1e9}});
    computer->on_job([this](const JobRecord& record) { records.push_back(record); });
  }
  void strain(double when_ms, const Strain& strain) {
    queue.schedule(at_ms(when_ms), EventOrder::sensor, [this, strain] {
      drifting.set(strain);
      computer->platform_changed();
    });
  }
  DriftingPlatform drifting;
};

TEST(DriftingPlatform, may_be_asked_while_another_thread_changes_it) {
  DriftingPlatform platform{rig_model(0.0)};
  Strain twice;
  twice.cost = 2.0;
  std::atomic<bool> is_over{false};
  int wrong = 0;
  std::thread asker{[&] {
    while (!is_over) {
      const double asked_ms = cost_ms(platform, "serial", 1.0);
      wrong += asked_ms == 10.0 || asked_ms == 20.0 ? 0 : 1;
    }
  }};
  for (int i = 0; i < 1000; ++i) {
    platform.set(i % 2 == 0 ? twice : Strain{});
  }
  is_over = true;
  asker.join();
  EXPECT_EQ(wrong, 0);
}

TEST(DriftingPlatform, without_strain_is_what_its_file_says) {
  const DriftingPlatform platform{rig_model(0.0)};
  EXPECT_DOUBLE_EQ(cost_ms(platform, "serial", 1.0), 10.0);
  EXPECT_EQ(platform.granted({4, Hertz{2e9}}), (OperatingPoint{4, Hertz{2e9}}));
  EXPECT_EQ(platform.taken_cores(), 0.0);
}

TEST(DriftingPlatform, costs_of_all_and_of_single_kernels_multiply) {
  DriftingPlatform platform{rig_model(0.0)};
  Strain strain;
  strain.cost = 3.0;
  strain.kernel_cost["serial"] = 2.0;
  platform.set(strain);
  EXPECT_DOUBLE_EQ(cost_ms(platform, "serial", 1.0), 60.0);
  EXPECT_DOUBLE_EQ(cost_ms(platform, "amdahl", 1.0), 30.0);
  platform.set({});
  EXPECT_DOUBLE_EQ(cost_ms(platform, "serial", 1.0), 10.0);
}

TEST(DriftingPlatform, less_bandwidth_slows_what_waits_for_memory_only) {
  DriftingPlatform platform{rig_model(0.0)};
  Strain strain;
  strain.memory_cost = 2.0;
  platform.set(strain);
  EXPECT_DOUBLE_EQ(cost_ms(platform, "serial", 1.0), 10.0);
  EXPECT_DOUBLE_EQ(cost_ms(platform, "memory", 1.0), 15.0) << "half of it waits, twice as long";
}

TEST(DriftingPlatform, grants_the_highest_clock_below_the_cap) {
  DriftingPlatform platform{rig_model(0.0)};
  Strain strain;
  strain.clock_cap = Hertz{1.5e9};
  platform.set(strain);
  EXPECT_EQ(platform.granted({2, Hertz{2e9}}).frequency.value(), 1e9);
  EXPECT_EQ(platform.granted({2, Hertz{0.5e9}}).frequency.value(), 0.5e9);
  strain.clock_cap = Hertz{0.1e9};
  platform.set(strain);
  EXPECT_EQ(platform.granted({2, Hertz{2e9}}).frequency.value(), 0.5e9) << "the lowest it has";
}

TEST(DriftingExecutor, a_slowdown_in_the_middle_of_a_job_slows_what_is_left) {
  DriftRig rig;
  const int a = rig.add({100.0});
  rig.start_drifting(1);
  rig.trigger(a, 0.0);
  Strain strain;
  strain.cost = 3.0;
  rig.strain(40.0, strain);
  rig.run();
  EXPECT_NEAR(rig.end_ms(a), 40.0 + 3.0 * 60.0, end_tolerance_ms);
}

TEST(DriftingExecutor, a_co_runner_takes_idle_cores_first) {
  DriftRig rig;
  const int a = rig.add({100.0});
  const int b = rig.add({100.0});
  rig.start_drifting(2);  // Of 4.
  Strain strain;
  strain.taken_cores = 2.0;
  rig.strain(0.0, strain);
  rig.trigger(a, 0.0);
  rig.trigger(b, 0.0);
  rig.run();
  EXPECT_NEAR(rig.end_ms(a), 100.0, end_tolerance_ms);
  EXPECT_NEAR(rig.end_ms(b), 100.0, end_tolerance_ms);
}

TEST(DriftingExecutor, a_co_runner_then_takes_cores_of_the_mission_but_one) {
  DriftRig rig;
  const int a = rig.add({100.0});
  const int b = rig.add({100.0});
  rig.start_drifting(2);
  Strain strain;
  strain.taken_cores = 3.0;
  rig.strain(0.0, strain);
  rig.trigger(a, 0.0);
  rig.trigger(b, 0.0);
  rig.run();
  EXPECT_NEAR(rig.end_ms(b), 200.0, end_tolerance_ms) << "one core for both";
}

TEST(DriftingExecutor, the_load_counts_what_the_co_runner_keeps_busy_while_it_does) {
  DriftRig rig;
  const int a = rig.add({100.0});
  rig.start_drifting(4);
  rig.trigger(a, 0.0);
  Strain strain;
  strain.taken_cores = 2.0;
  rig.strain(200.0, strain);
  rig.strain(300.0, {});
  rig.run();
  EXPECT_NEAR(rig.computer->busy_core_s(), 0.1 + 2.0 * 0.1, 1e-9);
}

TEST(DriftingExecutor, what_was_requested_comes_back_when_the_cap_goes) {
  DriftRig rig;
  const int a = rig.add({100.0});
  rig.start_drifting(1, 2.0);
  rig.trigger(a, 0.0);
  Strain strain;
  strain.clock_cap = Hertz{1e9};
  rig.strain(10.0, strain);  // 20 of 100 ms are done.
  rig.strain(50.0, {});      // 40 more.
  rig.run();
  EXPECT_NEAR(rig.end_ms(a), 50.0 + 20.0, end_tolerance_ms);
  EXPECT_EQ(rig.computer->operating_point().frequency.value(), 2e9);
}

TEST(DriftingExecutor, a_wish_above_the_cap_is_granted_as_far_as_it_goes) {
  DriftRig rig;
  rig.add({1.0});
  rig.start_drifting(1, 0.5);
  Strain strain;
  strain.clock_cap = Hertz{1e9};
  rig.strain(0.0, strain);
  rig.set_point(5.0, 1, 2.0);
  rig.run();
  EXPECT_EQ(rig.computer->operating_point().frequency.value(), 1e9);
}

}  // namespace
}  // namespace flyball
