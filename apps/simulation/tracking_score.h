// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How well a person was followed, measured against where the person truly was.

#include "flyball/flight/mission_frame.h"

#include "flight/people/target_nodes.h"
#include <map>
#include <string>
#include <vector>

namespace flyball {

class TrackingScore {
 public:
  /// Records each frame on the context's recorder.
  explicit TrackingScore(MissionContext& context) : context_{context} {}

  /// One tracked frame. It counts as tracked when the box lies on the person's true box: overlap
  /// over union of at least .2, which a box of half the height, or of arms' width, still has.
  void count(MissionTime now, const Target& target);
  /// Time in which the box was on the person, from frame to frame; gaps of up to 1 s count when the
  /// person was tracked on both sides.
  [[nodiscard]] double tracked_s() const { return tracked_s_; }
  /// `tracked_s`, `mean_centre_error_percent` (distance of the tracked box's centre from the
  /// frame's, over half the frame's diagonal), `wrong_box_percent` (of frames with a box).
  [[nodiscard]] std::map<std::string, double> figures() const;
  /// The first tracked frame, one of each 15 s, and the last, with their boxes.
  [[nodiscard]] std::vector<MissionFrame> frames() const;

 private:
  MissionContext& context_;
  std::optional<MissionTime> last_on_target_{};
  double tracked_s_{};
  double centre_error_sum_{};
  std::uint64_t frames_with_box_{};
  std::uint64_t frames_on_target_{};
  struct Kept {
    Target target{};
    bool on_target{};
  };
  void keep(const Kept& seen);
  std::vector<Kept> kept_{};  ///< The last one is replaced until it is old enough to stay.
  std::optional<MissionTime> kept_at_{};
};

}  // namespace flyball
