// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The contract of tracker.h as checks, on painted pictures of a checked square that moves.

#include "flyball/kernels/conformance/kernel_conformance.h"
#include "flyball/kernels/tracker.h"
#include "flyball/runtime/random.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

class TrackerConformance : public KernelConformance<Tracker> {
 public:
  using KernelConformance::KernelConformance;

  [[nodiscard]] std::vector<std::string> breaches() {
    return checked({}, [this] {
      check_following();
      check_lost();
      check_parts();
      check_refusals();
      check_missions();
    });
  }

 private:
  static constexpr int width_px = 120;
  static constexpr int height_px = 90;
  static constexpr int side_px = 24;

  /// The square's upper left corner is at (x, y).
  static ColourImage picture(int x, int y) {
    ColourImage image;
    image.camera = {width_px, height_px, 100.0, 0.5 * width_px, 0.5 * height_px};
    RandomStream noise{1, "tracker_conformance"};
    for (int i = 0; i < width_px * height_px; ++i) {
      const int u = i % width_px - x;
      const int v = i / width_px - y;
      const auto grey = static_cast<std::uint8_t>(100 + noise.next() % 8);
      const bool inside = u >= 0 && v >= 0 && u < side_px && v < side_px;
      const bool dark = (u / 6 + v / 8) % 2 == 0;
      image.rgb.push_back(inside ? (dark ? 20 : 230) : grey);
      image.rgb.push_back(inside ? (dark ? 20 : 60) : grey);
      image.rgb.push_back(grey);
    }
    return image;
  }
  static ImageBox box(int x, int y) { return {1.0 * x, 1.0 * y, 1.0 * side_px, 1.0 * side_px}; }
  static ColourPatch all_of(const ColourImage& image) { return cut(image, whole(image.camera)); }

  bool begins(Tracker& tracker, int x, int y, Work& work) {
    const bool begun = tracker.begin(all_of(picture(x, y)), box(x, y), work).ok();
    require(begun, "does not begin on a box inside the image");
    return begun;
  }

  void check_following() {
    const auto tracker = made();
    Work work;
    if (!begins(*tracker, 30, 30, work)) {
      return;
    }
    require(work.count("starts") == 1.0, "does not count its starts");
    for (int i = 1; i <= 8; ++i) {
      const auto seen = tracker->update(all_of(picture(30 + 3 * i, 30 + i)), work);
      require(seen.ok() && seen->has_value() && overlap(**seen, box(30 + 3 * i, 30 + i)) > 0.5,
              "does not follow what moves by an eighth of its size");
      require(work.count("updates") == i && is_countable(work), "does not count its updates");
    }
    if (begins(*tracker, 10, 60, work)) {
      const auto seen = tracker->update(all_of(picture(11, 60)), work);
      require(seen.ok() && seen->has_value() && overlap(**seen, box(11, 60)) > 0.5,
              "does not forget what it followed before");
    }
  }

  void check_lost() {
    const auto tracker = made();
    Work work;
    const auto nothing = tracker->update(all_of(picture(30, 30)), work);
    require(nothing.ok() && !nothing->has_value() && work.count("updates") == 0.0,
            "follows something before it began");
    if (begins(*tracker, 30, 30, work)) {
      const auto gone = tracker->update(all_of(picture(-50, -50)), work);
      require(gone.ok() && !gone->has_value(), "sees a thing that is gone");
    }
  }

  /// The pixels that it asks for are all that it may read.
  void check_parts() {
    const auto by_all = made();
    const auto by_part = made();
    Work work;
    const ColourImage first = picture(30, 30);
    const PixelRegion learnt = by_part->learns_from(box(30, 30), first.camera);
    require(whole(first.camera).covers(learnt), "asks for pixels outside of the image");
    if (!whole(first.camera).covers(learnt) || !begins(*by_all, 30, 30, work) ||
        !by_part->begin(cut(first, learnt), box(30, 30), work).ok()) {
      require(false, "does not begin on the pixels that it asks for");
      return;
    }
    for (int i = 1; i <= 5; ++i) {
      const ColourImage next = picture(30 + 4 * i, 30 - i);
      const PixelRegion wanted = by_part->looks_at(next.camera);
      if (!whole(next.camera).covers(wanted)) {
        require(false, "asks for pixels outside of the image");
        return;
      }
      const auto all = by_all->update(all_of(next), work);
      const auto part = by_part->update(cut(next, wanted), work);
      require(all.ok() && part.ok() && is_equal(*all, *part),
              "answers differently when it is shown more than it asks for");
    }
  }
  static bool is_equal(const std::optional<ImageBox>& a, const std::optional<ImageBox>& b) {
    return a.has_value() == b.has_value() &&
           (!a || (a->x_px == b->x_px && a->y_px == b->y_px && a->width_px == b->width_px &&
                   a->height_px == b->height_px));
  }

  void check_refusals() {
    const auto is_refused = [](const auto& answer) {
      return !answer.ok() && answer.error().code == ErrorCode::invalid_input &&
             !answer.error().message.empty();
    };
    const auto tracker = made();
    Work work;
    require(is_refused(tracker->begin(all_of(picture(30, 30)), box(119, 89), work)),
            "begins on a box of which next to nothing is inside the image");
    const auto after = tracker->update(all_of(picture(30, 30)), work);
    require(after.ok() && !after->has_value(), "follows something although it could not begin");
    ColourPatch short_patch = all_of(picture(30, 30));
    short_patch.rgb.resize(100);
    require(is_refused(made()->begin(short_patch, box(30, 30), work)),
            "accepts a patch of which pixels are missing");
    if (begins(*tracker, 30, 30, work)) {
      ColourImage small;
      small.camera = {16, 16, 10.0, 8.0, 8.0};
      small.rgb.assign(3UL * 16 * 16, 100);
      require(is_refused(tracker->update(all_of(small), work)),
              "accepts an image of another size than it began on");
      require(is_refused(tracker->update(short_patch, work)),
              "accepts a patch of which pixels are missing");
    }
  }

  void check_missions() {
    const auto flown = [this] {
      const auto tracker = made();
      Work work;
      std::vector<double> trace;
      static_cast<void>(begins(*tracker, 40, 30, work));
      for (int i = 1; i <= 4; ++i) {
        const auto seen = tracker->update(all_of(picture(40 + 2 * i, 30 + 2 * i)), work);
        const ImageBox at = seen.ok() ? seen->value_or(ImageBox{}) : ImageBox{};
        trace.insert(trace.end(), {at.x_px, at.y_px, at.width_px, at.height_px});
      }
      return trace;
    };
    require(flown() == flown(), "follows differently in a second mission");
  }
};

}  // namespace flyball
