// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How well the vehicle knows where it is, and what it does when it no longer does.

#include "flyball/kernels/visual_frame.h"
#include "flyball/runtime/messages.h"

#include <deque>
#include <map>
#include <optional>
#include <string>

namespace flyball {

class LocalizationWatch {
 public:
  /// A visual fix came, or failed to.
  void fixed(MissionTime now, const VisualFix& fix);
  [[nodiscard]] bool is_lost() const { return lost_since_.has_value(); }
  /// Lost for longer than turning and flying back take: it will not be found any more.
  [[nodiscard]] bool has_given_up(MissionTime now) const;

  /// Where the vehicle came along; call with every estimate while it is not lost.
  void passed(const PoseEstimate& estimate);

  /// While lost: it stops where it last knew that it was, looks to both sides, flies back three
  /// metres of its own path, and looks again. Positions are the flight controller's, which holds
  /// them without the companion computer. It stays as high as it was when the search began: by then
  /// it may have climbed.
  [[nodiscard]] std::optional<Setpoint> search(MissionTime now, double height_W_m);

  /// `localization_lost` (times), `localization_lost_s`; without images none.
  [[nodiscard]] std::map<std::string, double> quality(MissionTime now) const;

 private:
  /// Where it was so much of its path ago, as far as is remembered.
  [[nodiscard]] const PoseEstimate& passed_before(double path_m) const;

  std::deque<PoseEstimate> trail_{};  ///< A decimetre apart, newest last.
  std::optional<MissionTime> lost_since_{};
  std::optional<double> search_height_W_m_{};
  bool has_fixes_{};
  int times_lost_{};
  double lost_s_{};
};

}  // namespace flyball
