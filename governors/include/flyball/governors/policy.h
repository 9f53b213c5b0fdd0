// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The bare decision rule. It may be wrong; PolicyGovernor makes it safe.

#include "flyball/governors/foresight.h"
#include "flyball/runtime/board_model.h"
#include "flyball/runtime/governor.h"
#include "flyball/runtime/knob.h"
#include "flyball/runtime/parameters.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace flyball {

/// One of the settings that a policy weighed, with what it expects of it.
struct PolicyOption {
  Decision setting{};
  double speed_m_s{};
  double joules_per_m{};
  double response_s{};        ///< Sensor to brake.
  double watts_per_second{};  ///< Worth of one second of latency; 0 where it limits nothing.
};

/// A policy that promises by when a result is there keeps count of its promises.
struct PromiseCount {
  std::uint64_t issued{};  ///< Settled ones: each result came, or its time ran out.
  std::uint64_t late{};    ///< Of them.
  double factor{1.0};      ///< Of the next promise: bound over prediction.
};

/// The same at one level of map resolution, for people who ask when the mission is over.
struct LevelPromises {
  double resolution_m{};
  std::uint64_t issued{};
  std::uint64_t late{};
  std::optional<double> most_late{};  ///< By what the policy states; empty: it states nothing.
};

class Policy {
 public:
  Policy() = default;
  Policy(const Policy&) = delete;
  Policy& operator=(const Policy&) = delete;
  virtual ~Policy() = default;

  /// What a preset may set.
  [[nodiscard]] virtual std::vector<ParameterSpec> parameters() const = 0;
  /// Called once, before the first decision.
  /// @param board  The computer that it will fly on; `{}` where nothing is known of it.
  /// @error `invalid_input` when parameters contradict each other or the knobs, or when something
  /// is missing that the policy cannot do without.
  virtual Status start(const Parameters& given,
                       const KnobSettings& knobs,
                       const BoardModel& board) = 0;
  /// How often it wants to be asked; empty: as often as the scenario says. Asked once, when
  /// started.
  [[nodiscard]] virtual std::optional<Duration> period() const { return std::nullopt; }
  /// Settings of which it wants to be told how long a frame will take, here and farther on. Only a
  /// simulator can answer, and its records cannot; whoever flies must do without. Asked once, when
  /// started; empty: it does not ask.
  [[nodiscard]] virtual std::vector<MapSetting> foresees() const { return {}; }
  /// The answer, before a decision; stays as it is until that is made.
  virtual void foretell([[maybe_unused]] const Foresight& truth) noexcept {}
  /// The wish for the time until the next decision. Must not block or allocate.
  [[nodiscard]] virtual Decision decide(const Observation& seen) noexcept = 0;
  /// Why the last `decide` came to nothing, in one sentence; empty: it did not. For policies that
  /// somebody brought in a file: what is wrong with them shows when they are asked.
  [[nodiscard]] virtual std::string_view trouble() const noexcept { return {}; }
  /// What the record shall keep of the last `decide`, in its own words; empty: nothing.
  [[nodiscard]] virtual std::string_view remark() const noexcept { return {}; }
  /// Empty: it promises nothing.
  [[nodiscard]] virtual std::optional<PromiseCount> promises() const noexcept {
    return std::nullopt;
  }
  /// Level by level; allocates, unlike `promises`.
  [[nodiscard]] virtual std::vector<LevelPromises> promise_levels() const { return {}; }
  /// What it weighed in the last `decide`, best first; empty: it does not compare. For people who
  /// ask afterwards, not in flight: may allocate.
  [[nodiscard]] virtual std::vector<PolicyOption> options() const { return {}; }
};

}  // namespace flyball
