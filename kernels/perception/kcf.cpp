// flyball-package: OpenCV COMPONENTS core imgproc tracking
// flyball-link: opencv_core opencv_imgproc opencv_tracking
// SPDX-License-Identifier: BSD-3-Clause
//
// Kernelised correlation filter (Henriques et al. 2015, doi:10.1109/TPAMI.2014.2345390), OpenCV's.
// The box keeps the size that it began with.

#include "flyball/kernels/tracker.h"
#include "flyball/runtime/registry.h"

#include "cv_image.h"
#include "detection_boxes.h"
#include <exception>

#include <opencv2/tracking.hpp>

namespace {

using flyball::ImageBox;

constexpr int least_px = 4;

flyball::Error failed(const std::exception& error) {
  return {flyball::ErrorCode::failed, std::string{"tracker kcf: "} + error.what()};
}

class Kcf final : public flyball::Tracker {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    // MAVBench follows with .4-.6 and up; OpenCV's default is .5.
    return {{"threshold", 0.4, 0.05, 0.95, "Least response of the filter that counts as seen."}};
  }

  void configure(const flyball::Parameters& chosen) override {
    settings_.detect_thresh = static_cast<float>(chosen.number("threshold"));
  }

  [[nodiscard]] flyball::Status begin(const flyball::ColourImage& image,
                                      const ImageBox& box,
                                      flyball::Work& work) override {
    filter_ = nullptr;
    if (const auto checked = flyball::check_detector_input(image, 1.0); !checked) {
      return checked.error();
    }
    size_ = {image.camera.width_px, image.camera.height_px};
    const cv::Rect inside = cv::Rect{cvRound(box.x_px), cvRound(box.y_px), cvRound(box.width_px),
                                     cvRound(box.height_px)} &
                            cv::Rect{{0, 0}, size_};
    if (inside.width < least_px || inside.height < least_px) {
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "less than 4 x 4 pixels of the box are inside the image"};
    }
    work.add("starts", 1.0);
    try {
      cv::setNumThreads(1);
      filter_ = cv::TrackerKCF::create(settings_);
      const cv::Mat first = as_trained(image);
      filter_->init(first, inside);
      // OpenCV's learns at the first update, without looking where the thing is: so on this image.
      cv::Rect learnt = inside;
      filter_->update(first, learnt);
      return flyball::Done{};
    } catch (const std::exception& error) {
      filter_ = nullptr;
      return failed(error);
    }
  }

  [[nodiscard]] flyball::Result<std::optional<ImageBox>> update(const flyball::ColourImage& image,
                                                                flyball::Work& work) override {
    if (!filter_) {
      return std::optional<ImageBox>{};
    }
    if (cv::Size{image.camera.width_px, image.camera.height_px} != size_ ||
        !flyball::check_detector_input(image, 1.0)) {
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "the image is not of the size that the tracker began on"};
    }
    work.add("updates", 1.0);
    try {
      cv::setNumThreads(1);
      cv::Rect box;
      if (!filter_->update(as_trained(image), box)) {
        return std::optional<ImageBox>{};
      }
      return std::optional<ImageBox>{
          ImageBox{static_cast<double>(box.x), static_cast<double>(box.y),
                   static_cast<double>(box.width), static_cast<double>(box.height)}};
    } catch (const std::exception& error) {
      return failed(error);
    }
  }

 private:
  /// Its colour names were learnt on blue, green, red.
  static cv::Mat as_trained(const flyball::ColourImage& image) {
    cv::Mat bgr;
    cv::cvtColor(flyball::borrowed(image), bgr, cv::COLOR_RGB2BGR);
    return bgr;
  }

  cv::TrackerKCF::Params settings_{};
  cv::Ptr<cv::TrackerKCF> filter_{};
  cv::Size size_{};
};

}  // namespace

FLYBALL_PLUGIN(kcf) {
  registry.add<flyball::Tracker>("kcf", [] { return std::make_unique<Kcf>(); });
}
