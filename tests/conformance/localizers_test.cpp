// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/kernels/conformance/localizer_conformance.h"

#include "kernel_trials.h"

#include <gtest/gtest.h>

namespace flyball {
namespace {

/// An honest localizer whose estimate is spoilt.
class LocalizerCulprit final : public Localizer {
 public:
  explicit LocalizerCulprit(std::string crime) : crime_{std::move(crime)} {}

  void start(const GeodeticOrigin& origin) override {
    honest_->start(origin);
    if (crime_ != "remembers") {
      off_m_ = 0.0;
    }
  }
  [[nodiscard]] LocalizerInputs inputs() const override {
    LocalizerInputs inputs = honest_->inputs();
    inputs.images = crime_ == "any_frame";
    return inputs;
  }
  void set_true_pose(const TruePose& pose) override { honest_->set_true_pose(pose); }

  std::optional<PoseEstimate> estimate(const NavigationSample& sample, Work& work) override {
    Work honest;
    const auto found = honest_->estimate(sample, honest);
    work.add("samples", crime_ == "idle" ? 0.0 : 1.0);
    if (crime_ == "silent" || (!found && crime_ != "invents")) {
      return std::nullopt;
    }
    PoseEstimate estimate = found.value_or(PoseEstimate{sample.stamp});
    off_m_ += crime_ == "drifts"      ? 0.01
              : crime_ == "remembers" ? 1e-6
              : crime_ == "leaks"     ? 1e-9 * all_missions_++
                                      : 0.0;
    if (crime_ == "poisoned" && !std::isfinite(sample.latitude_rad)) {
      off_m_ = std::nan("");
    }
    estimate.X_WB.translation().x() += off_m_;
    if (crime_ == "timeless") {
      estimate.stamp = {};
    } else if (crime_ == "twisted") {
      estimate.X_WB.linear() *= 1.1;
    } else if (crime_ == "turned") {
      estimate.X_WB.linear() = Eigen::AngleAxisd{0.3, Vec3::UnitZ()}.toRotationMatrix();
    }
    return estimate;
  }
  [[nodiscard]] Result<VisualFix> track_frame(const VisualFrame& frame, Work& work) override {
    if (crime_ == "imagines" || crime_ == "any_frame") {
      VisualFix fix;
      fix.tracked = true;
      return fix;
    }
    return Localizer::track_frame(frame, work);
  }

 private:
  inline static double all_missions_ = 0.0;
  std::string crime_;
  std::unique_ptr<Localizer> honest_{kit::kernels().make<Localizer>("truth")};
  double off_m_{};
};

TEST(Localizers, keep_their_contract) {
  kit::try_all_registered<LocalizerConformance, Localizer>();
}

TEST(LocalizerConformance, finds_each_kind_of_breach) {
  kit::expect_crimes_found<LocalizerConformance, Localizer>(
      [](const std::string& crime) { return std::make_unique<LocalizerCulprit>(crime); },
      {{"remembers", "does not forget the last mission at its start"},
       {"any_frame", "accepts a frame that is not of its camera's size"},
       {"idle", "does not count its samples"},
       {"drifts", "is off by more than .3 m"},
       {"leaks", "estimates differently in a second mission"},
       {"poisoned", "is poisoned by a fix that is not finite"},
       {"silent", "estimates no pose although it was told where it is"},
       {"invents", "estimates a pose before anything told it one"},
       {"timeless", "does not stamp its estimate"},
       {"twisted", "estimates a pose that is none"},
       {"turned", "is wrong about the attitude"},
       {"imagines", "answers a frame although it looks at no images"}});
}

}  // namespace
}  // namespace flyball
