// SPDX-License-Identifier: BSD-3-Clause
// tested-in: visual_inertial
#include "visual/feature_tracks.h"

#include "visual/cv_threads.h"
#include "visual/feature.h"
#include "visual/undistortion.h"
#include <algorithm>
#include <cmath>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace flyball {
namespace {

const cv::Size window{15, 15};
constexpr int pyramid_levels = 4;  // A corner may move by 15 * 2^4 / 2 = 120 px.
constexpr float there_and_back_px = 0.7F;
constexpr double epipolar_px = 1.5;

struct Corner {
  std::uint64_t id{};
  cv::Point2f at{};
  double moved_px{};
};

std::vector<cv::Point2f> places(const std::vector<Corner>& corners) {
  std::vector<cv::Point2f> at;
  at.reserve(corners.size());
  for (const Corner& corner : corners) {
    at.push_back(corner.at);
  }
  return at;
}

std::vector<Eigen::Vector2f> pixels_of(const std::vector<cv::Point2f>& points) {
  std::vector<Eigen::Vector2f> pixels;
  pixels.reserve(points.size());
  for (const cv::Point2f& point : points) {
    pixels.emplace_back(point.x, point.y);
  }
  return pixels;
}

bool is_inside(const cv::Point2f& at, const cv::Mat& image) {
  constexpr float border_px = 4.0F;
  return at.x >= border_px && at.y >= border_px &&
         at.x < static_cast<float>(image.cols) - border_px &&
         at.y < static_cast<float>(image.rows) - border_px;
}

void keep(std::vector<Corner>& corners, const std::vector<bool>& good) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (good[i]) {
      corners[kept++] = corners[i];
    }
  }
  corners.resize(kept);
}

/// Where the surface is slanted, a corner's depth is as uncertain as its place: none is better.
std::optional<double> depth_at(const VisualFrame& frame, const cv::Point2f& at) {
  const auto depth = depth_around(frame, {static_cast<double>(at.x), static_cast<double>(at.y)});
  const bool usable = depth && depth->slope_m_px < depth_sigma_m(depth->depth_m);
  return usable ? std::optional{depth->depth_m} : std::nullopt;
}

}  // namespace

struct FeatureTracks::Images {
  std::vector<cv::Mat> before;  ///< Pyramid of the last image.
  std::vector<Corner> corners;
  std::uint64_t next_id{};

  void follow_corners(const std::vector<cv::Mat>& now,
                      const cv::Mat& image,
                      const CameraModel& camera);
  void check_geometry(const std::vector<cv::Point2f>& from, const CameraModel& camera);
  void refill(const cv::Mat& image, const TrackSettings& settings);
};

void FeatureTracks::Images::follow_corners(const std::vector<cv::Mat>& now,
                                           const cv::Mat& image,
                                           const CameraModel& camera) {
  if (corners.empty()) {
    return;
  }
  std::vector<cv::Point2f> from = places(corners);
  std::vector<cv::Point2f> to;
  std::vector<cv::Point2f> back;
  std::vector<std::uint8_t> found;
  std::vector<std::uint8_t> found_back;
  std::vector<float> error;
  cv::calcOpticalFlowPyrLK(before, now, from, to, found, error, window, pyramid_levels - 1);
  cv::calcOpticalFlowPyrLK(now, before, to, back, found_back, error, window, pyramid_levels - 1);
  std::vector<bool> good(corners.size());
  std::vector<cv::Point2f> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    good[i] = found[i] != 0 && found_back[i] != 0 && is_inside(to[i], image) &&
              cv::norm(back[i] - from[i]) < static_cast<double>(there_and_back_px);
    corners[i].at = to[i];
    corners[i].moved_px = cv::norm(to[i] - from[i]);
    if (good[i]) {
      kept.push_back(from[i]);
    }
  }
  keep(corners, good);
  check_geometry(kept, camera);
}

