// SPDX-License-Identifier: BSD-3-Clause
#include "counting_malloc.h"
#include "governed_loop.h"

#include <gtest/gtest.h>

namespace flyball::kit {
namespace {

/// One frame with everything that a caller may call.
void run_frame(FlyballGovernor* governor, int frame) {
  const double now_s = 0.1 * frame;
  const double cells = 1000.0 + frame;
  flyball_governor_observe(governor, "phase", flyball_governor_cruise);
  flyball_governor_observe(governor, "obstacle_density", frame / 50 % 2 == 0 ? 0.0 : 0.5);
  flyball_governor_begin(governor, 0, now_s);
  flyball_governor_end(governor, 0, now_s + 0.01 * (frame % 9), &cells, 1);
  flyball_governor_begin(governor, 1, now_s + 0.08);
  flyball_governor_end(governor, 1, now_s + 0.09, nullptr, 0);
  FlyballGovernorDecision decision{};
  decision.struct_size = sizeof decision;
  flyball_governor_decide(governor, now_s + 0.09, &decision);
}

struct Choice {
  const char* policy;
  const char* parameters;
};

class NoAllocation : public testing::TestWithParam<Choice> {};

TEST_P(NoAllocation, happens_once_the_governor_is_open) {
  GovernedLoop loop;
  FlyballGovernorStage mapping = GovernedLoop::stage("mapping");
  const char* const work[] = {"cells"};
  mapping.work = work;
  mapping.work_count = 1;
  loop.add(mapping);
  loop.add(GovernedLoop::stage("planning"));
  FlyballGovernorKnob cells = loop.cell_knob();
  static int applied = 0;
  applied = 0;
  cells.apply = [](void*, double) -> std::int32_t {
    ++applied;
    return 0;
  };
  loop.add(cells);
  loop.add(loop.clock_knob());
  FlyballGovernorSettings settings = loop.settings(GetParam().policy);
  static std::size_t bytes = 0;
  settings.parameters = GetParam().parameters;
  settings.record = [](void*, const char* line) { bytes += *line != '\0' ? 1U : 0U; };
  ASSERT_EQ(flyball_governor_ok, loop.open(settings)) << loop.error();
  const std::size_t before = allocation_count();
  for (int frame = 0; frame < 1000; ++frame) {
    run_frame(loop.governor, frame);
  }
  // A caller's mistakes and a fallback cost nothing either.
  flyball_governor_observe(loop.governor, "nonsense", 1.0);
  flyball_governor_observe(loop.governor, "speed_m_s", -1.0);
  flyball_governor_decide(loop.governor, 200.0, nullptr);
  flyball_governor_granted(loop.governor, "cpu.frequency_hz", 0.7e9);
  FlyballGovernorEntry entry{};
  entry.struct_size = sizeof entry;
  for (std::uint32_t i = 0; i < 40; ++i) {
    flyball_governor_list(loop.governor, i, &entry);
  }
  EXPECT_EQ(before, allocation_count());
  EXPECT_LE(1001U, bytes);
}

INSTANTIATE_TEST_SUITE_P(EmbeddedGovernor,
                         NoAllocation,
                         testing::Values(Choice{"density", nullptr},
                                         Choice{"cycle", "period_s = 2"},
                                         Choice{"ondemand", "sampling_period_s = 0.01"},
                                         Choice{"schedutil", "sampling_period_s = 0.01"}));

TEST(CountingMalloc, counts_what_the_library_allocates) {
  GovernedLoop loop;
  const std::size_t before = allocation_count();
  loop.add(loop.cell_knob());
  EXPECT_LT(before, allocation_count());
}

}  // namespace
}  // namespace flyball::kit
