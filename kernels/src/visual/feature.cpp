// SPDX-License-Identifier: BSD-3-Clause
// tested-in: visual_slam
#include "visual/feature.h"

#include "visual/cv_threads.h"
#include "visual/undistortion.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>

#include <opencv2/features2d.hpp>

namespace flyball {
namespace {

// Of ORB's corners: FAST finds whole pixels of its octave; measured on rendered views, two
// detections of one corner lie .5 to .8 px apart.
constexpr double corner_sigma_px = 0.8;
constexpr int octaves = 8;
constexpr int cell_px = 32;  // Side of the parts over which the points are spread.
constexpr int surplus = 3;   // So many more points are looked for than are kept.

std::size_t pixel_count(const CameraModel& camera) {
  return static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
}

/// Weak corners are for cells that have no strong one, as in ORB-SLAM2 (its ini- and minThFAST).
std::vector<cv::KeyPoint> strong_ones(const std::vector<cv::KeyPoint>& found, int strong_corner) {
  constexpr int cell_of_octave_px = 30;
  const auto strong_response = static_cast<float>(strong_corner);
  const auto cell_of = [](const cv::KeyPoint& point) {
    const double scale = std::pow(octave_scale, point.octave) * cell_of_octave_px;
    return std::array{point.octave, static_cast<int>(point.pt.x / scale),
                      static_cast<int>(point.pt.y / scale)};
  };
  std::set<std::array<int, 3>> strong;
  for (const cv::KeyPoint& point : found) {
    if (point.response >= strong_response) {
      strong.insert(cell_of(point));
    }
  }
  std::vector<cv::KeyPoint> kept;
  for (const cv::KeyPoint& point : found) {
    if (point.response >= strong_response || strong.count(cell_of(point)) == 0) {
      kept.push_back(point);
    }
  }
  return kept;
}

/// The strongest of each cell, first one of each, then a second one, until there are `count`.
std::vector<cv::KeyPoint> spread(std::vector<cv::KeyPoint> found, int columns, int count) {
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.response != b.response
               ? a.response > b.response
               : std::tie(a.pt.y, a.pt.x, a.octave) < std::tie(b.pt.y, b.pt.x, b.octave);
  });
  std::vector<int> taken;
  std::vector<std::pair<int, std::size_t>> order;  // Rank within its cell, place in `found`.
  for (std::size_t i = 0; i < found.size(); ++i) {
    const int row = static_cast<int>(found[i].pt.y) / cell_px;
    const int place = row * columns + static_cast<int>(found[i].pt.x) / cell_px;
    const auto cell = static_cast<std::size_t>(place);
    if (cell >= taken.size()) {
      taken.resize(cell + 1, 0);
    }
    order.emplace_back(taken[cell]++, i);
  }
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), static_cast<std::size_t>(count)));
  std::vector<cv::KeyPoint> kept;
  kept.reserve(order.size());
  for (const auto& [rank, place] : order) {
    kept.push_back(found[place]);
  }
  return kept;
}

/// OpenCV multiplies the coordinates in an octave's image by the octave's scale. But that image has
/// a whole number of pixels, so that its real scale is another one (a pixel at the right edge), and
/// the centre of its first pixel lies half a coarse pixel from the edge, not half a fine one.
void place_exactly(std::vector<cv::KeyPoint>& points, const CameraModel& camera) {
  for (cv::KeyPoint& point : points) {
    const double nominal = std::pow(octave_scale, point.octave);
    const auto exactly = [nominal](float at, int pixels) {
      const double real = pixels / std::round(pixels / nominal);
      return static_cast<float>((static_cast<double>(at) / nominal + 0.5) * real - 0.5);
    };
    point.pt = {exactly(point.pt.x, camera.width_px), exactly(point.pt.y, camera.height_px)};
  }
}

std::vector<Feature> features_of(const VisualFrame& frame,
                                 const std::vector<cv::KeyPoint>& points,
                                 const cv::Mat& descriptors) {
  std::vector<Eigen::Vector2f> seen;
  seen.reserve(points.size());
  for (const cv::KeyPoint& point : points) {
    seen.emplace_back(point.pt.x, point.pt.y);
  }
  const auto straight = straightened(frame.camera, seen);
  std::vector<Feature> features;
  features.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!straight[i]) {
      continue;
    }
    Feature feature;
    feature.pixel = straight[i]->cast<double>();
    feature.octave = points[i].octave;
    feature.raw_pixel = {static_cast<double>(points[i].pt.x), static_cast<double>(points[i].pt.y)};
    feature.sigma_px = corner_sigma_px * std::pow(octave_scale, feature.octave);
    measure_depth(feature, frame);
    std::memcpy(feature.descriptor.bits.data(), descriptors.ptr(static_cast<int>(i)),
                sizeof feature.descriptor.bits);
    features.push_back(feature);
  }
  return features;
}

}  // namespace

double depth_sigma_m(double depth_m) {
  return std::max(0.01, 2.0 * 1.425e-3 * depth_m * depth_m);
}

