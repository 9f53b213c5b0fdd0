// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Points of an image that can be recognised in another one.

#include "flyball/kernels/visual_frame.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/work.h"

#include <memory>
#include <optional>

namespace flyball {

/// 256 brightness comparisons around a point.
struct Descriptor {
  std::array<std::uint64_t, 4> bits{};
};

/// How many of 64 bits are set, by sums of neighbours: the baseline of x86-64 has no instruction
/// for it, and one that is chosen at start-up does not get along with the sanitizers.
[[nodiscard]] inline int ones(std::uint64_t bits) {
  bits -= (bits >> 1U) & 0x5555555555555555ULL;
  bits = (bits & 0x3333333333333333ULL) + ((bits >> 2U) & 0x3333333333333333ULL);
  bits = (bits + (bits >> 4U)) & 0x0f0f0f0f0f0f0f0fULL;
  return static_cast<int>((bits * 0x0101010101010101ULL) >> 56U);
}

/// How many comparisons differ: 0..256. Unrelated points differ in about 128.
[[nodiscard]] inline int difference(const Descriptor& a, const Descriptor& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.bits.size(); ++i) {
    count += ones(a.bits[i] ^ b.bits[i]);
  }
  return count;
}

struct Feature {
  Eigen::Vector2d pixel{Eigen::Vector2d::Zero()};  ///< Where a camera without distortion sees it.
  Eigen::Vector2d raw_pixel{Eigen::Vector2d::Zero()};  ///< In the image.
  double sigma_px{1.0};
  std::optional<double> depth_m{};
  double slope_m_px{};  ///< Of the depth, where the surface is slanted.
  int octave{};         ///< Of the image pyramid, each 1.2 times coarser than the one below.
  Descriptor descriptor{};
};

constexpr double octave_scale = 1.2;  // Rublee et al. 2011; also ORB-SLAM's.

/// Standard deviation of a measured depth: twice what Khoshelham & Elberink 2012
/// (doi:10.3390/s120201437, eq. 10) found for a structured-light camera, 1.425e-3 d^2, and at least
/// 1 cm. It is above the noise of the simulator's camera at all depths to 20 m.
[[nodiscard]] double depth_sigma_m(double depth_m);

struct SurfaceDepth {
  double depth_m{};
  double slope_m_px{};
};

/// The plane through the depths of 3 x 3 pixels, at a place between them: their mean has a third of
/// one pixel's noise. None at an edge, without returns, or beyond what the camera can tell to 5 %.
[[nodiscard]] std::optional<SurfaceDepth> depth_around(const VisualFrame& frame,
                                                       const Eigen::Vector2d& raw_pixel);

/// Depth and its slope at the feature's place.
void measure_depth(Feature& feature, const VisualFrame& frame);

struct FeatureSettings {
  /// One in so many at most, spread over the image: 800 in 320 x 240. ORB-SLAM2 takes one in 307;
  /// small images need more of theirs.
  int pixels_per_feature{96};
  /// FAST's contrast, of 255 grey levels. ORB-SLAM2 has 7; plaster shows no such corners.
  int weak_corner{5};
  /// Where a corner has so much, its part of the image shows none that is weaker. ORB-SLAM2: 20.
  int strong_corner{5};
};

/// ORB: Rublee, Rabaud, Konolige, Bradski 2011, doi:10.1109/ICCV.2011.6126544.
class FeatureExtractor {
 public:
  explicit FeatureExtractor(const FeatureSettings& settings);
  ~FeatureExtractor();
  FeatureExtractor(const FeatureExtractor&) = delete;
  FeatureExtractor& operator=(const FeatureExtractor&) = delete;

  /// The strongest points of each part of the image. Adds `pixels` and `features` to `work`.
  /// @error `invalid_input` when the image has another size than the camera model, `failed` when
  ///        OpenCV refuses it.
  [[nodiscard]] Result<std::vector<Feature>> extract(const VisualFrame& frame, Work& work);

 private:
  struct Detector;
  std::unique_ptr<Detector> detector_;
};

/// Whether the image has the size that its camera model says, and a depth image the same.
[[nodiscard]] Status check_frame(const VisualFrame& frame);

}  // namespace flyball
