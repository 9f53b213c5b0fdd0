// flyball-package: OpenCV COMPONENTS core imgproc features2d calib3d
// flyball-link: opencv_core opencv_features2d opencv_calib3d
// SPDX-License-Identifier: BSD-3-Clause
//
// Visual SLAM on RGB-D frames: ORB features, PnP with RANSAC, keyframes, a pose graph when a loop
// closes. Between frames the pose is reckoned on. It loses its track when two frames show too
// little in common, and finds it again when it sees a place that it knows. A map that has hardly
// begun is not worth looking for: it begins anew where the vehicle is reckoned to be.

#include "flyball/kernels/localizer.h"
#include "flyball/runtime/registry.h"

#include "visual/dead_reckoning.h"
#include "visual/slam.h"
#include <cmath>

namespace {

using flyball::Pose;
using flyball::Vec3;
using flyball::VisualFix;

class VisualSlam final : public flyball::VisualLocalizer {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    const flyball::FeatureSettings usual;
    return {{"pixels_per_feature", static_cast<double>(usual.pixels_per_feature), 16.0, 4096.0,
             "one point in so many pixels at most"},
            {"weak_corner", static_cast<double>(usual.weak_corner), 1.0, 100.0,
             "grey levels of the least contrast of a corner; ORB-SLAM2: 7"},
            {"strong_corner", static_cast<double>(usual.strong_corner), 1.0, 100.0,
             "a corner of so much contrast hides weaker ones near it; ORB-SLAM2: 20"}};
  }
  flyball::Status configure(const flyball::Parameters& chosen,
                            const flyball::FindModel& /*find_model*/) override {
    const auto whole = [&chosen](const char* name) {
      return static_cast<int>(std::lround(chosen.number(name)));
    };
    slam_ = std::make_unique<flyball::Slam>(flyball::SlamSettings{
        {whole("pixels_per_feature"), whole("weak_corner"), whole("strong_corner")}});
    return flyball::Done{};
  }
  void start(const flyball::GeodeticOrigin& /*origin*/) override {
    set_initial_pose(Pose::Identity());
  }
  [[nodiscard]] flyball::LocalizerInputs inputs() const override { return {true, true, false}; }

  void set_initial_pose(const Pose& X_WB) override {
    last_ = {};
    last_.X_WB = X_WB;
    reckon_from(X_WB);
    has_begun_ = false;
  }

  flyball::Result<VisualFix> track_frame(const flyball::VisualFrame& frame,
                                         flyball::Work& work) override {
    if (!has_begun_) {
      slam_->start(last_.X_WB * frame.X_BC);
      has_begun_ = true;
    }
    auto outcome = slam_->track(frame, work);
    if (outcome && !outcome->tracked && frame.X_WB_reckoned && is_young()) {
      slam_->start(*frame.X_WB_reckoned * frame.X_BC);
      outcome = slam_->track(frame, work);
    }
    if (!outcome) {
      return outcome.error();
    }
    VisualFix fix = last_;
    fix.captured = frame.captured;
    fix.tracked = outcome->tracked;
    fix.matches = outcome->matches;
    fix.inliers = outcome->inliers;
    fix.keyframes = static_cast<int>(slam_->map().keyframes().size());
    fix.loops_closed += outcome->loop_closed ? 1 : 0;
    if (outcome->tracked) {
      fix.X_WB = outcome->X_WC * frame.X_BC.inverse();
      fix.v_WB = speed_to(fix, outcome->loop_closed);
      fix.covariance_W = covariance_W(*outcome, frame.X_BC);
    }
    last_ = fix;
    return fix;
  }

 private:
  /// Of the body's position.
  [[nodiscard]] static Eigen::Matrix3d covariance_W(const flyball::SlamOutcome& outcome,
                                                    const Pose& X_BC) {
    const flyball::Matrix6 by = flyball::carried(X_BC);
    const flyball::Matrix6 of_B = by * outcome.covariance * by.transpose();
    const Eigen::Matrix3d R_WB = outcome.X_WC.linear() * X_BC.linear().transpose();
    return R_WB * of_B.topLeftCorner<3, 3>() * R_WB.transpose();
  }

  /// ORB-SLAM2 resets a map that is lost with five keyframes or fewer (Mur-Artal & Tardos 2017, the
  /// authors' code). Where the vehicle is then must be known some other way: while it climbs from
  /// the ground, when the ground fills the image and changes fastest, its height is.
  [[nodiscard]] bool is_young() const {
    constexpr std::size_t few_keyframes = 5;
    return slam_->map().keyframes().size() <= few_keyframes;
  }

  /// Half of the new difference quotient: a centimetre of noise in 50 ms is .2 m/s. A loop moves
  /// the pose, not the vehicle.
  [[nodiscard]] Vec3 speed_to(const VisualFix& fix, bool loop_closed) const {
    const double dt_s = flyball::to_seconds(fix.captured - last_.captured);
    if (!last_.tracked || dt_s <= 0.0) {
      return Vec3::Zero();
    }
    if (loop_closed) {
      return last_.v_WB;
    }
    const Vec3 newest = (fix.X_WB.translation() - last_.X_WB.translation()) / dt_s;
    return 0.5 * (last_.v_WB + newest);
  }

  std::unique_ptr<flyball::Slam> slam_{std::make_unique<flyball::Slam>(flyball::SlamSettings{})};
  VisualFix last_{};
  bool has_begun_{};
};

}  // namespace

FLYBALL_PLUGIN(visual_slam) {
  registry.add<flyball::Localizer>("visual_slam", [] { return std::make_unique<VisualSlam>(); });
}
