// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/latency_model.h"

#include "flyball/runtime/random.h"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr ClockScaling scaling{0.9, 0.05};

LatencyFeatures drawn(RandomStream& draw) {
  LatencyFeatures at;
  at.size = draw.uniform(5e3, 4e4);
  at.clock = Hertz{draw.uniform(0.35e9, 2.04e9)};
  return at;
}

// Nearly in proportion to the points; the prior's clock is right.
double frame_s(const LatencyFeatures& at) {
  return 2e-6 * std::pow(at.size, 0.8) * scaling.factor(at.clock);
}

double predicted_s(const LatencyModel& model, const LatencyFeatures& at) {
  return std::exp(model.predict_log_s(at));
}

LatencyPrior prior() {
  LatencyPrior known;
  known.seconds = 1e-5;  // wrong by a factor of about 50
  known.clock = scaling;
  known.sigma = 3.0;
  return known;
}

TEST(RecursiveLeastSquares, equals_the_batch_solution) {
  RandomStream draw{3, "rls"};
  const Eigen::Vector2d prior_w{0.5, -1.0};
  const Eigen::Vector2d sigma{2.0, 0.7};
  RecursiveLeastSquares<2> solver{prior_w, sigma, 1.0};
  Eigen::Matrix2d information = sigma.cwiseAbs2().cwiseInverse().asDiagonal();
  Eigen::Vector2d right = information * prior_w;
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector2d x{1.0, draw.uniform(-2.0, 2.0)};
    const double y = draw.uniform(-1.0, 1.0);
    solver.learn(x, y);
    information += x * x.transpose();
    right += x * y;
  }
  const double determinant = information.determinant();
  const Eigen::Vector2d batch{
      (information(1, 1) * right(0) - information(0, 1) * right(1)) / determinant,
      (information(0, 0) * right(1) - information(1, 0) * right(0)) / determinant};
  EXPECT_LT((solver.weights() - batch).norm(), 1e-12);
}

TEST(RecursiveLeastSquares, stays_bounded_when_one_direction_is_never_excited) {
  RecursiveLeastSquares<2> solver{Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones(), 0.9};
  for (int i = 0; i < 2000; ++i) {
    solver.learn({1.0, 0.0}, 4.0);
  }
  solver.learn({1.0, 1.0}, 5.0);
  EXPECT_NEAR(solver.weights()(0), 4.0, 0.6);
  EXPECT_LT(std::abs(solver.weights()(1)), 2.0);
}

TEST(LatencyModel, is_its_prior_before_the_first_sample) {
  LatencyPrior known;
  known.seconds = 0.2;
  known.slope = 3.0;
  known.clock = {1.0, 0.0};
  const LatencyModel model{known};
  EXPECT_NEAR(predicted_s(model, {2.0, Hertz{2e9}}), 0.2 * 8.0 / 2.0, 1e-9);
}

TEST(LatencyModel, learns_a_law_of_powers_exactly) {
  RandomStream draw{1, "latency_model"};
  LatencyModel model{prior()};
  for (int i = 0; i < 400; ++i) {
    const LatencyFeatures at = drawn(draw);
    model.learn_log_s(at, std::log(frame_s(at)));
  }
  for (int i = 0; i < 50; ++i) {
    const LatencyFeatures at = drawn(draw);
    // What is left of the prior after 400 samples.
    EXPECT_NEAR(predicted_s(model, at) / frame_s(at), 1.0, 0.01);
  }
}

TEST(LatencyModel, predicts_a_clock_that_it_has_never_run_at) {
  RandomStream draw{4, "latency_model"};
  LatencyModel model{prior()};
  for (int i = 0; i < 300; ++i) {
    LatencyFeatures at = drawn(draw);
    at.clock = Hertz{2.0352e9};
    model.learn_log_s(at, std::log(frame_s(at)));
  }
  LatencyFeatures slow = drawn(draw);
  slow.clock = Hertz{0.8064e9};
  EXPECT_NEAR(predicted_s(model, slow) / frame_s(slow), 1.0, 0.15);
}

TEST(LatencyModels, one_kernel_shows_the_others_that_the_computer_is_slow) {
  LatencyModels models;
  LatencyPrior known;
  known.sigma = 0.3;
  models.add(known);
  models.add(known);
  constexpr std::size_t map = 0;
  constexpr std::size_t plan = 1;
  const LatencyFeatures at{1.0, Hertz{2e9}};
  const double before_s = models.predict_s(plan, at);
  for (int i = 0; i < 50; ++i) {
    models.learn(map, at, from_seconds(models.predict_s(map, at)));
    models.learn(plan, at, from_seconds(before_s));
  }
  const double usual_s = models.predict_s(map, at);
  for (int i = 0; i < 30; ++i) {
    models.learn(map, at, from_seconds(3.0 * usual_s));
  }
  EXPECT_NEAR(models.predict_s(map, at) / usual_s, 3.0, 0.1);
  // Most of it is known of a kernel that has not run since.
  EXPECT_GT(models.predict_s(plan, at) / before_s, 2.0);
  EXPECT_LE(models.predict_s(plan, at) / before_s, 3.1);
}

TEST(LatencyModel, learns_most_of_a_wrong_level_from_one_sample) {
  LatencyPrior wrong;
  wrong.sigma = 0.5;
  LatencyModel model{wrong};
  const LatencyFeatures at{1.0, Hertz{2e9}};
  const double measured_s = 3.0 * predicted_s(model, at);
  model.learn_log_s(at, std::log(measured_s));
  EXPECT_NEAR(predicted_s(model, at) / measured_s, 1.0, 0.1);
}

/// Two kernels with the same prior; the first has run often.
struct MapAndPlan {
  LatencyModels models{};
  LatencyFeatures at{1.0, Hertz{2e9}};
  double usual_s{};

  MapAndPlan() {
    models.add({});
    models.add({});
    usual_s = models.predict_s(map, at);
    for (int i = 0; i < 20; ++i) {
      models.learn(map, at, from_seconds(usual_s));
    }
  }
  static constexpr std::size_t map = 0;
  static constexpr std::size_t plan = 1;
};

TEST(LatencyModels, two_samples_show_all_kernels_a_sudden_change) {
  MapAndPlan both;
  both.models.learn(MapAndPlan::map, both.at, from_seconds(3.0 * both.usual_s));
  EXPECT_LT(both.models.predict_s(MapAndPlan::plan, both.at) / both.usual_s, 1.2)
      << "one may be chance";
  both.models.learn(MapAndPlan::map, both.at, from_seconds(3.0 * both.usual_s));
  EXPECT_NEAR(both.models.predict_s(MapAndPlan::map, both.at) / both.usual_s, 3.0, 0.3);
  EXPECT_NEAR(both.models.predict_s(MapAndPlan::plan, both.at) / both.usual_s, 3.0, 0.3);
}

TEST(LatencyModels, the_wrong_prior_of_one_kernel_is_no_slowdown_of_the_others) {
  MapAndPlan both;
  for (int i = 0; i < 20; ++i) {
    both.models.learn(MapAndPlan::plan, both.at, from_seconds(3.0 * both.usual_s));
  }
  EXPECT_NEAR(both.models.predict_s(MapAndPlan::plan, both.at) / both.usual_s, 3.0, 0.1);
  EXPECT_NEAR(both.models.predict_s(MapAndPlan::map, both.at) / both.usual_s, 1.0, 0.1);
}

}  // namespace
}  // namespace flyball
