// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The outer loop: observe, decide, apply, record.

#include "flyball/flight/flight_parts.h"
#include "flyball/flight/governing/choice_text.h"
#include "flyball/flight/governing/node_places.h"
#include "flyball/flight/navigation/guidance.h"
#include "flyball/governors/policy_governor.h"
#include "flyball/runtime/board.h"
#include "flyball/runtime/work.h"

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace flyball {

/// What the governor looks at; without a navigator it sees the computer alone.
struct GovernorInputs {
  std::optional<Topic<NavigatorState>> navigator{};
  std::array<std::vector<int>, stage_count> stages{};  ///< The nodes of each.
  Duration period{};                                   ///< Between decisions.
};

/// The topic `navigator` of a graph and the nodes of its stages, where it has them.
[[nodiscard]] GovernorInputs governor_inputs(const Graph& graph);

/// Belongs to the node `govern` while the graph runs; what it counted may be asked afterwards.
class GovernorLoop {
 public:
  /// Governor and board outlive the loop.
  GovernorLoop(const FlightParts& parts,
               const KnobSettings& knobs,
               PolicyGovernor& governor,
               Board& board,
               const GovernorInputs& inputs);

  /// Makes one decision. The surroundings are observed once in each `governor.period_s`, the
  /// computer every time.
  /// @return What was asked of the map.
  Work tick(JobContext& job);
  [[nodiscard]] std::uint64_t decisions() const { return decisions_; }
  /// Host time of each decision; nothing in the mission depends on it.
  [[nodiscard]] const std::vector<double>& decision_host_us() const { return decision_host_us_; }
  [[nodiscard]] std::uint64_t knob_changes() const { return knob_changes_; }
  [[nodiscard]] std::uint64_t faults() const { return faults_; }
  /// Why the policy failed the first time; empty when it never did.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  [[nodiscard]] std::uint64_t misses() const { return last_misses_; }
  [[nodiscard]] std::vector<LevelBounds> bound_levels() const { return governor_.bound_levels(); }

 private:
  /// Rows of the record, at the time of the decision.
  void note(JobContext& job, std::string_view channel, std::vector<Field> fields);
  void note_event(JobContext& job, const std::string& what);
  void look_around(JobContext& job, Work& asked);
  void observe_flight(const NavigatorState& navigator);
  void observe_map(const NavigatorState& navigator, const OccupancyView& map);
  void observe_gaps(const NavigatorState& navigator, const OccupancyView& map);
  void observe_computer(MissionTime now);
  void observe_stages(double elapsed_s);
  void observe_progress(JobContext& job);
  void decide(JobContext& job);
  void publish_knobs(JobContext& job);
  void record(JobContext& job, bool is_whole);
  void record_bounds(JobContext& job);
  void apply(JobContext& job, const Decision& decision);
  void note_moved_wishes(JobContext& job);
  void note_fallback(JobContext& job);

  FlightParts parts_;
  KnobsInForce knobs_;
  bool has_new_knobs_{true};
  PolicyGovernor& governor_;
  Board& board_;
  GovernorInputs inputs_;
  OperatingPoint asked_;
  NodePlaces places_{};
  Observation seen_{};
  std::vector<double> told_{};  ///< The members of `seen_` as they were last recorded.
  ChoiceMemory choices_{};
  MissionTime next_look_{};
  MissionTime last_{};
  double last_busy_core_s_{};
  double last_busiest_core_s_{};
  std::array<double, stage_count> last_stage_core_s_{};
  std::uint64_t last_drops_{};
  std::uint64_t last_misses_{};
  std::uint64_t decisions_{};
  MissionTime due_{};  ///< The next decision, unless the executor drops its period.
  std::uint64_t knob_changes_{};
  std::vector<double> decision_host_us_{};
  std::uint64_t faults_{};
  std::string trouble_{};
  std::uint64_t settled_bounds_{};  ///< Latency bounds that were settled and recorded.
  Fallback fallback_{Fallback::none};
  std::string why_{};              ///< Reason of the last fallback that was recorded.
  std::set<std::string> moved_{};  ///< Knobs whose wishes had to be moved to a legal value.
};

/// Adds the node `govern`, which decides each `inputs.period` and so ticks the loop. Owners: the
/// node, and who asks it for its counts.
void add_governor(Graph& graph,
                  const FlightParts& parts,
                  const GovernorInputs& inputs,
                  std::shared_ptr<GovernorLoop> loop);

}  // namespace flyball
