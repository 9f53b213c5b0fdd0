// flyball-package: OpenCV COMPONENTS core imgproc tracking
// flyball-link: opencv_core opencv_imgproc opencv_tracking
// SPDX-License-Identifier: BSD-3-Clause
//
// Kernelised correlation filter (Henriques et al. 2015, doi:10.1109/TPAMI.2014.2345390), OpenCV's.
// The box keeps the size that it began with.

#include "flyball/kernels/tracker.h"
#include "flyball/runtime/registry.h"

#include "visual/cv_image.h"
#include "visual/cv_threads.h"
#include "visual/detection_boxes.h"
#include <exception>

#include <opencv2/tracking.hpp>

namespace {

using flyball::ColourPatch;
using flyball::ImageBox;
using flyball::PixelRegion;

constexpr int least_px = 4;
// OpenCV's filter (tracking/src/trackerKCF.cpp) learns from a window twice as wide and high as the
// box and with its centre. It looks for the peak of its response in such a window about the last
// box, moves by half of it at most, and learns again there.
constexpr double learning_widths = 2.0;
constexpr double looking_widths = 4.0;
constexpr double rounding_px = 6.0;  // Boxes are cut to whole pixels, of an image halved perhaps.

// Sides without larger prime factors than 5: a Fourier transform over 74 pixels takes several times
// as long as one over 75.
int smooth(double length_px) {
  const auto is_smooth = [](int n) { return cv::getOptimalDFTSize(n) == n; };
  const int nearest = std::max(cvRound(length_px), least_px);
  for (int step = 0;; ++step) {
    for (const int n : {nearest + step, nearest - step}) {
      if (n >= least_px && is_smooth(n)) {
        return n;
      }
    }
  }
}

/// A box of smooth sides about the same middle.
ImageBox smooth(const ImageBox& box) {
  const int width_px = smooth(box.width_px);
  const int height_px = smooth(box.height_px);
  return {box.centre_x_px() - 0.5 * width_px, box.centre_y_px() - 0.5 * height_px,
          static_cast<double>(width_px), static_cast<double>(height_px)};
}

flyball::Error failed(const std::exception& error) {
  return {flyball::ErrorCode::failed, std::string{"tracker kcf: "} + error.what()};
}

class Kcf final : public flyball::Tracker {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    // MAVBench follows with .4-.6 and up; OpenCV's default is .5. Somebody who walks across the
    // view is lost then within a few frames: most of the window is ground that streams past.
    return {{"threshold", 0.25, 0.05, 0.95, "Least response of the filter that counts as seen."}};
  }

  flyball::Status configure(const flyball::Parameters& chosen,
                            const flyball::FindModel& /*find_model*/) override {
    settings_.detect_thresh = static_cast<float>(chosen.number("threshold"));
    flyball::keep_opencv_on_this_thread();
    return flyball::Done{};
  }

  [[nodiscard]] PixelRegion learns_from(const ImageBox& box,
                                        const flyball::Intrinsics& camera) const override {
    return around(smooth(box), learning_widths, camera);
  }

  [[nodiscard]] PixelRegion looks_at(const flyball::Intrinsics& camera) const override {
    return filter_ ? around(last_, looking_widths, camera) : PixelRegion{};
  }

