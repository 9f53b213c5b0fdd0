// SPDX-License-Identifier: BSD-3-Clause
#include "visual/inertial_filter.h"

#include "flyball/runtime/random.h"

#include "circle_flight.h"
#include "visual/landmark_update.h"
#include "visual/motion.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double step_s = 0.005;

ImuSample exact(const VehicleState& state, double t_s) {
  return {MissionTime{from_seconds(t_s)}, state.w_WB_B,
          state.X_WB.linear().transpose() * (state.a_WB - gravity_W())};
}

/// Flies the filter along with exact measurements, biased as given.
void fly(InertialFilter& filter,
         const kit::CircleRun& run,
         double from_s,
         double to_s,
         const Vec3& accel_bias = Vec3::Zero()) {
  for (double t = from_s; t < to_s - 1e-9; t += step_s) {
    ImuSample sample = exact(run.at(t + 0.5 * step_s), t + step_s);
    sample.f_B += accel_bias;
    filter.propagate(sample, step_s, 0.0);
  }
}

double miss_m(const InertialFilter& filter, const kit::CircleRun& run, double t_s) {
  return (filter.X_WB().translation() - run.at(t_s).X_WB.translation()).norm();
}

TEST(InertialFilter, follows_exact_measurements_round_the_circle) {
  const kit::CircleRun run{4.0, 0.5, false};
  InertialFilter filter{{}};
  filter.start(run.at(0.0).X_WB, 0.01);
  fly(filter, run, 0.0, 12.0);
  EXPECT_LT(miss_m(filter, run, 12.0), 0.01);
  EXPECT_LT((filter.v_WB() - run.at(12.0).v_WB).norm(), 0.002);
}

// After 4 s: g t^2 / 2 of .01 rad of tilt, t^2 / 2 of .1 m/s^2 of bias, g t^3 / 6 of .02 rad/s of
// bias, and t times .02 m/s. Noise adds millimetres.
TEST(InertialFilter, knows_how_little_it_knows) {
  InertialFilter filter{{}};
  filter.start(Pose::Identity(), 0.01);
  fly(filter, kit::CircleRun{0.0, 100.0, false}, 0.0, 4.0);
  const double sigma_m = std::sqrt(filter.covariance()(InertialFilter::position, 3));
  const double biased_m = std::hypot(0.1 * 8.0, 0.02 * 9.80665 * 64.0 / 6.0);
  EXPECT_NEAR(sigma_m, std::hypot(0.01 * 9.80665 * 8.0, biased_m, 4.0 * 0.02), 0.02);
}

/// Landmarks along the circle, seen from the poses of the window.
std::vector<Glimpse> glimpses_of(const InertialFilter& filter,
                                 const std::vector<Pose>& X_WB_true,
                                 const Vec3& p_W,
                                 RandomStream& noise,
                                 double ray_sigma) {
  std::vector<Glimpse> seen;
  for (std::size_t i = 0; i < filter.window().size(); ++i) {
    const Vec3 p_C = kit::ahead_from_body().inverse() * (X_WB_true[i].inverse() * p_W);
    if (p_C.z() > 1.0) {
      seen.push_back({i,
                      Eigen::Vector2d{p_C.head<2>() / p_C.z()} +
                          ray_sigma * Eigen::Vector2d{noise.normal(), noise.normal()},
                      std::nullopt});
    }
  }
  return seen;
}

struct LandmarkViews {
  InertialFilter filter{{}};
  std::vector<Pose> X_WB_true{};
  kit::CircleRun run{3.0, 0.5, false};
  RandomStream noise{5, "sights"};
  static constexpr double ray_sigma = 0.005;
  static constexpr double pause_s = 0.25;
  static constexpr double end_s = 12.0 * pause_s;

  /// Three seconds with a bias that the filter does not know; ten poses in the last two and a half.
  LandmarkViews() {
    filter.start(run.at(0.0).X_WB, 0.01);
    for (int i = 0; i < 12; ++i) {
      fly(filter, run, pause_s * i, pause_s * (i + 1), Vec3{0.08, -0.05, 0.0});
      if (i >= 2) {
        filter.remember(MissionTime{from_seconds(pause_s * (i + 1))}, kit::ahead_from_body());
        X_WB_true.push_back(run.at(pause_s * (i + 1)).X_WB);
      }
    }
  }
  Vec3 landmark() {
    const Pose ahead = run.at(end_s).X_WB;
    return ahead *
           Vec3{noise.uniform(4.0, 14.0), noise.uniform(-6.0, 6.0), noise.uniform(-2.0, 3.0)};
  }
  std::optional<Innovation> innovation(const Vec3& p_W) {
    const auto seen = glimpses_of(filter, X_WB_true, p_W, noise, ray_sigma);
    const auto place = triangulate(filter.window(), seen, 40.0 * ray_sigma);
    return place ? std::optional{landmark_innovation(filter, seen, *place, ray_sigma)}
                 : std::nullopt;
  }
};

