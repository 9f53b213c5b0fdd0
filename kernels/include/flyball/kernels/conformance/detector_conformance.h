// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The contract of detector.h as checks, on plain pictures, in which nobody is, and on pictures of
/// people that whoever tries a detector brings along.

#include "flyball/kernels/conformance/kernel_conformance.h"
#include "flyball/kernels/detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace flyball {

/// A person whom a detector of that kind should find.
struct PicturedPerson {
  ColourImage image{};
  ImageBox box{};
  double scale{1.0};  ///< At which it should be looked at.
};

class DetectorConformance : public KernelConformance<Detector> {
 public:
  /// @param people  One of them at least must be found, since no detector finds everybody; none:
  ///                that check is left out.
  explicit DetectorConformance(KernelCandidate<Detector> candidate,
                               std::vector<PicturedPerson> people = {})
      : KernelConformance{std::move(candidate)}, people_{std::move(people)} {}

  [[nodiscard]] std::vector<std::string> breaches() {
    return checked({"detector.scale"}, [this] {
      check_nobody();
      check_people();
      check_refusals();
      check_work();
    });
  }

 private:
  static constexpr double least_overlap = 0.25;

  /// Grey that fades towards the bottom.
  static ColourImage plain(int width_px, int height_px) {
    ColourImage image;
    image.camera = {width_px, height_px, 200.0, 0.5 * width_px, 0.5 * height_px};
    for (int row = 0; row < height_px; ++row) {
      image.rgb.insert(image.rgb.end(), static_cast<std::size_t>(3 * width_px),
                       static_cast<std::uint8_t>(200 - row / 4));
    }
    return image;
  }

  void check_boxes(const std::vector<Detection>& found, const Intrinsics& camera) {
    const ImageBox frame{0.0, 0.0, 1.0 * camera.width_px, 1.0 * camera.height_px};
    for (const Detection& one : found) {
      const ImageBox& box = one.box;
      require(std::isfinite(box.x_px) && std::isfinite(box.y_px) && std::isfinite(one.score) &&
                  box.width_px > 0.0 && box.height_px > 0.0,
              "finds a box without extent, or a score that is no number");
      require(overlap(box, frame) > 0.0, "finds somebody outside of the image");
    }
    require(
        std::is_sorted(found.begin(), found.end(),
                       [](const Detection& a, const Detection& b) { return a.score > b.score; }),
        "does not put the surest first");
  }

  void check_nobody() {
    for (const auto& [width_px, height_px] : {std::pair{160, 160}, std::pair{8, 8}}) {
      Work work;
      const auto found = made()->detect(plain(width_px, height_px), 1.0, work);
      require(found.ok(), "refuses an ordinary picture");
      require(!found || found->empty(), "finds somebody in a plain picture");
    }
  }

  /// The last question is asked again of a detector that was asked nothing else.
  void check_people() {
    const auto used = made();
    bool found_one = people_.empty();
    std::vector<Detection> last;
    for (const PicturedPerson& person : people_) {
      Work work;
      auto found = used->detect(person.image, person.scale, work);
      if (!found) {
        require(false, "refuses an ordinary picture");
        return;
      }
      check_boxes(*found, person.image.camera);
      found_one = found_one || std::any_of(found->begin(), found->end(), [&](const auto& one) {
                    return overlap(one.box, person.box) > least_overlap;
                  });
      last = std::move(*found);
    }
    require(found_one, "finds none of the people that it was shown");
    if (!people_.empty()) {
      Work work;
      const auto fresh = made()->detect(people_.back().image, people_.back().scale, work);
      require(fresh.ok() && is_equal(*fresh, last), "finds others after other pictures");
    }
  }

  void check_refusals() {
    const auto detector = made();
    const auto is_refused = [&](const ColourImage& image, double scale) {
      Work work;
      const auto found = detector->detect(image, scale, work);
      return !found && found.error().code == ErrorCode::invalid_input &&
             !found.error().message.empty();
    };
    ColourImage short_one = plain(160, 160);
    short_one.rgb.resize(1000);
    require(is_refused({}, 1.0) && is_refused(short_one, 1.0),
            "accepts an image that is empty, or not of its camera's size");
    for (const double scale : {0.0, -1.0, 9.0, std::numeric_limits<double>::quiet_NaN()}) {
      require(is_refused(plain(160, 160), scale), "accepts a scale that is not in (0, 8]");
    }
  }

  void check_work() {
    const auto detector = made();
    Work small;
    Work large;
    static_cast<void>(detector->detect(plain(192, 192), 0.75, small));
    static_cast<void>(detector->detect(plain(192, 192), 1.5, large));
    require(small.count("images") == 1.0, "does not count its images");
    require(small.count("pixels") > 0.0, "counts no pixels");
    require_work(large, small);
    Work wide;
    static_cast<void>(detector->detect(plain(384, 192), 0.75, wide));
    require_work(wide, small);
  }

  static bool is_equal(const std::vector<Detection>& one, const std::vector<Detection>& other) {
    return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                      [](const Detection& a, const Detection& b) {
                        return a.score == b.score && a.box.x_px == b.box.x_px &&
                               a.box.y_px == b.box.y_px && a.box.width_px == b.box.width_px &&
                               a.box.height_px == b.box.height_px;
                      });
  }

  std::vector<PicturedPerson> people_;
};

}  // namespace flyball