  [[nodiscard]] flyball::Status begin(const ColourPatch& patch,
                                      const ImageBox& box,
                                      flyball::Work& work) override {
    filter_ = nullptr;
    if (const auto checked = check(patch, learns_from(box, patch.camera)); !checked) {
      return checked.error();
    }
    const cv::Size size{patch.camera.width_px, patch.camera.height_px};
    const cv::Rect image{{0, 0}, size};
    const cv::Rect seen = rounded(box) & image;
    const cv::Rect inside = rounded(smooth(box)) & image;
    if (seen.width < least_px || seen.height < least_px) {
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "less than 4 x 4 pixels of the box are inside the image"};
    }
    work.add("starts", 1.0);
    try {
      bgr_ = cv::Mat::zeros(size, CV_8UC3);
      filter_ = cv::TrackerKCF::create(settings_);
      filter_->init(as_trained(patch), inside);
      // OpenCV's learns at the first update, without looking where the thing is: so on this image.
      cv::Rect learnt = inside;
      filter_->update(bgr_, learnt);
      last_ = box_of(inside);
      seen_ = seen.size();
      return flyball::Done{};
    } catch (const std::exception& error) {
      filter_ = nullptr;
      return failed(error);
    }
  }

  [[nodiscard]] flyball::Result<std::optional<ImageBox>> update(const ColourPatch& patch,
                                                                flyball::Work& work) override {
    if (!filter_) {
      return std::optional<ImageBox>{};
    }
    if (cv::Size{patch.camera.width_px, patch.camera.height_px} != bgr_.size()) {
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "the image is not of the size that the tracker began on"};
    }
    if (const auto checked = check(patch, looks_at(patch.camera)); !checked) {
      return checked.error();
    }
    work.add("updates", 1.0);
    try {
      cv::Rect box;
      if (!filter_->update(as_trained(patch), box)) {
        return std::optional<ImageBox>{};
      }
      last_ = box_of(box);
      return std::optional{as_given(last_)};
    } catch (const std::exception& error) {
      return failed(error);
    }
  }

 private:
  static cv::Rect rounded(const ImageBox& box) {
    return {cvRound(box.x_px), cvRound(box.y_px), cvRound(box.width_px), cvRound(box.height_px)};
  }
  /// In the size that it began with, about the middle of the filter's.
  [[nodiscard]] ImageBox as_given(const ImageBox& box) const {
    return {box.centre_x_px() - 0.5 * seen_.width, box.centre_y_px() - 0.5 * seen_.height,
            static_cast<double>(seen_.width), static_cast<double>(seen_.height)};
  }
  static ImageBox box_of(const cv::Rect& box) {
    return {static_cast<double>(box.x), static_cast<double>(box.y), static_cast<double>(box.width),
            static_cast<double>(box.height)};
  }

  static PixelRegion around(const ImageBox& box, double widths, const flyball::Intrinsics& camera) {
    const double more = 0.5 * (widths - 1.0);
    return pixels_of(
        {box.x_px - more * box.width_px - rounding_px,
         box.y_px - more * box.height_px - rounding_px, widths * box.width_px + 2.0 * rounding_px,
         widths * box.height_px + 2.0 * rounding_px},
        camera);
  }

  static flyball::Status check(const ColourPatch& patch, const PixelRegion& needed) {
    const PixelRegion& given = patch.region;
    const std::size_t pixels = given.is_empty() ? 0
                                                : static_cast<std::size_t>(given.width_px) *
                                                      static_cast<std::size_t>(given.height_px);
    if (patch.camera.width_px < 1 || patch.camera.height_px < 1 ||
        !whole(patch.camera).covers(given) || patch.rgb.size() != 3 * pixels) {
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "a patch of " + std::to_string(patch.rgb.size()) +
                                " bytes is none of " + std::to_string(pixels) + " pixels of " +
                                std::to_string(patch.camera.width_px) + " x " +
                                std::to_string(patch.camera.height_px)};
    }
    if (!given.covers(needed)) {
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "the patch lacks pixels that the tracker reads; ask looks_at"};
    }
    return flyball::Done{};
  }

  /// Its colour names were learnt on blue, green, red. Outside of the patch the image keeps what it
  /// held: OpenCV copies, and may halve, all of it, but nothing of that reaches the windows.
  const cv::Mat& as_trained(const ColourPatch& patch) {
    if (!patch.region.is_empty()) {
      const PixelRegion& at = patch.region;
      cv::Mat part = bgr_({at.x_px, at.y_px, at.width_px, at.height_px});
      cv::cvtColor(flyball::borrowed(patch), part, cv::COLOR_RGB2BGR);
    }
    return bgr_;
  }

  cv::TrackerKCF::Params settings_{};
  cv::Ptr<cv::TrackerKCF> filter_{};
  cv::Mat bgr_{};
  ImageBox last_{};  ///< The filter's windows are about it.
  cv::Size seen_{};  ///< Of the box as it was given, inside the image.
};

}  // namespace

FLYBALL_PLUGIN(kcf) {
  registry.add<flyball::Tracker>("kcf", [] { return std::make_unique<Kcf>(); });
}