std::optional<SurfaceDepth> depth_around(const VisualFrame& frame,
                                         const Eigen::Vector2d& raw_pixel) {
  const int x = static_cast<int>(std::lround(raw_pixel.x()));
  const int y = static_cast<int>(std::lround(raw_pixel.y()));
  if (frame.depth_m.empty() || x < 1 || y < 1 || x > frame.camera.width_px - 2 ||
      y > frame.camera.height_px - 2) {
    return std::nullopt;
  }
  Eigen::Matrix3d around;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const int pixel = (y + row - 1) * frame.camera.width_px + x + column - 1;
      const float d = frame.depth_m[static_cast<std::size_t>(pixel)];
      if (!std::isfinite(d) || d <= 0.0F) {
        return std::nullopt;
      }
      around(row, column) = static_cast<double>(d);
    }
  }
  // Least squares of a plane: the mean, and the slopes by column and row.
  const double mean_m = around.mean();
  const double by_x = (around.col(2).sum() - around.col(0).sum()) / 6.0;
  const double by_y = (around.row(2).sum() - around.row(0).sum()) / 6.0;
  double farthest_off_m = 0.0;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const double plane_m = mean_m + by_x * (column - 1) + by_y * (row - 1);
      farthest_off_m = std::max(farthest_off_m, std::abs(around(row, column) - plane_m));
    }
  }
  // At an edge the point may lie on either surface. Beyond 17 m the camera's range would cut off
  // what noise makes longer, but not what it makes shorter.
  constexpr double off_in_sigmas = 2.5;  // Nine draws of half this sigma stay within it.
  constexpr double vaguest = 0.05;
  const double sigma_m = depth_sigma_m(mean_m);
  if (farthest_off_m > off_in_sigmas * sigma_m || sigma_m > vaguest * mean_m) {
    return std::nullopt;
  }
  return SurfaceDepth{mean_m + by_x * (raw_pixel.x() - x) + by_y * (raw_pixel.y() - y),
                      std::hypot(by_x, by_y)};
}

void measure_depth(Feature& feature, const VisualFrame& frame) {
  const auto depth = depth_around(frame, feature.raw_pixel);
  feature.depth_m = depth ? std::optional{depth->depth_m} : std::nullopt;
  feature.slope_m_px = depth ? depth->slope_m_px : 0.0;
}

Status check_frame(const VisualFrame& frame) {
  const CameraModel& camera = frame.camera;
  const bool sized = camera.width_px > 0 && camera.height_px > 0 &&
                     frame.grey.size() == pixel_count(camera) &&
                     (frame.depth_m.empty() || frame.depth_m.size() == pixel_count(camera));
  if (!sized || !(camera.focal_x_px > 0.0) || !(camera.focal_y_px > 0.0)) {
    return Error{ErrorCode::invalid_input, "a frame of " + std::to_string(frame.grey.size()) +
                                               " grey and " + std::to_string(frame.depth_m.size()) +
                                               " depth pixels does not fit its camera of " +
                                               std::to_string(camera.width_px) + " x " +
                                               std::to_string(camera.height_px) +
                                               " pixels; both images must have the camera's size"};
  }
  return Done{};
}

struct FeatureExtractor::Detector {
  FeatureSettings settings;
  cv::Ptr<cv::ORB> orb;
};

FeatureExtractor::FeatureExtractor(const FeatureSettings& settings) {
  keep_opencv_on_this_thread();
  constexpr int border_px = 19;  // ORB's patch and its rotation need so much.
  detector_ = std::make_unique<Detector>(
      Detector{settings, cv::ORB::create(0, static_cast<float>(octave_scale), octaves, border_px, 0,
                                         2, cv::ORB::FAST_SCORE, 31, settings.weak_corner)});
}

FeatureExtractor::~FeatureExtractor() = default;

Result<std::vector<Feature>> FeatureExtractor::extract(const VisualFrame& frame, Work& work) {
  if (const Status usable = check_frame(frame); !usable) {
    return usable.error();
  }
  work.add("pixels", static_cast<double>(pixel_count(frame.camera)));
  try {
    const cv::Mat image(frame.camera.height_px, frame.camera.width_px, CV_8UC1,
                        const_cast<std::uint8_t*>(frame.grey.data()));  // NOLINT: only read
    const int count =
        frame.camera.width_px * frame.camera.height_px / detector_->settings.pixels_per_feature;
    std::vector<cv::KeyPoint> points;
    detector_->orb->setMaxFeatures(surplus * count);
    detector_->orb->detect(image, points);
    if (detector_->settings.strong_corner > detector_->settings.weak_corner) {
      points = strong_ones(points, detector_->settings.strong_corner);
    }
    points = spread(std::move(points), frame.camera.width_px / cell_px + 1, count);
    cv::Mat rows;
    detector_->orb->compute(image, points, rows);
    place_exactly(points, frame.camera);
    std::vector<Feature> features = features_of(frame, points, rows);
    work.add("features", static_cast<double>(features.size()));
    return features;
  } catch (const cv::Exception& error) {
    return Error{ErrorCode::failed, std::string{"OpenCV finds no features: "} + error.what()};
  }
}

}  // namespace flyball
