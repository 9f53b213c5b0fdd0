// SPDX-License-Identifier: BSD-3-Clause
//
// The GPU beside the cores, and what cores that work at the same time cost each other.

#include "computer_rig.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// Jobs of `shader` take their milliseconds on the GPU.
PlatformModel with_gpu() {
  PlatformModel model = rig_model(0.0);
  model.gpu = GpuModel{Hertz{2e9}, 5.0};
  model.kernels["shader"] = {{{"ms", 1e-3}}, 1.0, 1.0, 0.0, 0.0, true};
  return model;
}

struct GpuRig : ComputerRig {
  GpuRig() { platform.emplace(with_gpu()); }
  void start(int cores) {
    computer = std::make_unique<VirtualExecutor>(graph, *platform, queue,
                                                 OperatingPoint{cores, Hertz{1e9}});
    computer->on_job([this](const JobRecord& record) { records.push_back(record); });
  }
  std::optional<ModeledPlatform> platform{};
};

TEST(Gpu, its_jobs_leave_the_cores_to_others) {
  GpuRig rig;
  const int shader = rig.add({40.0, 1, "shader"});
  const int serial = rig.add({30.0});
  rig.start(1);
  rig.trigger(shader, 0.0);
  rig.trigger(serial, 0.0);
  rig.run();
  EXPECT_NEAR(rig.end_ms(shader), 40.0, end_tolerance_ms);
  EXPECT_NEAR(rig.end_ms(serial), 30.0, end_tolerance_ms);
  EXPECT_NEAR(rig.computer->busy_core_s(), 30e-3, 1e-8);
  EXPECT_NEAR(rig.computer->device_use().gpu_s, 40e-3, 1e-8);
  EXPECT_EQ(rig.of(shader).busy, Duration::zero());
  EXPECT_NEAR(to_seconds(rig.of(serial).busy), 30e-3, 1e-8);
}

TEST(Gpu, a_job_that_runs_is_not_interrupted_and_the_most_urgent_one_is_next) {
  GpuRig rig;
  const int first = rig.add({40.0, 0, "shader"});
  const int late = rig.add({10.0, 1, "shader"});
  const int urgent = rig.add({10.0, 2, "shader"});
  rig.start(4);
  rig.trigger(first, 0.0);
  rig.trigger(late, 5.0);
  rig.trigger(urgent, 6.0);
  rig.run();
  EXPECT_NEAR(rig.end_ms(first), 40.0, end_tolerance_ms);
  EXPECT_NEAR(rig.end_ms(urgent), 50.0, end_tolerance_ms);
  EXPECT_NEAR(rig.end_ms(late), 60.0, end_tolerance_ms);
  EXPECT_EQ(rig.of(urgent).started, at_ms(40.0));
}

TEST(Gpu, what_follows_the_cores_clock_does_so_while_it_runs) {
  GpuRig rig;
  const int shader = rig.add({40.0, 0, "shader"});
  rig.start(1);
  rig.trigger(shader, 0.0);
  rig.set_point(20.0, 1, 2.0);
  rig.run();
  EXPECT_NEAR(rig.end_ms(shader), 30.0, end_tolerance_ms);
}

TEST(Gpu, work_that_is_charged_as_one_of_its_kernels_moves_there) {
  Graph graph{"moves"};
  const auto in = graph.topic<int>("in");
  NodeSpec spec;
  spec.name = "either";
  spec.cost = "serial";
  spec.trigger = OnMessage{in.index};
  graph.node(spec, [=](JobContext& job) {
    Work work;
    work.add("ms", 20.0);
    work.charge_as(*job.latest(in) == 1 ? "shader" : "serial");
    return work;
  });
  const ModeledPlatform platform{with_gpu()};
  EventQueue queue;
  VirtualExecutor computer{graph, platform, queue, {1, Hertz{1e9}}};
  computer.publish(in, 1);
  queue.run([] { return false; });
  EXPECT_EQ(queue.now(), at_ms(20.0));
  EXPECT_NEAR(computer.device_use().gpu_s, 20e-3, 1e-8);
  computer.publish(in, 0);
  queue.run([] { return false; });
  EXPECT_EQ(queue.now(), at_ms(40.0));
  EXPECT_NEAR(computer.device_use().gpu_s, 20e-3, 1e-8);
  EXPECT_NEAR(computer.busy_core_s(), 20e-3, 1e-8);
}

