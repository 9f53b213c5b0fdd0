// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/latency_bound.h"

#include "flyball/governors/learned_latency.h"
#include "flyball/runtime/random.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace flyball {
namespace {

using namespace std::chrono_literals;

constexpr double most = 2.0;  // B: e is never larger.

MissionTime at_s(double s) {
  return MissionTime{from_seconds(s)};
}

/// Counts T decisions whose error an opponent chooses when it sees q, and returns the mean miss.
double mean_miss(QuantileTracker& tracker, int count, const std::function<double(double)>& error) {
  int misses = 0;
  for (int t = 0; t < count; ++t) {
    const bool missed = error(tracker.q()) > tracker.q();
    misses += missed ? 1 : 0;
    tracker.count(missed);
  }
  return static_cast<double>(misses) / count;
}

/// alpha + (B + eta - q_1) / (eta T), eq. (3) of the header.
double guaranteed(const QuantileTracker::Settings& s, int count) {
  return s.alpha + (most + s.eta - s.first) / (s.eta * count);
}

TEST(QuantileTracker, mean_miss_is_the_identity_that_it_telescopes_to) {
  const QuantileTracker::Settings settings{0.1, 0.03, 0.4};
  QuantileTracker tracker{settings};
  RandomStream draw{5, "bound"};
  const double mean = mean_miss(tracker, 777, [&](double) { return draw.uniform(-1.0, most); });
  EXPECT_NEAR(mean, settings.alpha + (tracker.q() - settings.first) / (settings.eta * 777), 1e-12);
}

TEST(QuantileTracker, keeps_its_guarantee_against_every_opponent) {
  const QuantileTracker::Settings settings{0.05, 0.05, 0.2};
  RandomStream draw{6, "bound"};
  int turn = 0;
  const std::vector<std::function<double(double)>> opponents{
      [](double) { return most; },                                        // always the worst
      [](double q) { return q < most ? q + 1e-9 : -9.0; },                // a miss whenever it can
      [&](double) { return ++turn % 400 < 200 ? -9.0 : most; },           // lulls, then strikes
      [&](double) { return draw.uniform() < 0.5 ? most : -most; },        // a coin
      [&](double q) { return draw.uniform() < 0.5 ? q - 1e-9 : most; }};  // half just fits
  for (std::size_t i = 0; i < opponents.size(); ++i) {
    for (const int count : {1, 10, 100, 1000, 10000}) {
      QuantileTracker tracker{settings};
      EXPECT_LE(mean_miss(tracker, count, opponents[i]), guaranteed(settings, count) + 1e-12)
          << "opponent " << i << ", T = " << count;
      EXPECT_LE(tracker.q(), most + settings.eta) << "opponent " << i;
    }
  }
}

TEST(QuantileTracker, states_how_many_misses_it_may_come_to) {
  const QuantileTracker::Settings settings{0.05, 0.05, 0.2};
  QuantileTracker tracker{settings};
  (void)mean_miss(tracker, 300, [](double q) { return q < most ? q + 1e-9 : -9.0; });
  const double stated = *tracker.most_misses(std::exp(most));
  EXPECT_NEAR(stated, 300 * guaranteed(settings, 300), 1e-9);
  EXPECT_LE(static_cast<double>(tracker.misses()), stated);
  const QuantileTracker wide{{0.05, 0.05, 5.0}};  // Beyond any error: a step of slack is left.
  EXPECT_NEAR(*wide.most_misses(std::exp(most)), 1.0, 1e-9);
  EXPECT_FALSE(QuantileTracker({0.05, 0.0, 0.2}).most_misses(2.0)) << "a constant margin";
}

TEST(QuantileTracker, the_guarantee_is_nearly_reached_so_it_is_not_empty) {
  const QuantileTracker::Settings settings{0.05, 0.05, 0.2};
  QuantileTracker tracker{settings};
  const double mean = mean_miss(tracker, 100, [](double) { return most; });
  EXPECT_GT(mean, guaranteed(settings, 100) - 0.02);
}

TEST(QuantileTracker, finds_the_quantile_of_what_does_not_change) {
  QuantileTracker tracker{{0.1, 0.01, 0.0}};
  RandomStream draw{7, "bound"};
  for (int t = 0; t < 20000; ++t) {
    tracker.count(draw.uniform() > tracker.q());
  }
  // Stationary standard deviation sqrt(eta alpha (1 - alpha) / 2): .02; five of them.
  EXPECT_NEAR(tracker.q(), 0.9, 0.1);
  EXPECT_NEAR(static_cast<double>(tracker.misses()) / 20000.0, 0.1, 0.01);
}

/// Misses of levels that a flight uses for 50 maps each, over 200 flights.
double misses_of_short_levels(const std::function<double(RandomStream&)>& error) {
  RandomStream draw{10, "bound"};
  std::uint64_t misses = 0;
  for (int flight = 0; flight < 200; ++flight) {
    QuantileTracker tracker{LearnedLatencySettings{}.bound};
    (void)mean_miss(tracker, 50, [&](double) { return error(draw); });
    misses += tracker.misses();
  }
  return static_cast<double>(misses) / (200.0 * 50.0);
}

// Quantiles of recorded errors: 95 % of them are below .2 to .4.
TEST(QuantileTracker, a_level_that_is_seldom_used_keeps_the_share_too) {
  EXPECT_LE(misses_of_short_levels([](RandomStream& draw) { return 0.15 * draw.normal(); }), 0.05);
  EXPECT_LE(misses_of_short_levels([](RandomStream& draw) {
              return 0.05 * draw.normal() + (draw.uniform() < 0.1 ? draw.uniform(0.0, 1.0) : 0.0);
            }),
            0.07)
      << "heavy tail";
  double scene = 0.0;
  EXPECT_LE(misses_of_short_levels([&](RandomStream& draw) {
              // A change of scene every 25 maps, which the prediction follows with a gain of .1.
              scene = draw.uniform() < 0.04 ? 0.5 * draw.normal() : 0.9 * scene;
              return scene + 0.06 * draw.normal();
            }),
            0.07)
      << "drift";
}

TEST(LatencyBound, multiplies_the_prediction_by_the_margin_of_the_level) {
  LatencyBound bound{2, {0.05, 0.05, 0.2}};
  bound.issue(1, at_s(0.0), 100ms);
  bound.settle(at_s(5.0));
  EXPECT_NEAR(to_seconds(bound.bound(0, 100ms)), 0.1 * std::exp(0.2), 1e-8);
  EXPECT_NEAR(to_seconds(bound.bound(1, 100ms)), 0.1 * std::exp(0.2 + 0.05 * 0.95), 1e-8);
}

TEST(LatencyBound, counts_each_issued_decision_exactly_once) {
  LatencyBound bound{1, {0.05, 0.05, std::log(1.5)}};
  bound.issue(0, at_s(0.0), 100ms);
  bound.settle(at_s(0.12));
  bound.settle(at_s(0.9));  // told twice
  bound.issue(0, at_s(1.0), 100ms);
  bound.expire(at_s(1.3));  // declared here
  bound.settle(at_s(1.4));
  bound.issue(0, at_s(2.0), 100ms);
  bound.settle(at_s(2.9));  // late, and nobody looked before
  EXPECT_EQ(bound.tracker(0).decisions(), 3U);
  EXPECT_EQ(bound.tracker(0).misses(), 2U);
}

TEST(LatencyBound, a_killed_job_is_a_miss_when_its_bound_expires) {
  LatencyBound bound{1, {0.05, 0.05, 0.0}};
  bound.issue(0, at_s(0.0), 100ms);
  bound.expire(at_s(0.09));
  EXPECT_EQ(bound.tracker(0).decisions(), 0U);
  bound.expire(at_s(0.11));
  EXPECT_EQ(bound.tracker(0).misses(), 1U);
}

TEST(LatencyBound, the_next_decision_supersedes_one_that_is_open) {
  LatencyBound bound{1, {0.05, 0.05, 0.0}};
  bound.issue(0, at_s(0.0), 10s);
  bound.issue(0, at_s(0.1), 10s);
  EXPECT_EQ(bound.tracker(0).misses(), 1U);
  bound.settle(at_s(0.3));
  EXPECT_EQ(bound.tracker(0).decisions(), 2U);
  EXPECT_EQ(bound.tracker(0).misses(), 1U);
}

TEST(LatencyBound, moves_with_the_clock_that_was_granted) {
  LatencyBound bound{1, {0.05, 0.05, 0.0}};
  bound.issue(0, at_s(0.0), 100ms);
  bound.regrant(2.5);  // at 40 % of the clock
  bound.settle(at_s(0.24));
  EXPECT_EQ(bound.tracker(0).misses(), 0U);
  EXPECT_EQ(bound.tracker(0).decisions(), 1U);
}

TEST(LatencyBound, a_change_of_setting_leaves_the_longer_bound_at_its_own_level) {
  LatencyBound bound{2, {0.05, 0.05, 0.0}};
  bound.issue(0, at_s(0.0), 100ms);
  bound.widen(1, 300ms);
  bound.settle(at_s(0.2));
  EXPECT_EQ(bound.tracker(0).decisions(), 0U);
  EXPECT_EQ(bound.tracker(1).decisions(), 1U);
  EXPECT_EQ(bound.tracker(1).misses(), 0U);
  bound.issue(0, at_s(1.0), 100ms);
  bound.widen(1, 50ms);
  bound.settle(at_s(1.09));
  EXPECT_EQ(bound.tracker(0).decisions(), 1U);
  EXPECT_EQ(bound.tracker(0).misses(), 0U);
}

TEST(LatencyBound, levels_learn_apart) {
  LatencyBound bound{2, {0.05, 0.05, 0.0}};
  bound.issue(1, at_s(0.0), 100ms);
  bound.settle(at_s(5.0));
  EXPECT_EQ(bound.tracker(0).q(), 0.0);
  EXPECT_GT(bound.tracker(1).q(), 0.0);
}

TEST(LatencyBound, follows_a_computer_that_becomes_three_times_slower) {
  LatencyBound bound{1, {0.05, 0.1, 0.2}};
  RandomStream draw{9, "bound"};
  std::uint64_t misses_before = 0;
  for (int i = 0; i < 1000; ++i) {
    const double slow = i < 500 ? 1.0 : 3.0;
    bound.issue(0, at_s(10.0 * i), 100ms);
    bound.settle(at_s(10.0 * i + 0.1 * slow * std::exp(0.1 * draw.normal())));
    misses_before = i == 549 ? bound.tracker(0).misses() : misses_before;
  }
  // Over the 450 decisions that begin 50 after the change: at most twice alpha.
  EXPECT_LE(static_cast<double>(bound.tracker(0).misses() - misses_before) / 450.0, 0.1);
}

}  // namespace
}  // namespace flyball
