// SPDX-License-Identifier: BSD-3-Clause
// tested-in: visual_inertial
#include "visual/inertial_odometry.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

using namespace std::chrono_literals;

// Two seconds: with fourteen poses the drift was twice as much, for half the updates.
constexpr std::size_t window_poses = 20;
// At first a track is used when it is so long: until the window is full nothing else holds the
// speed.
constexpr std::size_t first_glimpses = 14;
constexpr std::size_t least_glimpses = 3;
constexpr std::size_t most_tracks = 40;  // In one update; the longest ones say most.
// Lucas-Kanade's noise, measured on rendered views, is .1 to .3 px; it slides along slanted
// surfaces.
constexpr double track_sigma_px = 0.7;
constexpr double reach_in_sigmas = 5.0;
constexpr int enough_tracks = 10;
constexpr auto blind_limit = 1500ms;
constexpr auto least_gap = 80ms;  // Between two poses of the window.
constexpr double still_px = 0.3;
constexpr double rest_px = 0.5;
constexpr double assumed_depth_m = 10.0;  // Of what is seen, where no depth is measured.
constexpr double least_speed_sigma_m_s = 0.005;
constexpr double slow_m_s = 0.2;  // A view that allows for more speed says nothing about it.
// Without anything that binds its speed for so long as `blind_limit`, the filter's own uncertainty
// decides: so much of speed is half a metre of place until the next tracks are used.
constexpr double vague_m_s = 0.2;
constexpr double lost_m_s = 0.5;

/// One measurement of all; the noise is 1 in each row.
Innovation stacked(const std::vector<Innovation>& parts) {
  Eigen::Index rows = 0;
  for (const Innovation& part : parts) {
    rows += part.residual.size();
  }
  Innovation all{Eigen::VectorXd(rows), Eigen::MatrixXd(rows, parts.front().slope.cols()),
                 Eigen::VectorXd::Ones(rows)};
  Eigen::Index row = 0;
  for (const Innovation& part : parts) {
    all.residual.segment(row, part.residual.size()) = part.residual;
    all.slope.middleRows(row, part.residual.size()) = part.slope;
    row += part.residual.size();
  }
  return all;
}

/// The failure detection of VINS-Mono (Qin et al. 2018, the authors' code): biases that no sensor
/// has, or a jump of 5 m, of 1 m upwards, from one frame to the next; those at their 10 Hz.
bool is_absurd(const InertialFilter& filter) {
  constexpr double most_accel_bias_m_s2 = 2.5;
  constexpr double most_gyro_bias_rad_s = 1.0;
  constexpr double most_m_s = 50.0;
  constexpr double most_climb_m_s = 10.0;
  return !(filter.accel_bias_now().norm() <= most_accel_bias_m_s2 &&
           filter.gyro_bias_now().norm() <= most_gyro_bias_rad_s &&
           filter.v_WB().norm() <= most_m_s && std::abs(filter.v_WB().z()) <= most_climb_m_s);
}

ImuSample between(const ImuSample& a, const ImuSample& b) {
  return {b.stamp, 0.5 * (a.w_WB_B + b.w_WB_B), 0.5 * (a.f_B + b.f_B)};
}

}  // namespace

InertialOdometry::InertialOdometry() : tracks_{TrackSettings{}}, filter_{InertialNoise{}} {}

void InertialOdometry::start(const std::optional<Pose>& X_WB) {
  tracks_.clear();
  seen_.clear();
  waiting_.clear();
  recent_f_B_.clear();
  rest_.clear();
  X_WB_start_ = X_WB;
  has_begun_ = has_moved_ = has_been_full_ = has_failed_ = false;
  refused_views_ = 0;
}

/// One sample that no sensor can mean would spoil the estimate for good.
void InertialOdometry::add_imu_sample(const ImuSample& sample) {
  constexpr double most_m_s2 = 500.0;   // Chosen: 50 g, and 16 turns a second. Both are beyond what
  constexpr double most_rad_s = 100.0;  // such sensors measure.
  if (sample.f_B.norm() <= most_m_s2 && sample.w_WB_B.norm() <= most_rad_s) {
    waiting_.push_back(sample);
  }
}

