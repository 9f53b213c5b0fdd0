// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which messages on board no vehicle can mean.

#include "flyball/flight/brief.h"
#include "flyball/runtime/graph.h"
#include "flyball/runtime/time.h"

#include <map>
#include <string>
#include <vector>

namespace flyball {

/// Detectors of range and of rate, as MAVFI has them (Hsiao et al. 2021, arXiv 2105.12882), with
/// limits that follow from the vehicle and the site instead of learned ones: a number is
/// implausible outside its range, or when it has changed since the last message by more than the
/// vehicle can. Rates are judged in streams only, because a new path may lie anywhere.
class Plausibility {
 public:
  struct Use {
    bool range{};
    bool rate{};
  };
  Plausibility(const Brief& brief, const Use& use) : brief_{brief}, use_{use} {}

  /// Empty: the message may pass. Else what is wrong with it, in words. After `most_in_row` refused
  /// messages of a stream the next one counts as the truth, so that one jump does not shut it for
  /// good.
  [[nodiscard]] std::string refused(const TopicSpec& topic, const void* message, MissionTime now);

  static constexpr int most_in_row = 5;

 private:
  struct Stream {
    MissionTime at{};
    std::vector<double> numbers{};
    int refused_in_row{};
  };
  const Brief& brief_;
  Use use_;
  std::map<std::string, Stream> streams_{};
};

}  // namespace flyball
