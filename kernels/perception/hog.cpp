// flyball-package: OpenCV COMPONENTS core imgproc objdetect
// flyball-link: opencv_core opencv_imgproc opencv_objdetect
// SPDX-License-Identifier: BSD-3-Clause
//
// Histograms of oriented gradients and a linear classifier (Dalal and Triggs, CVPR 2005,
// doi:10.1109/CVPR.2005.177): OpenCV's, with the weights that it brings along.

#include "flyball/kernels/detector.h"
#include "flyball/runtime/registry.h"

#include "visual/cv_image.h"
#include "visual/cv_threads.h"
#include "visual/detection_boxes.h"
#include <cmath>
#include <exception>

#include <opencv2/objdetect.hpp>

namespace {

using flyball::Detection;

constexpr int stride_px = 8;     // One cell: OpenCV's own step.
constexpr int padding_px = 8;    // A person at the edge of the image needs a margin, too.
constexpr int most_levels = 64;  // OpenCV's limit.
constexpr double most_hog_overlap = 0.4;

// The trained window of 64 x 128 pixels has a margin of 16 around the person (Dalal and Triggs,
// section 4).
flyball::ImageBox without_margin(const cv::Rect& window, double scale) {
  return {(window.x + 0.25 * window.width) / scale, (window.y + 0.125 * window.height) / scale,
          0.5 * window.width / scale, 0.75 * window.height / scale};
}

class Hog final : public flyball::Detector {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"threshold", 0.0, -1.0, 2.0, "Distance from the classifier's plane that counts."},
            {"level_step", 1.05, 1.01, 2.0, "Between two sizes at which people are looked for."}};
  }

  [[nodiscard]] flyball::Status configure(const flyball::Parameters& chosen,
                                          const flyball::FindModel& /*find_model*/) override {
    threshold_ = chosen.number("threshold");
    level_step_ = chosen.number("level_step");
    flyball::keep_opencv_on_this_thread();
    try {
      hog_.setSVMDetector(cv::HOGDescriptor::getDefaultPeopleDetector());
    } catch (const std::exception& error) {
      return flyball::Error{flyball::ErrorCode::failed,
                            std::string{"detector hog: "} + error.what()};
    }
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Result<std::vector<Detection>> detect(const flyball::ColourImage& image,
                                                               double scale,
                                                               flyball::Work& work) override {
    if (const auto checked = flyball::check_detector_input(image, scale); !checked) {
      return checked.error();
    }
    try {
      return look(flyball::scaled(flyball::borrowed(image), scale), scale, work);
    } catch (const std::exception& error) {
      return flyball::Error{flyball::ErrorCode::failed,
                            std::string{"detector hog: "} + error.what()};
    }
  }

 private:
  std::vector<Detection> look(const cv::Mat& rgb, double scale, flyball::Work& work) {
    work.add("images", 1.0);
    count(rgb.size(), work);
    if (rgb.cols < hog_.winSize.width || rgb.rows < hog_.winSize.height) {
      return {};
    }
    cv::Mat bgr;  // As it was trained; the gradient is that of the strongest channel.
    cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    std::vector<cv::Rect> windows;
    std::vector<double> weights;
    constexpr double group = 2.0;  // OpenCV's default: windows that must agree.
    hog_.detectMultiScale(bgr, windows, weights, threshold_, {stride_px, stride_px},
                          {padding_px, padding_px}, level_step_, group);
    std::vector<Detection> found;
    for (std::size_t i = 0; i < windows.size(); ++i) {
      found.push_back({without_margin(windows[i], scale), i < weights.size() ? weights[i] : 0.0});
    }
    return flyball::keep_best(std::move(found), most_hog_overlap);
  }

  /// What `detectMultiScale` goes through.
  void count(cv::Size size, flyball::Work& work) const {
    double level = 1.0;
    for (int i = 0; i < most_levels; ++i, level *= level_step_) {
      const double width = std::round(size.width / level);
      const double height = std::round(size.height / level);
      if (width < hog_.winSize.width || height < hog_.winSize.height) {
        return;
      }
      const auto steps = [](double length, int window) {
        return std::floor((length + 2.0 * padding_px - window) / stride_px) + 1.0;
      };
      work.add("pixels", width * height);
      work.add("windows", steps(width, hog_.winSize.width) * steps(height, hog_.winSize.height));
    }
  }

  cv::HOGDescriptor hog_{};
  double threshold_{};
  double level_step_{1.05};
};

}  // namespace

FLYBALL_PLUGIN(hog) {
  registry.add<flyball::Detector>("hog", [] { return std::make_unique<Hog>(); });
}
