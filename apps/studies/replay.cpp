// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/studies/replay.h"

#include "flyball/flight/governing/choice_text.h"
#include "flyball/runtime/guard.h"
#include "flyball/runtime/observation_fields.h"
#include "flyball/runtime/text/listed.h"
#include "flyball/runtime/text/number_text.h"
#include "flyball/scenario/policy_choice.h"
#include "flyball/simulation/mission.h"

#include "simulation/mission_setup.h"
#include <algorithm>
#include <optional>

namespace flyball {
namespace {

/// Goes through a flight's decisions.
class Decisions {
 public:
  explicit Decisions(const RecordedFlight& flight)
      : flight_{flight}, change_{flight.changes.begin()}, choice_{flight.choices.begin()} {}

  /// When the next one was made; empty after the last one.
  [[nodiscard]] std::optional<MissionTime> coming() const {
    if (number_ == flight_.decisions) {
      return std::nullopt;
    }
    const auto dropped = flight_.after_drops.find(number_);
    return dropped != flight_.after_drops.end() ? dropped->second
           : number_ == 0                       ? MissionTime{}
                                                : seen_.now + flight_.period;
  }
  /// False after the last one.
  bool next() {
    const std::optional<MissionTime> now = coming();
    if (!now) {
      return false;
    }
    seen_.now = *now;
    ++number_;
    for (; change_ != flight_.changes.end() && change_->first <= seen_.now; ++change_) {
      for (const auto& [field, value] : change_->second) {
        observation_fields()[field].set(seen_, value);
      }
    }
    for (; choice_ != flight_.choices.end() && choice_->first <= seen_.now; ++choice_) {
      recorded_ = choice_->second;
    }
    return true;
  }
  [[nodiscard]] const Observation& seen() const { return seen_; }
  [[nodiscard]] const std::string& recorded() const { return recorded_; }
  [[nodiscard]] std::uint64_t number() const { return number_; }

