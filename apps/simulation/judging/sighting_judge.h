// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Whether a person stands where the vehicle reported one.

#include "flyball/flight/people/person_finding.h"
#include "flyball/runtime/executor.h"
#include "flyball/sim/person.h"

#include "simulation/judging/judge.h"
#include "simulation/mission_link.h"
#include <optional>

namespace flyball {

/// What a search publishes to be judged.
struct SearchTopics {
  Topic<Sightings> sightings;
  Topic<Finding> finding;
};

class SightingJudge final : public Judge {
 public:
  /// All arguments outlive the judge, which listens to both topics from now on.
  SightingJudge(MissionLink& link,
                const std::vector<Person>& people,
                Executor& executor,
                const SearchTopics& topics);

  /// `false_alarm` when the finding is farther than a metre from everybody.
  [[nodiscard]] MissionFailure objection() const override;
  /// `false_positives` (places where nobody stands that were taken for a person),
  /// `position_error_m` of the finding, where the world has people, and, when it is right,
  /// `time_to_find_s`.
  [[nodiscard]] std::map<std::string, double> figures() const override;
  [[nodiscard]] std::vector<MissionFrame> frames() const override { return frames_; }

 private:
  void saw(const Sightings& seen);
  void found(const Finding& finding);
  /// From the nearest; empty in a world without people.
  [[nodiscard]] std::optional<double> distance_to_person_m(MissionTime at, const Vec3& p_W) const;
  [[nodiscard]] bool is_new(const Vec3& p_W) const;
  void keep(const ColourFrame& frame, const ImageBox& box, bool is_right, const std::string& what);

  MissionLink& link_;
  const std::vector<Person>& people_;
  std::vector<Vec3> mistaken_W_{};
  std::optional<double> found_s_{};
  std::optional<double> error_m_{};  ///< Of the finding; empty without people as well.
  std::vector<MissionFrame> frames_{};
};

}  // namespace flyball
