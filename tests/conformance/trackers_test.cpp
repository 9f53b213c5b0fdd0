// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/conformance/tracker_conformance.h"

#include "kernel_trials.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// An honest tracker whose answers are spoilt.
class TrackerCulprit final : public Tracker {
 public:
  explicit TrackerCulprit(std::string crime) : crime_{std::move(crime)} {}

  [[nodiscard]] PixelRegion learns_from(const ImageBox& box,
                                        const Intrinsics& camera) const override {
    PixelRegion region = honest_->learns_from(box, camera);
    if (crime_ == "demands") {
      region.x_px -= 200;
    }
    return region;
  }
  [[nodiscard]] PixelRegion looks_at(const Intrinsics& camera) const override {
    return honest_->looks_at(camera);
  }
  [[nodiscard]] Status begin(const ColourPatch& patch, const ImageBox& box, Work& work) override {
    if (crime_ == "faithful" && has_begun_) {
      return Done{};
    }
    first_ = box;
    Status begun = honest_->begin(patch, box, work);
    has_begun_ = has_begun_ || begun.ok();
    return crime_ == "credulous" ? Status{Done{}} : begun;
  }
  [[nodiscard]] Result<std::optional<ImageBox>> update(const ColourPatch& patch,
                                                       Work& work) override {
    Work honest;
    auto seen = honest_->update(patch, honest);
    if (!seen) {
      return crime_ == "blind_eye" ? Result<std::optional<ImageBox>>{first_} : seen;
    }
    work.add("updates", crime_ == "idle" ? 0.0 : honest.count("updates"));
    if (crime_ == "stays" && *seen) {
      return std::optional{first_};
    }
    if (crime_ == "sees_ghosts" && !*seen) {
      return std::optional{first_};
    }
    if (crime_ == "peeks" && *seen && patch.region.width_px == patch.camera.width_px) {
      (*seen)->x_px += 0.5;
    }
    if (crime_ == "remembers" && *seen) {
      (*seen)->x_px += 1e-6 * all_missions_++;
    }
    return seen;
  }

 private:
  inline static int all_missions_ = 0;
  std::string crime_;
  std::unique_ptr<Tracker> honest_{kit::kernels().make<Tracker>("kcf")};
  ImageBox first_{};
  bool has_begun_{};
};

TEST(Trackers, keep_their_contract) {
  kit::try_all_registered<TrackerConformance, Tracker>();
}

TEST(TrackerConformance, finds_each_kind_of_breach) {
  kit::expect_crimes_found<TrackerConformance, Tracker>(
      [](const std::string& crime) { return std::make_unique<TrackerCulprit>(crime); },
      {{"demands", "asks for pixels outside of the image"},
       {"faithful", "does not forget what it followed before"},
       {"credulous", "begins on a box of which next to nothing is inside"},
       {"blind_eye", "accepts an image of another size"},
       {"idle", "does not count its updates"},
       {"stays", "does not follow what moves"},
       {"sees_ghosts", "sees a thing that is gone"},
       {"peeks", "answers differently when it is shown more"},
       {"remembers", "follows differently in a second mission"}});
}

}  // namespace
}  // namespace flyball
