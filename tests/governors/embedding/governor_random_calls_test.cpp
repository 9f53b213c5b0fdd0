// SPDX-License-Identifier: BSD-3-Clause
//
// Calls in any order with any numbers: each has a code, a refusal has a sentence, and what is
// decided is legal.
#include "governed_loop.h"
#include <algorithm>
#include <iterator>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace flyball::kit {
namespace {

class RandomCaller {
 public:
  explicit RandomCaller(unsigned seed) : random_{seed} {
    static const char* const work[] = {"cells", "rays"};
    mapping_.work = work;
    mapping_.work_count = 2;
    mapping_.deadline_s = 0.2;
  }

  void call() {
    FlyballGovernor* governor = loop_.governor;
    const double counts[] = {number(), number()};
    switch (drawn() % 12) {
      case 0:
        return expect(loop_.add(drawn() % 2 == 0 ? loop_.cell_knob() : loop_.clock_knob()));
      case 1:
        return expect(loop_.add(drawn() % 2 == 0 ? mapping_ : GovernedLoop::stage("planning")));
      case 2:
        return expect(loop_.open(settings()));
      case 3:
      case 4:
        return expect(flyball_governor_begin(governor, drawn() % 3, time()));
      case 5:
      case 6:
        return expect(flyball_governor_end(governor, drawn() % 3, time(), counts, drawn() % 3));
      case 7:
        return expect(flyball_governor_granted(governor, "map.resolution_m", number()));
      case 8:
        return expect(loop_.observe("phase", drawn() % 5));
      case 9:
        return observe();
      default:
        return decide();
    }
  }
  [[nodiscard]] int decisions() const { return decisions_; }

 private:
  std::uint32_t drawn() { return static_cast<std::uint32_t>(random_()); }
  /// Mostly what can be, sometimes what cannot.
  double number() {
    constexpr double odd[] = {std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity(),
                              -1.0,
                              1e300,
                              -1e19,
                              std::numeric_limits<double>::denorm_min(),
                              9.3e9};
    const std::uint32_t draw = drawn();
    return draw % 16 == 0 ? odd[draw / 16 % std::size(odd)] : 1e-3 * (draw % 3000);
  }
  double time() {
    const std::uint32_t draw = drawn();
    now_s_ += 0.001 * (draw % 200);
    return draw % 32 == 0 ? number() : now_s_;
  }
  FlyballGovernorSettings settings() {
    FlyballGovernorSettings all = loop_.settings(drawn() % 4 == 0 ? "nonsense" : "density");
    all.parameters = drawn() % 4 == 0 ? "coarse_m = no" : nullptr;
    all.first_latency_s = number();
    all.reaction_s = number();
    return all;
  }
  void observe() {
    FlyballGovernorEntry entry{};
    entry.struct_size = sizeof entry;
    expect(flyball_governor_list(loop_.governor, drawn() % 40, &entry));
    if (entry.name != nullptr) {
      expect(loop_.observe(entry.name, number()));
    }
  }
  void decide() {
    loop_.refusal = drawn() % 8 == 0 ? 1 : 0;
    const FlyballGovernorDecision decision = loop_.decide(time());
    expect(loop_.code);
    if (loop_.code != flyball_governor_ok) {
      return;
    }
    ++decisions_;
    EXPECT_STRNE("", decision.reason);
    EXPECT_TRUE(decision.latency_bound_s >= 0.0);
    EXPECT_TRUE(decision.safe_speed_m_s >= 0.0);
    const auto all = loop_.list();
    for (const char* name : {"map.resolution_m", "cpu.frequency_hz"}) {
      if (const auto knob = all.find(name); knob != all.end()) {
        const double* end = knob->second.legal + knob->second.legal_count;
        for (std::uint32_t i = 0; i < decision.knob_count; ++i) {
          is_legal_ += std::find(knob->second.legal, end, decision.decided[i]) != end ? 1U : 0U;
        }
      }
    }
    EXPECT_EQ(decision.knob_count, is_legal_) << "each value is legal for one of the knobs";
    is_legal_ = 0;
  }
  void expect(std::int32_t code) {
    ASSERT_LE(flyball_governor_ok, code);
    ASSERT_GE(flyball_governor_unavailable, code);
    if (code != flyball_governor_ok) {
      ASSERT_STRNE("", flyball_governor_last_error(loop_.governor));
    }
  }

  std::mt19937 random_;
  GovernedLoop loop_;
  FlyballGovernorStage mapping_{GovernedLoop::stage("mapping")};
  double now_s_{};
  int decisions_{};
  std::uint32_t is_legal_{};
};

TEST(RandomCalls, never_break_a_governor) {
  int decisions = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    RandomCaller caller{seed};
    for (int i = 0; i < 500; ++i) {
      caller.call();
    }
    decisions += caller.decisions();
  }
  EXPECT_LT(1000, decisions);
}

}  // namespace
}  // namespace flyball::kit