TEST(Gpu, waiting_follows_its_clock_and_the_rest_that_of_the_cores) {
  PlatformModel model = with_gpu();
  model.kernels["shader"].a = 0.6;
  model.kernels["shader"].b = 0.4;
  const ModeledPlatform platform{model};
  Work work;
  work.add("ms", 100.0);
  EXPECT_NEAR(to_seconds(platform.job_time("shader", work, Hertz{1e9})), 0.1 * (0.6 + 0.2), 1e-8);
  EXPECT_NEAR(to_seconds(platform.job_time("shader", work, Hertz{0.5e9})), 0.1 * (1.2 + 0.2), 1e-8);
  EXPECT_EQ(platform.gpu_power(), Watts{5.0});
  EXPECT_EQ(ModeledPlatform{rig_model(0.0)}.gpu_power(), Watts{0.0});
}

TEST(MemoryContention, lengthens_what_waits_for_memory_while_other_cores_work) {
  PlatformModel model = rig_model(0.0);
  model.memory_contention = 0.2;
  GpuRig rig;
  rig.platform.emplace(model);
  const int memory = rig.add({100.0, 0, "memory"});
  const int serial = rig.add({33.0});
  rig.start(2);
  rig.trigger(memory, 0.0);
  rig.trigger(serial, 0.0);
  rig.run();
  // At 1 GHz half of `memory` waits, 50 ms of 100, and takes a fifth longer while another core
  // works: 1.1 times. In 33 ms it does 30 ms of its work, and then the other 70 undisturbed.
  EXPECT_NEAR(rig.end_ms(serial), 33.0, end_tolerance_ms);
  EXPECT_NEAR(rig.end_ms(memory), 103.0, 3.0 * end_tolerance_ms);
}

TEST(MemoryContention, does_not_reach_a_kernel_that_never_waits_nor_one_that_is_alone) {
  PlatformModel model = rig_model(0.0);
  model.memory_contention = 0.2;
  const ModeledPlatform platform{model};
  EXPECT_EQ(platform.slowdown("serial", Hertz{1e9}, 3.0), 1.0);
  EXPECT_EQ(platform.slowdown("memory", Hertz{1e9}, 0.0), 1.0);
  // a / f = .25 and b = .5 at 2 GHz.
  EXPECT_NEAR(platform.slowdown("memory", Hertz{2e9}, 3.0), 1.0 + 0.5 * 0.2 * 3.0 / 0.75, 1e-12);
  EXPECT_EQ(ModeledPlatform{rig_model(0.0)}.slowdown("memory", Hertz{1e9}, 3.0), 1.0);
}

TEST(IdleCores, that_are_off_take_no_power) {
  PlatformModel model = rig_model(0.0);
  model.power = {0.6, 1.25, 0.5, 0.2, 0.15, 0.05, 0.11, 0.095};
  model.power.idle_core_w = 0.03;
  const ModeledPlatform platform{model};
  const auto watts = [&](int cores, double busy) {
    return platform.power({cores, Hertz{1e9}}, busy).value();
  };
  EXPECT_NEAR(watts(4, 0.0), 0.6 + 1.25 * (0.7 + 0.15 + 0.05), 1e-12);
  EXPECT_NEAR(watts(4, 0.0) - watts(1, 0.0), 3.0 * 1.25 * 0.03, 1e-12);
  EXPECT_NEAR(watts(4, 1.0) - watts(3, 1.0), 1.25 * 0.03, 1e-12);
  // Somebody else's work keeps cores on that the operating point leaves out.
  EXPECT_NEAR(watts(1, 4.0), watts(4, 4.0), 1e-12);
}

}  // namespace
}  // namespace flyball