TEST(InertialFilter, is_corrected_by_what_was_seen) {
  LandmarkViews views;
  const double before_m = miss_m(views.filter, views.run, LandmarkViews::end_s);
  const Vec3 v_before_WB = views.filter.v_WB();
  EXPECT_GT(before_m, 0.4);
  int used = 0;
  for (int i = 0; i < 60; ++i) {
    if (const auto innovation = views.innovation(views.landmark())) {
      used += views.filter.believe(*innovation) ? 1 : 0;
    }
  }
  EXPECT_GT(used, 30);
  EXPECT_LT(miss_m(views.filter, views.run, LandmarkViews::end_s), 0.35 * before_m);
  // The bias itself stays hidden: in three seconds a tilt of .08 / 9.8 rad looks the same.
  const Vec3 v_true_WB = views.run.at(LandmarkViews::end_s).v_WB;
  EXPECT_LT((views.filter.v_WB() - v_true_WB).norm(), 0.35 * (v_before_WB - v_true_WB).norm());
}

TEST(InertialFilter, does_not_believe_what_contradicts_all_else) {
  LandmarkViews views;
  for (int i = 0; i < 60; ++i) {
    if (const auto innovation = views.innovation(views.landmark())) {
      (void)views.filter.believe(*innovation);
    }
  }
  auto wrong = views.innovation(views.landmark());
  while (!wrong) {
    wrong = views.innovation(views.landmark());
  }
  wrong->residual.array() += 20.0;
  const Vec3 before = views.filter.X_WB().translation();
  EXPECT_FALSE(views.filter.believe(*wrong));
  EXPECT_EQ(views.filter.X_WB().translation(), before);
}

TEST(InertialFilter, comes_to_the_same_with_many_rows_at_once_as_one_after_another) {
  LandmarkViews views;
  std::vector<Innovation> all;
  while (all.size() < 20) {
    if (auto innovation = views.innovation(views.landmark())) {
      all.push_back(std::move(*innovation));
    }
  }
  Eigen::Index rows = 0;
  for (const Innovation& one : all) {
    rows += one.residual.size();
  }
  ASSERT_GT(rows, views.filter.size());
  Innovation together{Eigen::VectorXd(rows), Eigen::MatrixXd(rows, views.filter.size()),
                      Eigen::VectorXd::Ones(rows)};
  Eigen::Index row = 0;
  for (const Innovation& one : all) {
    together.residual.segment(row, one.residual.size()) = one.residual;
    together.slope.middleRows(row, one.residual.size()) = one.slope;
    row += one.residual.size();
  }
  InertialFilter one_step = views.filter;
  one_step.correct(together);
  Innovation half;
  InertialFilter by_rows = views.filter;
  for (Eigen::Index at = 0; at < rows; at += 50) {
    const Eigen::Index count = std::min<Eigen::Index>(50, rows - at);
    half = {together.residual.segment(at, count), together.slope.middleRows(at, count),
            together.sigma.segment(at, count)};
    by_rows.correct(half);
  }
  EXPECT_LT((one_step.covariance() - by_rows.covariance()).norm(),
            1e-6 * one_step.covariance().norm());
}

TEST(InertialFilter, forgets_its_oldest_pose_and_nothing_else) {
  LandmarkViews views;
  const Eigen::MatrixXd before = views.filter.covariance();
  const Eigen::Index size = views.filter.size();
  views.filter.forget_oldest();
  EXPECT_EQ(views.filter.size(), size - 6);
  EXPECT_EQ(views.filter.covariance().topLeftCorner(15, 15), before.topLeftCorner(15, 15));
  EXPECT_EQ(views.filter.covariance().bottomRightCorner(54, 54), before.bottomRightCorner(54, 54));
  EXPECT_EQ(views.filter.covariance().topRightCorner(15, 54), before.topRightCorner(15, 54));
}

TEST(Triangulation, finds_a_point_from_its_rays_and_refuses_parallel_ones) {
  LandmarkViews views;
  const Vec3 p_W = views.run.at(LandmarkViews::end_s).X_WB * Vec3{6.0, 2.0, 1.0};
  std::vector<BodyPose> window = views.filter.window();
  for (std::size_t i = 0; i < window.size(); ++i) {
    window[i].X_WB = views.X_WB_true[i];
  }
  const auto seen = glimpses_of(views.filter, views.X_WB_true, p_W, views.noise, 0.0);
  const auto found = triangulate(window, seen, 0.01);
  ASSERT_TRUE(found);
  EXPECT_LT((*found - p_W).norm(), 1e-6);
  const Vec3 far_W = views.run.at(LandmarkViews::end_s).X_WB * Vec3{5000.0, 20.0, 10.0};
  EXPECT_FALSE(triangulate(
      window, glimpses_of(views.filter, views.X_WB_true, far_W, views.noise, 0.0), 0.01));
  auto bent = seen;
  bent.back().ray.x() += 0.2;
  EXPECT_FALSE(triangulate(window, bent, 0.01));
}

TEST(ChiSquare, has_its_95_percent_quantiles_where_the_tables_have_them) {
  EXPECT_NEAR(chi_square_95(2.0), 5.991, 0.06);
  EXPECT_NEAR(chi_square_95(9.0), 16.919, 0.05);
  EXPECT_NEAR(chi_square_95(39.0), 54.572, 0.05);
}

}  // namespace
}  // namespace flyball