 private:
  const RecordedFlight& flight_;
  std::map<MissionTime, std::vector<std::pair<std::size_t, double>>>::const_iterator change_;
  std::map<MissionTime, std::string>::const_iterator choice_;
  std::uint64_t number_{};
  Observation seen_{};
  std::string recorded_{};
};

void note(ReplayResult& result, MissionTime at, const std::string& recorded, std::string now) {
  auto& all = result.differences;
  if (all.empty() || all.back().recorded != recorded || all.back().now != now) {
    all.push_back({at, recorded, std::move(now)});
  }
}

/// A policy that fails leaves safe settings, which often are those of the record.
void note_fault(const PolicyGovernor& governor, ReplayResult& result) {
  if (governor.last_fault() != PolicyFault::none && result.faults++ == 0) {
    result.trouble = governor.why();
  }
}

Result<std::unique_ptr<PolicyGovernor>> governor_for(const Scenario& scenario) {
  auto setup = set_up(scenario);
  if (!setup) {
    return setup.error();
  }
  return std::move(setup->governor);
}

/// With the policy that the record names.
Result<std::unique_ptr<PolicyGovernor>> recorded_governor(const RecordedFlight& flight) {
  const std::string library = library_of_policy(flight.scenario.governor.policy);
  if (!library.empty() && !flight.may_load_library) {
    return Error{ErrorCode::invalid_input,
                 "the record's policy is code from library \"" + library +
                     "\", which was not loaded; add --trust if you trust whoever made it"};
  }
  return governor_for(flight.scenario);
}

using InForce = std::map<std::string, double>;

/// How the knobs stand after a decision in the words of `choice_text`; no words change nothing.
void put_in_force(const std::string& choice, InForce& in_force) {
  for (const auto& [knob, value] : settings_of(choice).value_or(InForce{})) {
    in_force[knob] = value;
  }
}

/// The knobs that stand otherwise, each with its value in `of`.
std::string where_they_differ(const InForce& of, const InForce& other) {
  return listed(of, [&other](const auto& setting) {
    const auto& [knob, value] = setting;
    const auto found = other.find(knob);
    const bool differs = found != other.end() && !have_same_bits(found->second, value);
    return differs ? knob + " " + short_number_text(value) : "";
  });
}

InForce standing_at_start(const KnobSettings& knobs) {
  InForce all;
  for (const KnobSpec& spec : knobs.specs()) {
    all[spec.name] = spec.fallback;
  }
  return all;
}

}  // namespace

Result<ReplayResult> replay(const RecordedFlight& flight) {
  const auto governor = recorded_governor(flight);
  if (!governor) {
    return governor.error();
  }
  ReplayResult result;
  ChoiceMemory memory;
  std::string now;
  for (Decisions decisions{flight}; decisions.next(); ++result.decisions) {
    const Decision answer = (*governor)->decide(decisions.seen());
    note_fault(**governor, result);
    if (memory.is_new(**governor, answer)) {
      now = choice_text(**governor, answer);
    }
    if (now != decisions.recorded()) {
      ++result.different;
      note(result, decisions.seen().now, decisions.recorded(), now);
    }
  }
  return result;
}

Result<ReplayResult> shadow(const RecordedFlight& flight, const std::string& policy) {
  Scenario scenario = flight.scenario;
  scenario.governor.policy = policy;
  const auto governor = governor_for(scenario);
  if (!governor) {
    return governor.error();
  }
  ReplayResult result;
  InForce recorded = standing_at_start((*governor)->knobs());
  InForce now = recorded;
  for (Decisions decisions{flight}; decisions.next(); ++result.decisions) {
    const Decision answer = (*governor)->decide(decisions.seen());
    note_fault(**governor, result);
    put_in_force(decisions.recorded(), recorded);
    put_in_force(choice_text(**governor, answer), now);
    const std::string theirs = where_they_differ(recorded, now);
    const std::string ours = where_they_differ(now, recorded);
    result.different += theirs.empty() ? 0 : 1;
    if (!theirs.empty() || !result.differences.empty()) {
      note(result, decisions.seen().now, theirs.empty() ? "the same" : theirs,
           ours.empty() ? "the same" : ours);
    }
  }
  return result;
}

Result<Explanation> explain(const RecordedFlight& flight, MissionTime at) {
  Decisions decisions{flight};
  const std::optional<MissionTime> first = decisions.coming();
  if (!first || at < *first || at > flight.end) {
    return Error{ErrorCode::invalid_input, "there is no decision at " +
                                               short_number_text(to_seconds(at)) +
                                               " s; the flight lasts from 0 to " +
                                               short_number_text(to_seconds(flight.end)) + " s"};
  }
  const auto governor = recorded_governor(flight);
  if (!governor) {
    return governor.error();
  }
  Explanation explanation;
  for (auto coming = first; coming && *coming <= at; coming = decisions.coming()) {
    decisions.next();
    static_cast<void>((*governor)->decide(decisions.seen()));
  }
  const Observation& seen = explanation.seen = decisions.seen();
  explanation.at = seen.now;
  explanation.choice = decisions.recorded();
  explanation.options = (*governor)->options();
  const double deceleration_m_s2 = flight.scenario.mission.max_acceleration_m_s2;
  const GuardSettings guard = guard_settings(flight_settings(flight.scenario));
  explanation.response_s = to_seconds(seen.latency_bound + Guard{guard}.reaction_time());
  const double power_w = seen.rotor_power.value() + seen.computer_power.value();
  constexpr double nearly = 0.98;
  if (seen.phase == MissionPhase::cruise && seen.speed_m_s < nearly * seen.speed_limit_m_s) {
    explanation.watts_per_second =
        power_w / (explanation.response_s + seen.speed_m_s / deceleration_m_s2);
  }
  return explanation;
}

}  // namespace flyball
