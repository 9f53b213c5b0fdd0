// flyball-package: OpenCV COMPONENTS core imgproc dnn
// flyball-link: opencv_core opencv_imgproc opencv_dnn
// SPDX-License-Identifier: BSD-3-Clause
//
// A one-stage network (Redmon et al., CVPR 2016, doi:10.1109/CVPR.2016.91) in OpenCV's dnn module.
// The weights do not come with the program: see `flyball models`.

#include "flyball/kernels/detector.h"
#include "flyball/runtime/registry.h"

#include "visual/cv_image.h"
#include "visual/cv_threads.h"
#include "visual/detection_boxes.h"
#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <utility>

#include <opencv2/dnn.hpp>

namespace {

using flyball::Detection;

constexpr int grid_px = 32;  // The coarsest of its layers: sides of the input are multiples of it.
constexpr double most_overlap = 0.45;  // Darknet's default.
constexpr int person_column = 5;  // A row: centre, size, objectness, then one score per COCO class.

int on_grid(double length_px) {
  return std::max(grid_px, grid_px * static_cast<int>(std::lround(length_px / grid_px)));
}

class Yolo final : public flyball::Detector {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"model",
             std::string{"yolo-fastest-1.1"},
             0.0,
             0.0,
             "The network.",
             {"yolo-fastest-1.1", "yolo-fastest-1.1-xl"}},
            {"threshold", 0.3, 0.01, 0.99, "Least score that counts as a person."}};
  }

  [[nodiscard]] flyball::Status configure(const flyball::Parameters& chosen,
                                          const flyball::FindModel& find_model) override {
    threshold_ = chosen.number("threshold");
    flyball::keep_opencv_on_this_thread();
    const auto layers = find_model(chosen.text("model") + ".cfg");
    if (!layers) {
      return layers.error();
    }
    const auto weights = find_model(chosen.text("model") + ".weights");
    if (!weights) {
      return weights.error();
    }
    try {
      net_ = cv::dnn::readNetFromDarknet(*layers, *weights);
      net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
      net_.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
      outputs_ = net_.getUnconnectedOutLayersNames();
    } catch (const std::exception& error) {
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "no network in \"" + *weights + "\": " + error.what()};
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
      return look(flyball::borrowed(image), scale, work);
    } catch (const std::exception& error) {
      return flyball::Error{flyball::ErrorCode::failed,
                            std::string{"detector yolo: "} + error.what()};
    }
  }

 private:
  std::vector<Detection> look(const cv::Mat& rgb, double scale, flyball::Work& work) {
    const cv::Size input{on_grid(rgb.cols * scale), on_grid(rgb.rows * scale)};
    work.add("images", 1.0);
    work.add("pixels", input.area());
    work.add("multiply_adds", multiply_adds(input));
    const cv::Mat blob = cv::dnn::blobFromImage(flyball::resized(rgb, input), 1.0 / 255.0);
    net_.setInput(blob);
    std::vector<cv::Mat> layers;
    net_.forward(layers, outputs_);
    std::vector<Detection> found;
    for (const cv::Mat& rows : layers) {
      for (int i = 0; i < rows.rows; ++i) {
        add(rows.ptr<float>(i), rgb.size(), found);
      }
    }
    return flyball::keep_best(std::move(found), most_overlap);
  }

  void add(const float* row, cv::Size image, std::vector<Detection>& found) const {
    const double score = static_cast<double>(row[person_column]);
    if (!(score >= threshold_)) {
      return;  // NaN, too.
    }
    const double width = static_cast<double>(row[2]) * image.width;
    const double height = static_cast<double>(row[3]) * image.height;
    found.push_back({{static_cast<double>(row[0]) * image.width - 0.5 * width,
                      static_cast<double>(row[1]) * image.height - 0.5 * height, width, height},
                     score});
  }

  double multiply_adds(cv::Size input) {
    const std::pair<int, int> size{input.width, input.height};
    const auto known = multiply_adds_.find(size);
    if (known != multiply_adds_.end()) {
      return known->second;
    }
    // Not `getFLOPS`: it counts a depth-wise convolution as a full one.
    std::vector<int> layers;
    std::vector<std::vector<cv::dnn::MatShape>> in;
    std::vector<std::vector<cv::dnn::MatShape>> out;
    net_.getLayersShapes({1, 3, input.height, input.width}, layers, in, out);
    double count = 0.0;
    for (std::size_t i = 0; i < layers.size(); ++i) {
      const auto layer = net_.getLayer(layers[i]);
      if (layer->type == "Convolution" && !layer->blobs.empty()) {
        const cv::dnn::MatShape& made = out[i].front();  // Images, channels, rows, columns.
        count += static_cast<double>(layer->blobs.front().total()) * made[2] * made[3];
      }
    }
    multiply_adds_.emplace(size, count);
    return count;
  }

  cv::dnn::Net net_{};
  std::vector<std::string> outputs_{};
  std::map<std::pair<int, int>, double> multiply_adds_{};  ///< By input size.
  double threshold_{0.3};
};

}  // namespace

FLYBALL_PLUGIN(yolo) {
  registry.add<flyball::Detector>("yolo", [] { return std::make_unique<Yolo>(); });
}
