// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Bits that flip in messages on board, and the detectors that may refuse such messages.

#include "flyball/flight/plausibility.h"
#include "flyball/runtime/executor.h"
#include "flyball/scenario/scenario.h"

#include "simulation/mission_link.h"
#include <cstdint>
#include <string>
#include <vector>

namespace flyball {

/// One bit of one number flips in the first message on a topic after the time of each event
/// `bit_flip`, as in MAVFI (Hsiao et al. 2021, arXiv 2105.12882). Number and bit are drawn, evenly,
/// by the seed, the event and its `draw`. What a reader could not survive, a number that is not
/// finite or farther than 10 km from zero, is taken for the end of that reader, which is started
/// anew: the message is lost.
class SoftErrors {
 public:
  /// All arguments outlive it.
  SoftErrors(MissionLink& link,
             const Scenario& scenario,
             const Graph& graph,
             Executor& executor,
             const EventQueue& queue);

  /// @error `invalid_input`: a flip in a topic that the mission has not, or whose messages do not
  ///        tell their numbers; one sentence with those that there are.
  [[nodiscard]] Status check() const;
  void start();

  [[nodiscard]] bool is_used() const {
    return !flips_.empty() || scenario_.faults.detector != "none";
  }
  [[nodiscard]] std::uint64_t flips() const { return flipped_; }
  [[nodiscard]] std::uint64_t lost() const { return lost_; }
  [[nodiscard]] std::uint64_t refused() const { return refused_; }

 private:
  struct Flip {
    std::size_t event{};  ///< Its place among the events, from 0.
    int topic{-1};
    bool is_done{};
  };
  [[nodiscard]] Message pass(int topic, const Message& message);
  [[nodiscard]] Message flipped(Flip& flip, const TopicSpec& topic, const Message& message);

  MissionLink& link_;
  const Scenario& scenario_;
  const Graph& graph_;
  Executor& executor_;
  const EventQueue& queue_;
  Plausibility plausibility_;
  std::vector<Flip> flips_{};
  std::uint64_t flipped_{};
  std::uint64_t lost_{};
  std::uint64_t refused_{};
};

}  // namespace flyball
