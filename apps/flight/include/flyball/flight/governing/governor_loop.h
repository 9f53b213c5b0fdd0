// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The outer loop: observe, decide, apply, record.

#include "flyball/flight/governing/choice_text.h"
#include "flyball/flight/navigation/navigator.h"
#include "flyball/governors/foresight.h"
#include "flyball/governors/policy_governor.h"
#include "flyball/runtime/board.h"

#include <set>
#include <string>

namespace flyball {

/// Tells policies that ask for it how long future jobs will take. Only a simulator can implement
/// it.
class ForesightSource {
 public:
  ForesightSource() = default;
  ForesightSource(const ForesightSource&) = delete;
  ForesightSource& operator=(const ForesightSource&) = delete;
  virtual ~ForesightSource() = default;

  /// Along the path and, beyond its end, straight to the goal. The result stays valid until the
  /// next call.
  [[nodiscard]] virtual const Foresight& look(const PathFollower& follower) = 0;
};

class GovernorLoop {
 public:
  /// All arguments outlive the loop; `navigator` and `future` may be null.
  GovernorLoop(MissionContext& context,
               PolicyGovernor& governor,
               Board& board,
               const Navigator* navigator,
               ForesightSource* future);

  /// Makes one decision at `now`. The surroundings are observed once in each `governor.period_s`,
  /// the computer every time.
  void tick(MissionTime now);
  /// A deadline was missed; the next observation carries the count.
  void count_miss() {
    ++misses_;
    ++all_misses_;
  }
  [[nodiscard]] std::uint64_t decisions() const { return decisions_; }
  /// Host time of each decision; nothing in the mission depends on it.
  [[nodiscard]] const std::vector<double>& decision_host_us() const { return decision_host_us_; }
  [[nodiscard]] std::uint64_t knob_changes() const { return knob_changes_; }
  [[nodiscard]] std::uint64_t faults() const { return faults_; }
  /// Why the policy failed the first time; empty when it never did.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  [[nodiscard]] std::uint64_t misses() const { return all_misses_; }
  [[nodiscard]] std::vector<LevelPromises> promise_levels() const {
    return governor_.policy().promise_levels();
  }

 private:
  void observe_surroundings();
  [[nodiscard]] double speed_limit_ahead() const;
  [[nodiscard]] double density_ahead() const;
  void observe_gaps();
  void observe_computer(MissionTime now);
  void record(bool is_whole);
  void record_promises(MissionTime now);
  void apply(MissionTime now, const Decision& decision);
  void note_moved_wishes(MissionTime now);
  void note_fallback(MissionTime now);

  MissionContext& context_;
  PolicyGovernor& governor_;
  Board& board_;
  const Navigator* navigator_;
  ForesightSource* future_;
  OperatingPoint asked_;
  Observation seen_{};
  std::vector<double> told_{};  ///< The members of `seen_` as they were last recorded.
  ChoiceMemory choices_{};
  MissionTime next_look_{};
  MissionTime last_{};
  double last_busy_core_s_{};
  double last_busiest_core_s_{};
  std::uint64_t last_drops_{};
  std::uint32_t misses_{};
  std::uint64_t all_misses_{};
  std::uint64_t decisions_{};
  std::uint64_t knob_changes_{};
  std::vector<double> decision_host_us_{};
  std::uint64_t faults_{};
  std::string trouble_{};
  std::uint64_t promises_{};  ///< Latency bounds that were settled and recorded.
  Fallback fallback_{Fallback::none};
  std::string why_{};              ///< Reason of the last fallback that was recorded.
  std::set<std::string> moved_{};  ///< Knobs whose wishes had to be moved to a legal value.
};

}  // namespace flyball