/// Points that move against all others are on something that moves itself, or slid along an edge.
void FeatureTracks::Images::check_geometry(const std::vector<cv::Point2f>& from,
                                           const CameraModel& camera) {
  constexpr std::size_t least = 15;  // Eight determine the geometry.
  double furthest_px = 0.0;
  for (const Corner& corner : corners) {
    furthest_px = std::max(furthest_px, corner.moved_px);
  }
  if (corners.size() < least || furthest_px < 1.0) {  // Without motion it is not determined.
    return;
  }
  // The geometry is that of straight rays: a bent image would contradict it everywhere.
  const auto then = straightened(camera, pixels_of(from));
  const auto now = straightened(camera, pixels_of(places(corners)));
  std::vector<std::size_t> straight;
  std::vector<cv::Point2f> a;
  std::vector<cv::Point2f> b;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (then[i] && now[i]) {
      straight.push_back(i);
      a.emplace_back(then[i]->x(), then[i]->y());
      b.emplace_back(now[i]->x(), now[i]->y());
    }
  }
  std::vector<std::uint8_t> fits;
  if (a.size() < least ||
      cv::findFundamentalMat(a, b, cv::FM_RANSAC, epipolar_px, 0.99, fits).empty() ||
      fits.size() != a.size()) {
    return;
  }
  std::vector<bool> good(corners.size());
  for (std::size_t i = 0; i < fits.size(); ++i) {
    good[straight[i]] = fits[i] != 0;
  }
  keep(corners, good);
}

void FeatureTracks::Images::refill(const cv::Mat& image, const TrackSettings& settings) {
  const int missing = settings.count - static_cast<int>(corners.size());
  if (missing < settings.count / 10) {
    return;
  }
  cv::Mat free(image.size(), CV_8UC1, cv::Scalar{255});
  for (const Corner& corner : corners) {
    cv::circle(free, corner.at, settings.apart_px, cv::Scalar{0}, cv::FILLED);
  }
  std::vector<cv::Point2f> fresh;
  constexpr double quality = 0.01;
  cv::goodFeaturesToTrack(image, fresh, missing, quality, settings.apart_px, free);
  if (!fresh.empty()) {
    const cv::TermCriteria enough{cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 10, 0.03};
    cv::cornerSubPix(image, fresh, cv::Size{3, 3}, cv::Size{-1, -1}, enough);
  }
  for (const cv::Point2f& at : fresh) {
    if (is_inside(at, image)) {
      corners.push_back({next_id++, at, 0.0});
    }
  }
}

FeatureTracks::FeatureTracks(const TrackSettings& settings)
    : settings_{settings}, images_{std::make_unique<Images>()} {
  keep_opencv_on_this_thread();
}

FeatureTracks::~FeatureTracks() = default;

void FeatureTracks::clear() {
  *images_ = Images{};
}

bool FeatureTracks::has_just_seen(const VisualFrame& frame) const {
  if (images_->before.empty() || !check_frame(frame)) {
    return false;
  }
  const cv::Mat& newest = images_->before.front();
  const auto width = static_cast<std::size_t>(frame.camera.width_px);
  bool is_same = newest.cols == frame.camera.width_px && newest.rows == frame.camera.height_px;
  for (int row = 0; row < newest.rows && is_same; ++row) {
    const std::size_t begin = static_cast<std::size_t>(row) * width;
    is_same = std::equal(newest.ptr(row), newest.ptr(row) + width, &frame.grey[begin]);
  }
  return is_same;
}

Result<std::vector<TrackedPoint>> FeatureTracks::follow(const VisualFrame& frame, Work& work) {
  if (const Status usable = check_frame(frame); !usable) {
    return usable.error();
  }
  work.add("pixels", static_cast<double>(frame.grey.size()));
  std::vector<TrackedPoint> points;
  try {
    const cv::Mat image(frame.camera.height_px, frame.camera.width_px, CV_8UC1,
                        const_cast<std::uint8_t*>(frame.grey.data()));  // NOLINT: only read
    std::vector<cv::Mat> now;
    cv::buildOpticalFlowPyramid(image.clone(), now, window, pyramid_levels - 1);
    work.add("tracks", static_cast<double>(images_->corners.size()));
    images_->follow_corners(now, image, frame.camera);
    const std::size_t old = images_->corners.size();
    images_->refill(image, settings_);
    work.add("features", static_cast<double>(images_->corners.size() - old));
    images_->before = std::move(now);
    if (images_->corners.empty()) {
      return points;
    }
    const auto rays = straight_rays(frame.camera, pixels_of(places(images_->corners)));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Corner& corner = images_->corners[i];
      if (rays[i]) {
        points.push_back(
            {corner.id, rays[i]->cast<double>(), depth_at(frame, corner.at), corner.moved_px});
      }
    }
  } catch (const cv::Exception& error) {
    return Error{ErrorCode::failed,
                 std::string{"OpenCV cannot follow the corners: "} + error.what()};
  }
  return points;
}

}  // namespace flyball