void InertialOdometry::begin(MissionTime now) {
  Pose X_WB = X_WB_start_.value_or(Pose::Identity());
  Vec3 sum = Vec3::Zero();
  for (const ImuSample& sample : waiting_) {
    sum += sample.f_B;
    last_ = sample;
  }
  if (!X_WB_start_ && sum.norm() > 0.0) {
    X_WB.linear() = Eigen::Quaterniond::FromTwoVectors(sum, Vec3::UnitZ()).toRotationMatrix();
  }
  constexpr double placed_tilt_rad = 0.01;
  constexpr double levelled_tilt_rad = 0.05;  // .5 m/s^2 of acceleration, or of bias.
  filter_.start(X_WB, X_WB_start_ ? placed_tilt_rad : levelled_tilt_rad);
  waiting_.clear();
  now_ = last_seen_ = last_bound_ = now;
  has_begun_ = true;
}

void InertialOdometry::propagate(const ImuSample& sample, MissionTime to) {
  const double dt_s = to_seconds(to - now_);
  if (dt_s > 0.0) {
    filter_.propagate(sample, dt_s, shaking(recent_f_B_));
    now_ = to;
  }
}

void InertialOdometry::advance(MissionTime to) {
  std::size_t used = 0;
  for (; used < waiting_.size() && waiting_[used].stamp <= to; ++used) {
    const ImuSample& sample = waiting_[used];
    recent_f_B_.push_back(sample.f_B);
    if (recent_f_B_.size() > shake_samples) {
      recent_f_B_.pop_front();
    }
    propagate(between(last_, sample), sample.stamp);
    last_ = sample;
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(used));
  propagate(last_, to);
}

void InertialOdometry::stand() {
  constexpr double speed_sigma_m_s = 0.01;
  const Innovation still = standing(filter_, last_, speed_sigma_m_s, 0.0);
  if (filter_.surprise(still) < 1.5 * chi_square_95(9.0)) {
    filter_.correct(still);
  } else {
    has_moved_ = true;  // No corner told, but the other senses did.
  }
}

bool InertialOdometry::hold(const SlowView& view, double focal_px) {
  const double depth_m = view.depth_m > 0.0 ? view.depth_m : assumed_depth_m;
  // Speed now may be twice the mean speed; the corners' noise is half a pixel.
  const double ray = 2.0 * view.moved_ray + still_px / focal_px;
  const double speed_sigma_m_s = std::max(least_speed_sigma_m_s, ray * depth_m / view.lasted_s);
  if (speed_sigma_m_s > slow_m_s) {
    refused_views_ = 0;
    return false;
  }
  const bool stands = view.moved_ray * focal_px < rest_px;
  const bool is_believed = (stands && filter_.believe(standing(filter_, last_, speed_sigma_m_s,
                                                               shaking(recent_f_B_)))) ||
                           filter_.believe(slow(filter_, speed_sigma_m_s));
  // Without depth, what hardly moves in the image may be far away.
  refused_views_ = stands && view.depth_m > 0.0 && !is_believed ? refused_views_ + 1 : 0;
  return is_believed;
}

/// No two images of a real sensor are the same; made ones are, while the vehicle stands.
bool InertialOdometry::is_stale(const VisualFrame& frame) const {
  if (!has_moved_ || !tracks_.has_just_seen(frame)) {
    return false;
  }
  const Innovation still = standing(filter_, last_, least_speed_sigma_m_s, shaking(recent_f_B_));
  return filter_.surprise(still) > chi_square_95(static_cast<double>(still.residual.size()));
}

void InertialOdometry::note(const std::vector<TrackedPoint>& points) {
  const std::size_t newest = filter_.window().size() - 1;
  for (const TrackedPoint& point : points) {
    seen_[point.id].push_back({newest, point.ray, point.depth_m});
  }
}

/// Tracks that ended, and those that began with the window's oldest pose when it has to go; at
/// first those that tell enough.
std::vector<std::uint64_t> InertialOdometry::finished() const {
  const std::size_t newest = filter_.window().size() - 1;
  const bool is_full = filter_.window().size() >= window_poses;
  std::vector<std::uint64_t> ids;
  for (const auto& [id, glimpses] : seen_) {
    const bool ended = glimpses.back().pose != newest;
    const bool tells_enough = !has_been_full_ && glimpses.size() >= first_glimpses;
    if (ended || tells_enough || (is_full && glimpses.front().pose == 0)) {
      ids.push_back(id);
    }
  }
  return ids;
}

std::optional<Innovation> InertialOdometry::told_by(const std::vector<Glimpse>& glimpses,
                                                    double ray_sigma) const {
  const auto p_W = triangulate(filter_.window(), glimpses, reach_in_sigmas * ray_sigma);
  if (!p_W) {
    return std::nullopt;
  }
  Innovation innovation = landmark_innovation(filter_, glimpses, *p_W, ray_sigma);
  const auto rows = static_cast<double>(innovation.residual.size());
  return filter_.surprise(innovation) < chi_square_95(rows) ? std::optional{std::move(innovation)}
                                                            : std::nullopt;
}

