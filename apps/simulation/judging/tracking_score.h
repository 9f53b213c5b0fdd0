// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How well a person was followed, measured against where the person truly was.

#include "flyball/flight/people/target_nodes.h"
#include "flyball/flight/people/tracked_time.h"
#include "flyball/sim/person.h"

#include "simulation/judging/judge.h"
#include "simulation/mission_link.h"
#include <deque>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace flyball {

class TrackingScore final : public Judge {
 public:
  /// Logs each frame. All arguments outlive the score.
  TrackingScore(MissionLink& link, const std::vector<Person>& people)
      : link_{link}, people_{people} {}

  /// Where the camera truly was when it took a picture; before `count` of that picture.
  void note(std::uint64_t sequence, const Pose& X_WC);

  /// One tracked frame. It counts as tracked when the box lies on the person's true box: overlap
  /// over union of at least .2, which a box of half the height, or of arms' width, still has.
  void count(const Target& target);
  /// Time in which the box was on the person.
  [[nodiscard]] double tracked_s() const { return tracked_.seconds(); }
  /// `target_lost` when the person was tracked for less than the mission asks for.
  [[nodiscard]] MissionFailure objection() const override;
  /// `tracked_s`, `mean_centre_error_percent` (distance of the tracked box's centre from the
  /// frame's, over half the frame's diagonal, where the box is on the person),
  /// `mean_person_error_percent` (the same of the nearest person's true box, in all frames; 100
  /// where nobody is in the picture), `wrong_box_percent` (of frames with a box).
  [[nodiscard]] std::map<std::string, double> figures() const override;
  /// The first tracked frame, one of each 15 s, and the last, with their boxes.
  [[nodiscard]] std::vector<MissionFrame> frames() const override;

 private:
  MissionLink& link_;
  const std::vector<Person>& people_;
  std::deque<std::pair<std::uint64_t, Pose>> cameras_{};  ///< Newest last.
  TrackedTime tracked_{};
  double centre_error_sum_{};
  double person_error_sum_{};
  std::uint64_t frames_{};
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
