// SPDX-License-Identifier: BSD-3-Clause
#include "governed_loop.h"
#include <cmath>

#include <gtest/gtest.h>

namespace flyball::kit {
namespace {

constexpr std::uint32_t mapping = 0;
constexpr std::uint32_t planning = 1;

class GovernorStages : public testing::Test {
 protected:
  GovernorStages() {
    loop_.add(loop_.cell_knob());
    loop_.add(GovernedLoop::stage("mapping"));
    loop_.add(GovernedLoop::stage("planning"));
  }
  void open() {
    ASSERT_EQ(flyball_governor_ok, loop_.open(loop_.settings("density"))) << loop_.error();
    loop_.observe("phase", flyball_governor_cruise);
  }
  void run(std::uint32_t stage, double begin_s, double end_s) {
    ASSERT_EQ(flyball_governor_ok, flyball_governor_begin(loop_.governor, stage, begin_s))
        << loop_.error();
    ASSERT_EQ(flyball_governor_ok, flyball_governor_end(loop_.governor, stage, end_s, nullptr, 0))
        << loop_.error();
  }
  GovernedLoop loop_;
};

TEST_F(GovernorStages, tell_the_latency_from_the_first_to_the_last) {
  open();
  run(mapping, 1.0, 1.2);
  run(planning, 1.25, 1.3);
  loop_.decide(1.5);
  EXPECT_NEAR(0.3, loop_.signal("latency_s"), 1e-9);
  EXPECT_NEAR(0.33, loop_.signal("latency_bound_s"), 1e-9);
  EXPECT_NEAR(0.5, loop_.signal("map_age_s"), 1e-9);
  EXPECT_EQ(1.0, loop_.signal("map_revision"));
  EXPECT_NEAR(0.2, loop_.signal("mapping.duration_s"), 1e-9);
}

TEST(GovernorStageSignals, tell_policies_of_stages_whose_names_they_know) {
  GovernedLoop loop;
  loop.add(loop.cell_knob());
  loop.add(loop.clock_knob());
  loop.add(GovernedLoop::stage("map"));
  loop.add(GovernedLoop::stage("other"));
  ASSERT_EQ(flyball_governor_ok, loop.open(loop.settings("density"))) << loop.error();
  flyball_governor_begin(loop.governor, 0, 1.0);
  flyball_governor_end(loop.governor, 0, 1.2, nullptr, 0);
  loop.decide(2.0);
  EXPECT_NEAR(0.2, loop.signal("map_job_s"), 1e-9);
  EXPECT_NEAR(0.2, loop.signal("map_load"), 1e-9);
  EXPECT_NEAR(0.2, loop.signal("map_gigacycles"), 1e-9) << "at 1 GHz";
  EXPECT_EQ(0.0, loop.signal("plan_job_s"));
}

TEST_F(GovernorStages, bound_latency_by_the_worst_of_twenty_frames_and_a_tenth) {
  open();
  double t_s = 0.0;
  const auto frame = [&](double latency_s) {
    run(mapping, t_s, t_s + 0.5 * latency_s);
    run(planning, t_s + 0.5 * latency_s, t_s + latency_s);
    t_s += 1.0;
  };
  frame(0.5);
  for (int i = 0; i < 19; ++i) {
    frame(0.1);
    ASSERT_NEAR(0.55, loop_.decide(t_s).latency_bound_s, 1e-9);
  }
  frame(0.1);
  EXPECT_NEAR(0.11, loop_.decide(t_s).latency_bound_s, 1e-9);
}

TEST_F(GovernorStages, limit_speed_by_the_rule_of_the_guard) {
  open();
  run(mapping, 0.0, 0.2);
  run(planning, 0.2, 0.4);
  EXPECT_EQ(0.0, loop_.decide(0.4).safe_speed_m_s) << "nobody knows what is free";
  loop_.observe("known_free_m", 8.0);
  EXPECT_EQ(0.0, loop_.decide(0.4).safe_speed_m_s) << "nobody knows how it brakes";
  loop_.observe("max_deceleration_m_s2", 5.0);
  const double speed_m_s = loop_.decide(0.4).safe_speed_m_s;
  // Reaction, then braking, take just the distance; .14 s are the guard's own.
  const double reaction_s = 0.44 + 0.14;
  EXPECT_NEAR(8.0, speed_m_s * reaction_s + speed_m_s * speed_m_s / (2.0 * 5.0), 1e-6);
}

TEST_F(GovernorStages, limit_speed_with_the_callers_own_reaction_time) {
  FlyballGovernorSettings settings = loop_.settings("density");
  settings.first_latency_s = 0.5;
  settings.reaction_s = 0.3;
  ASSERT_EQ(flyball_governor_ok, loop_.open(settings));
  loop_.observe("phase", flyball_governor_cruise);
  loop_.observe("known_free_m", 8.0);
  loop_.observe("max_deceleration_m_s2", 5.0);
  const double speed_m_s = loop_.decide(0.0).safe_speed_m_s;
  EXPECT_NEAR(8.0, speed_m_s * 0.8 + speed_m_s * speed_m_s / 10.0, 1e-6);
}

TEST_F(GovernorStages, limit_speed_by_the_callers_own_bound) {
  open();
  run(mapping, 0.0, 0.5);
  run(planning, 0.5, 2.0);  // The window says 2.2 s.
  loop_.observe("latency_bound_s", 10.0);
  loop_.observe("known_free_m", 20.0);
  loop_.observe("max_deceleration_m_s2", 5.0);
  const FlyballGovernorDecision decision = loop_.decide(2.0);
  EXPECT_EQ(10.0, decision.latency_bound_s);
  const double speed_m_s = decision.safe_speed_m_s;
  EXPECT_NEAR(20.0, speed_m_s * 10.14 + speed_m_s * speed_m_s / (2.0 * 5.0), 1e-6);
}

TEST_F(GovernorStages, widen_the_callers_own_bound_too) {
  open();
  loop_.observe("latency_bound_s", 0.1);
  for (int i = 0; i < 2; ++i) {
    loop_.decide(2.0 * i);
    run(mapping, 2.0 * i, 2.0 * i + 0.5);
    run(planning, 2.0 * i + 0.5, 2.0 * i + 1.0);
  }
  const FlyballGovernorDecision decision = loop_.decide(4.0);
  EXPECT_STREQ("wide_bound", decision.fallback);
  EXPECT_NEAR(0.15, decision.latency_bound_s, 2e-9);  // Nanoseconds, rounded up.
}

TEST_F(GovernorStages, widen_the_bound_when_frames_come_late_again_and_again) {
  open();
  const auto frame = [this](double begin_s, double latency_s) {
    run(mapping, begin_s, begin_s + latency_s);
    run(planning, begin_s + latency_s, begin_s + latency_s);
    return loop_.decide(begin_s + 1.0);
  };
  frame(0.0, 0.1);
  EXPECT_STREQ("none", frame(1.0, 0.2).fallback);  // Late: it was bounded by .11 s.
  EXPECT_STREQ("none", frame(2.0, 0.1).fallback);
  const FlyballGovernorDecision decision = frame(3.0, 0.5);
  EXPECT_STREQ("wide_bound", decision.fallback);
  EXPECT_NEAR(1.5 * 0.55, decision.latency_bound_s, 1e-6);
}

TEST_F(GovernorStages, hand_on_the_frame_that_they_worked_on_as_in_a_pipeline) {
  open();
  const auto begin = [this](std::uint32_t stage, double now_s) {
    ASSERT_EQ(flyball_governor_ok, flyball_governor_begin(loop_.governor, stage, now_s));
  };
  const auto end = [this](std::uint32_t stage, double now_s) {
    ASSERT_EQ(flyball_governor_ok, flyball_governor_end(loop_.governor, stage, now_s, nullptr, 0));
  };
  begin(mapping, 0.0);
  end(mapping, 0.3);
  begin(planning, 0.3);
  begin(mapping, 0.3);  // The next frame, beside it.
  end(planning, 0.5);   // Of the first frame.
  loop_.decide(0.5);
  EXPECT_NEAR(0.5, loop_.signal("latency_s"), 1e-9);
  end(mapping, 0.6);
  begin(planning, 0.7);
  end(planning, 0.8);
  loop_.decide(0.8);
  EXPECT_NEAR(0.5, loop_.signal("latency_s"), 1e-9) << "captured at .3 s";
  EXPECT_EQ(2.0, loop_.signal("map_revision"));
}

TEST_F(GovernorStages, count_no_frame_twice_and_none_without_input) {
  open();
  run(planning, 0.0, 0.1);  // There is no map yet.
  run(mapping, 0.2, 0.3);
  run(planning, 0.3, 0.4);
  run(planning, 0.5, 0.6);  // The same map again.
  loop_.decide(1.0);
  EXPECT_EQ(1.0, loop_.signal("map_revision"));
  EXPECT_NEAR(0.2, loop_.signal("latency_s"), 1e-9);
}

TEST_F(GovernorStages, give_up_a_frame_whose_stage_begins_again) {
  open();
  flyball_governor_begin(loop_.governor, mapping, 0.0);
  run(mapping, 1.0, 1.1);
  run(planning, 1.1, 1.2);
  loop_.decide(1.2);
  EXPECT_NEAR(0.2, loop_.signal("latency_s"), 1e-9);
}

TEST_F(GovernorStages, tell_the_load_of_cores) {
  FlyballGovernorStage detecting = GovernedLoop::stage("detecting");
  detecting.is_beside = 1;
  detecting.thread = 7;
  ASSERT_EQ(flyball_governor_ok, loop_.add(detecting));
  open();
  flyball_governor_begin(loop_.governor, 2, 0.0);
  run(mapping, 0.0, 0.4);
  run(planning, 0.4, 0.6);
  loop_.decide(1.0);
  EXPECT_NEAR(1.6, loop_.signal("busy_cores"), 1e-9) << "one stage has not ended yet";
  EXPECT_NEAR(1.0, loop_.signal("busiest_core_load"), 1e-9);
  flyball_governor_end(loop_.governor, 2, 1.25, nullptr, 0);
  run(mapping, 1.5, 1.9);
  run(planning, 1.9, 2.0);
  loop_.decide(2.0);
  EXPECT_NEAR(0.75, loop_.signal("busy_cores"), 1e-9);
  EXPECT_NEAR(0.5, loop_.signal("busiest_core_load"), 1e-9);
  EXPECT_NEAR(0.5, loop_.signal("latency_s"), 1e-9) << "what is beside adds nothing";
}

TEST(GovernorStageSignals, count_a_job_when_it_ends_and_as_a_whole) {
  GovernedLoop loop;
  loop.add(loop.cell_knob());
  loop.add(GovernedLoop::stage("explore"));
  ASSERT_EQ(flyball_governor_ok, loop.open(loop.settings("density"))) << loop.error();
  flyball_governor_begin(loop.governor, 0, 0.0);
  flyball_governor_end(loop.governor, 0, 0.25, nullptr, 0);
  loop.decide(0.5);
  EXPECT_NEAR(0.5, loop.signal("explore_load"), 1e-9);
  flyball_governor_begin(loop.governor, 0, 0.5);
  loop.decide(1.0);
  EXPECT_EQ(0.0, loop.signal("explore_load")) << "this search has not ended";
  EXPECT_NEAR(1.0, loop.signal("busy_cores"), 1e-9) << "though it keeps a core busy";
  flyball_governor_end(loop.governor, 0, 1.5, nullptr, 0);
  loop.decide(1.5);
  EXPECT_NEAR(2.0, loop.signal("explore_load"), 1e-9);
}

TEST_F(GovernorStages, miss_their_deadlines) {
  FlyballGovernorStage one = GovernedLoop::stage("tracking");
  one.deadline_s = 0.1;
  loop_.add(one);
  open();
  for (int i = 0; i < 8; ++i) {
    run(2, 0.2 * i, 0.2 * i + (i < 6 ? 0.11 : 0.1));
  }
  EXPECT_STREQ("hover", loop_.decide(1.6).fallback);
}

TEST_F(GovernorStages, that_hang_miss_their_deadline_once_and_take_the_speed_away) {
  FlyballGovernorStage acting = GovernedLoop::stage("acting");
  acting.deadline_s = 0.2;
  loop_.add(acting);
  open();
  loop_.observe("known_free_m", 20.0);
  loop_.observe("max_deceleration_m_s2", 5.0);
  run(mapping, 0.0, 0.1);
  run(planning, 0.1, 0.2);
  run(2, 0.2, 0.3);
  const double usual_m_s = loop_.decide(0.3).safe_speed_m_s;
  run(mapping, 1.0, 1.1);
  run(planning, 1.1, 1.2);
  flyball_governor_begin(loop_.governor, 2, 1.2);
  EXPECT_EQ(usual_m_s, loop_.decide(1.3).safe_speed_m_s) << "no older than bounded";
  double misses = 0.0;
  double speed_m_s = usual_m_s;
  for (int i = 1; i <= 60; ++i) {
    const double slower_m_s = loop_.decide(1.3 + i).safe_speed_m_s;
    EXPECT_LT(slower_m_s, speed_m_s) << i << " s";
    speed_m_s = slower_m_s;
    misses += loop_.lines.back().find(" deadline_misses=1 ") != std::string::npos ? 1.0 : 0.0;
  }
  const double age_s = 60.3 + 0.14;  // Captured at 1 s; the guard's own reaction.
  EXPECT_NEAR(20.0, speed_m_s * age_s + speed_m_s * speed_m_s / (2.0 * 5.0), 1e-6);
  EXPECT_EQ(1.0, misses);
  flyball_governor_end(loop_.governor, 2, 62.0, nullptr, 0);
  loop_.decide(62.0);
  EXPECT_EQ(std::string::npos, loop_.lines.back().find("deadline_misses")) << "it was counted";
}

TEST_F(GovernorStages, that_are_given_up_have_kept_a_core_busy_and_missed_their_deadline) {
  FlyballGovernorStage acting = GovernedLoop::stage("acting");
  acting.deadline_s = 0.2;
  loop_.add(acting);
  open();
  for (int i = 0; i < 4; ++i) {
    flyball_governor_begin(loop_.governor, 2, 0.25 * i);
  }
  loop_.decide(0.75);
  EXPECT_NEAR(1.0, loop_.signal("busiest_core_load"), 1e-9);
  EXPECT_NEAR(1.0, loop_.signal("busy_cores"), 1e-9);
  EXPECT_NE(std::string::npos, loop_.lines.back().find(" deadline_misses=3 "))
      << loop_.lines.back();
}

TEST_F(GovernorStages, count_their_work) {
  FlyballGovernorStage one = GovernedLoop::stage("tracking");
  const char* const work[] = {"features", "matches"};
  one.work = work;
  one.work_count = 2;
  loop_.add(one);
  open();
  const double counts[] = {120.0, 80.0};
  flyball_governor_begin(loop_.governor, 2, 0.0);
  EXPECT_EQ(flyball_governor_invalid_input,
            flyball_governor_end(loop_.governor, 2, 0.1, counts, 1));
  EXPECT_EQ("stage \"tracking\" counts 2 things, not 1", loop_.error());
  EXPECT_EQ(flyball_governor_ok, flyball_governor_end(loop_.governor, 2, 0.1, counts, 2));
  EXPECT_EQ(80.0, loop_.signal("tracking.matches"));
}

TEST_F(GovernorStages, are_listened_to_where_the_callers_own_latency_was_never_one) {
  open();
  EXPECT_EQ(flyball_governor_invalid_input, loop_.observe("latency_s", std::nan("")));
  EXPECT_STREQ("table", loop_.decide(0.0).fallback);
  run(mapping, 0.0, 0.1);
  run(planning, 0.1, 0.2);
  EXPECT_STREQ("none", loop_.decide(1.0).fallback);
}

TEST_F(GovernorStages, are_not_listened_to_where_the_caller_observes_latency_himself) {
  open();
  loop_.observe("latency_s", 0.7);
  run(mapping, 0.0, 0.1);
  run(planning, 0.1, 0.2);
  EXPECT_NEAR(0.77, loop_.decide(1.0).latency_bound_s, 1e-9);
  EXPECT_EQ(1.0, loop_.signal("map_revision"));
}

}  // namespace
}  // namespace flyball::kit