int InertialOdometry::use_tracks(double ray_sigma, Work& work) {
  std::vector<std::uint64_t> ids = finished();
  std::stable_sort(ids.begin(), ids.end(), [this](std::uint64_t a, std::uint64_t b) {
    return seen_.at(a).size() > seen_.at(b).size();
  });
  std::vector<Innovation> believed;
  for (const std::uint64_t id : ids) {
    const std::vector<Glimpse>& glimpses = seen_.at(id);
    if (has_moved_ && glimpses.size() >= least_glimpses && believed.size() < most_tracks) {
      if (auto told = told_by(glimpses, ray_sigma)) {
        believed.push_back(std::move(*told));
      }
    }
    seen_.erase(id);
  }
  if (!believed.empty()) {
    const Innovation all = stacked(believed);
    filter_.correct(all);
    const auto columns = static_cast<double>(filter_.size());
    work.add("filter_updates", static_cast<double>(all.residual.size()) * columns * columns);
  }
  return static_cast<int>(believed.size());
}

void InertialOdometry::forget_oldest() {
  filter_.forget_oldest();
  for (auto& [id, glimpses] : seen_) {
    for (Glimpse& glimpse : glimpses) {
      --glimpse.pose;  // None is of the oldest: those tracks were used.
    }
  }
}

int InertialOdometry::watch_for_motion(const std::vector<TrackedPoint>& points) {
  std::vector<double> moved_px;
  for (const TrackedPoint& point : points) {
    if (seen_.count(point.id) > 0) {
      moved_px.push_back(point.moved_px);
    }
  }
  if (!moved_px.empty() && !has_moved_) {
    const auto middle = moved_px.begin() + static_cast<std::ptrdiff_t>(moved_px.size() / 2);
    std::nth_element(moved_px.begin(), middle, moved_px.end());
    has_moved_ = *middle > still_px;
  }
  return static_cast<int>(moved_px.size());
}

/// More often, the window would span too little motion to tell depth and tilt: at 20 Hz the drift
/// was five times that at 10 Hz.
bool InertialOdometry::is_due(MissionTime now) const {
  return filter_.window().empty() || now - filter_.window().back().captured >= least_gap;
}

void InertialOdometry::look(const VisualFrame& frame,
                            const std::vector<TrackedPoint>& points,
                            OdometryOutcome& outcome,
                            Work& work) {
  outcome.tracks = watch_for_motion(points);
  const auto view = rest_.compare(points, frame.captured, frame.camera.focal_x_px);
  bool is_bound = !has_moved_;
  if (!has_moved_) {
    stand();
  } else if (view) {
    is_bound = hold(*view, frame.camera.focal_x_px);
  }
  if (is_due(frame.captured)) {
    filter_.remember(frame.captured, frame.X_BC);
    note(points);
    outcome.believed = use_tracks(track_sigma_px / frame.camera.focal_x_px, work);
    if (filter_.window().size() >= window_poses) {
      has_been_full_ = true;
      forget_oldest();
    }
  }
  if (outcome.tracks >= enough_tracks) {
    last_seen_ = frame.captured;
  }
  if (is_bound || outcome.believed > 0) {
    last_bound_ = frame.captured;
  }
}

Result<OdometryOutcome> InertialOdometry::track_frame(const VisualFrame& frame, Work& work) {
  OdometryOutcome outcome;
  if (has_begun_) {
    advance(frame.captured);
  }
  if (!has_begun_ || !is_stale(frame)) {
    const auto points = tracks_.follow(frame, work);
    if (!points) {
      return points.error();
    }
    if (!has_begun_) {
      begin(frame.captured);
      advance(frame.captured);
    }
    look(frame, *points, outcome, work);
  }
  has_failed_ = has_failed_ || is_absurd(filter_);
  outcome.tracked = makes_sense() && frame.captured - last_seen_ < blind_limit;
  return outcome;
}

bool InertialOdometry::makes_sense() const {
  constexpr int most_refused_views = 1;  // Two are a second.
  return !has_failed_ && knows_speed() && refused_views_ <= most_refused_views;
}

bool InertialOdometry::knows_speed() const {
  const double sigma_m_s =
      std::sqrt(filter_.covariance().diagonal().segment<3>(InertialFilter::velocity).maxCoeff());
  return sigma_m_s < (now_ - last_bound_ < blind_limit ? lost_m_s : vague_m_s);
}

}  // namespace flyball
