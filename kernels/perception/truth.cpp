// SPDX-License-Identifier: BSD-3-Clause
//
// The simulator's own pose: what a perfect localizer would say.

#include "flyball/kernels/localizer.h"
#include "flyball/runtime/registry.h"

#include <optional>

namespace {

class Truth final : public flyball::Localizer {
 public:
  void start(const flyball::GeodeticOrigin& /*origin*/) override { truth_ = std::nullopt; }

  std::optional<flyball::PoseEstimate> estimate(const flyball::NavigationSample& sample,
                                                flyball::Work& work) override {
    work.add("samples", 1.0);
    if (!truth_) {
      return std::nullopt;
    }
    return flyball::PoseEstimate{sample.stamp, truth_->X_WB, truth_->v_WB};
  }

  [[nodiscard]] flyball::LocalizerInputs inputs() const override {
    flyball::LocalizerInputs inputs;
    inputs.truth = true;
    return inputs;
  }
  void set_true_pose(const flyball::TruePose& pose) override { truth_ = pose; }

 private:
  std::optional<flyball::TruePose> truth_{};
};

}  // namespace

FLYBALL_PLUGIN(truth) {
  registry.add<flyball::Localizer>("truth", [] { return std::make_unique<Truth>(); });
}
