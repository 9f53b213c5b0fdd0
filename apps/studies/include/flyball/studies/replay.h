// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A flight's decisions, made again from its record.

#include "flyball/governors/policy_abilities.h"
#include "flyball/runtime/observation.h"
#include "flyball/scenario/scenario.h"

#include <map>
#include <string>
#include <vector>

namespace flyball {

/// What the record of a run says about its decisions.
struct RecordedFlight {
  Scenario scenario{};
  /// Whether the library that the scenario's policy comes from may be loaded. A record may be
  /// somebody else's, and a library's code runs with the rights of whoever loads it.
  bool may_load_library{};
  std::string version{};
  Duration period{};  ///< Between two decisions; the first is at 0.
  MissionTime end{};  ///< Of the last row of the trace.
  std::uint64_t decisions{};
  /// Where decisions before it were dropped, by its number from 0: when it was made.
  std::map<std::uint64_t, MissionTime> after_drops{};
  /// Members of the observation that changed, by the time of the decision.
  std::map<MissionTime, std::vector<std::pair<std::size_t, double>>> changes{};
  /// What was decided, in words (`choice_text`), where it was not as before.
  std::map<MissionTime, std::string> choices{};
};

/// @param folder   Of a run: mission.toml, summary.json and trace.jsonl are read.
/// @param plugins  What its scenario may name; by default what is compiled in.
/// @error `not_found`, `invalid_input` with file and line.
[[nodiscard]] Result<RecordedFlight> read_flight(const std::string& folder,
                                                 const Plugins& plugins = {});

/// Where the repetition, or another policy, does not do what the record says.
struct Difference {
  MissionTime at{};
  std::string recorded{};
  std::string now{};
};

struct ReplayResult {
  std::uint64_t decisions{};
  std::uint64_t different{};
  std::uint64_t faults{};  ///< Decisions in which safe settings replaced the policy's.
  std::string trouble{};   ///< Reason of the first of these.
  std::vector<Difference> differences{};  ///< One for each time that they became others.
};

/// Makes every decision again with the recorded policy and compares wish, answer, reason and step
/// of the fallback, bit for bit.
/// @error As `fly`, when the scenario names something that is gone; `invalid_input` where
///        `may_load_library` is needed.
[[nodiscard]] Result<ReplayResult> replay(const RecordedFlight& flight);

/// Asks another policy at each recorded decision what it would have done, and compares how the
/// knobs would stand. It sees what the recorded policy's flight came to, not its own. The other
/// policy is the caller's own choice: it may be a library.
[[nodiscard]] Result<ReplayResult> shadow(const RecordedFlight& flight, const std::string& policy);

/// One decision, looked at closely.
struct Explanation {
  MissionTime at{};
  Observation seen{};
  std::string choice{};
  std::vector<PolicyOption> options{};  ///< The policy's own, best first; often empty.
  /// P / (delta + v / a) [W]: what one second of latency is worth; 0 where a manoeuvre or the
  /// mission's limit of speed, not latency, is what limits.
  double watts_per_second{};
  double response_s{};  ///< delta: bound on latency and the guard's reaction.
};

/// The last decision not after `at`, and how the policy came to it.
/// @error `invalid_input` when `at` is not within the flight; those of `replay`.
[[nodiscard]] Result<Explanation> explain(const RecordedFlight& flight, MissionTime at);

}  // namespace flyball
