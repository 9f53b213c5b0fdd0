// flyball-package: OpenCV COMPONENTS core imgproc objdetect
// flyball-link: opencv_core opencv_imgproc opencv_objdetect
// SPDX-License-Identifier: BSD-3-Clause
//
// Boosted cascades of Haar features (Viola and Jones, CVPR 2001, doi:10.1109/CVPR.2001.990517) for
// the full and the upper body (Kruppa, Castrillon-Santana and Schiele, VS-PETS 2003), as package
// opencv-data brings them.

#include "flyball/kernels/detector.h"
#include "flyball/runtime/registry.h"

#include "visual/cv_image.h"
#include "visual/cv_threads.h"
#include "visual/detection_boxes.h"
#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <system_error>

#include <opencv2/objdetect.hpp>

namespace {

using flyball::Detection;

constexpr double most_haar_overlap = 0.4;

/// Where the person's box lies in the window of a cascade.
struct Part {
  const char* file;
  double left;  ///< As shares of the window's width
  double width;
  double top;  ///< and height.
  double height;
};
// The full body's window has a margin around the person, read off opencv-doc's vtest.avi. The upper
// body's ends at the chest: a standing adult is about three of them tall.
constexpr std::array<Part, 2> parts{{{"haarcascade_fullbody.xml", 0.2, 0.6, 0.14, 0.8},
                                     {"haarcascade_upperbody.xml", 0.1, 0.8, 0.0, 3.0}}};

flyball::ImageBox person_box(const cv::Rect& window, const Part& part, double scale) {
  return {(window.x + part.left * window.width) / scale,
          (window.y + part.top * window.height) / scale, part.width * window.width / scale,
          part.height * window.height / scale};
}

class Haar final : public flyball::Detector {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"folder", std::string{"/usr/share/opencv4/haarcascades"}, 0.0, 0.0,
             "Of the cascades: package opencv-data."},
            // OpenCV's 3 and 1.1 find next to none of the people that this simulator renders.
            {"min_neighbours", 1.0, 1.0, 20.0, "Windows that must agree on a person."},
            {"level_step", 1.05, 1.01, 2.0, "Between two sizes at which people are looked for."}};
  }

  [[nodiscard]] flyball::Status configure(const flyball::Parameters& chosen,
                                          const flyball::FindModel& /*find_model*/) override {
    min_neighbours_ = static_cast<int>(std::lround(chosen.number("min_neighbours")));
    level_step_ = chosen.number("level_step");
    flyball::keep_opencv_on_this_thread();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::string file = chosen.text("folder") + "/" + parts[i].file;
      if (!load(cascades_[i], file)) {
        return flyball::Error{
            flyball::ErrorCode::not_found,
            "detector haar finds no cascade in \"" + file +
                "\"; install the package opencv-data, or set its parameter folder"};
      }
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
                            std::string{"detector haar: "} + error.what()};
    }
  }

 private:
  static bool load(cv::CascadeClassifier& cascade, const std::string& file) {
    if (std::error_code failed; !std::filesystem::is_regular_file(file, failed)) {
      return false;  // OpenCV would write about it to standard error.
    }
    try {
      return cascade.load(file) && !cascade.empty();
    } catch (const std::exception&) {
      return false;
    }
  }

  std::vector<Detection> look(const cv::Mat& rgb, double scale, flyball::Work& work) {
    cv::Mat grey;
    cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
    cv::equalizeHist(grey, grey);
    work.add("images", 1.0);
    std::vector<Detection> found;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      count(grey.size(), cascades_[i].getOriginalWindowSize(), work);
      std::vector<cv::Rect> windows;
      std::vector<int> neighbours;
      cascades_[i].detectMultiScale(grey, windows, neighbours, level_step_, min_neighbours_);
      for (std::size_t j = 0; j < windows.size(); ++j) {
        found.push_back(
            {person_box(windows[j], parts[i], scale), static_cast<double>(neighbours[j])});
      }
    }
    return flyball::keep_best(std::move(found), most_haar_overlap);
  }

  /// What `detectMultiScale` goes through: every second pixel while the window is below twice its
  /// own size, every pixel of the shrunken image beyond.
  void count(cv::Size size, cv::Size window, flyball::Work& work) const {
    for (double level = 1.0;; level *= level_step_) {
      const double width = std::round(size.width / level);
      const double height = std::round(size.height / level);
      if (width < window.width || height < window.height) {
        return;
      }
      const double step = level > 2.0 ? 1.0 : 2.0;
      work.add("pixels", width * height);
      work.add("windows",
               (width - window.width + 1.0) / step * ((height - window.height + 1.0) / step));
    }
  }

  std::array<cv::CascadeClassifier, parts.size()> cascades_{};
  int min_neighbours_{1};
  double level_step_{1.05};
};

}  // namespace

FLYBALL_PLUGIN(haar) {
  registry.add<flyball::Detector>("haar", [] { return std::make_unique<Haar>(); });
}
