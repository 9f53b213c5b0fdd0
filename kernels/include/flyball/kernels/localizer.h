// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Localization: what navigation sensors and cameras say in, a pose out.

#include "flyball/kernels/visual_frame.h"
#include "flyball/runtime/imu.h"
#include "flyball/runtime/kernel.h"
#include "flyball/runtime/messages.h"
#include "flyball/runtime/result.h"
#include "flyball/runtime/work.h"

#include <optional>

namespace flyball {

/// A localizer that looks at frames carries the place on by its last speed for so long without one.
/// At 5 m/s^2 that speed is wrong by 2.5 m/s by then.
inline constexpr double longest_reckoning_s = 0.5;

/// What a localizer lives on beside navigation samples.
struct LocalizerInputs {
  bool images{};
  bool depth{};  ///< With each image.
  bool imu{};
  bool truth{};  ///< Only a simulator can fly it.
};

/// A visual localizer is told where it starts (`set_initial_pose`) and tracks frames
/// (`track_frame`). When the computer is through with a frame, it is given the fix that came of it
/// (`correct`): what `estimate` says depends on the frame only from then on.
///
/// Two threads may use one localizer at the same time once it has been placed: the first calls
/// `apply`, `add_imu_sample` and `track_frame`, the second `set_true_pose`, `correct` and
/// `estimate`. So these two groups share no state; what one has to tell the other goes through
/// `VisualFix` and `VisualFrame::X_WB_reckoned`.
class Localizer : public Kernel {
 public:
  /// Once it is configured: where W lies. What was estimated before is forgotten.
  virtual void start(const GeodeticOrigin& origin) = 0;
  /// Samples arrive in order of their stamps. Adds `samples` to `work`. Empty as long as nothing
  /// has told where the vehicle is, as before the first fix of a satellite receiver.
  [[nodiscard]] virtual std::optional<PoseEstimate> estimate(const NavigationSample& sample,
                                                             Work& work) = 0;

  [[nodiscard]] virtual LocalizerInputs inputs() const { return {}; }
  /// Where the vehicle stands; to be said before the first frame, and it stands still until then.
  virtual void set_initial_pose(const Pose& /*X_WB*/) {}
  /// Where the vehicle truly is, before the sample of the same time; for `inputs().truth`.
  virtual void set_true_pose(const TruePose& /*pose*/) {}
  /// In order of their stamps; those up to a frame's time before the frame.
  virtual void add_imu_sample(const ImuSample& /*sample*/) {}
  /// Frames in order of their times. Adds what it did to `work`.
  /// @error `unavailable` when it takes no images, `invalid_input` when image and camera differ in
  /// size.
  [[nodiscard]] virtual Result<VisualFix> track_frame(const VisualFrame& /*frame*/,
                                                      Work& /*work*/) {
    return Error{ErrorCode::unavailable, "this localizer looks at no images"};
  }
  virtual void correct(const VisualFix& /*fix*/) {}
};

}  // namespace flyball
