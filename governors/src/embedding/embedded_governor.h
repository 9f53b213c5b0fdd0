// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What is behind the handle of governor.h: a PolicyGovernor, and what it needs of a loop that is
/// not Flyball's.

#include "flyball/governors/governor.h"
#include "flyball/governors/policy_governor.h"
#include "flyball/runtime/guard.h"

#include "callers_knobs.h"
#include "last_error.h"
#include "observed_signals.h"
#include "stage_times.h"
#include <array>
#include <cstdint>
#include <optional>

/// Its functions are those of governor.h, with pointers and sizes already checked. Once `open` has
/// succeeded none of them allocates.
struct FlyballGovernor final {
 public:
  std::int32_t add_knob(const FlyballGovernorKnob& given);
  std::int32_t add_stage(const FlyballGovernorStage& given);
  std::int32_t open(const FlyballGovernorSettings& settings);
  std::int32_t begin(std::uint32_t stage, double now_s);
  /// @param counts  Null, or `count` numbers.
  std::int32_t end(std::uint32_t stage, double now_s, const double* counts, std::uint32_t count);
  std::int32_t observe(const char* signal, double value);
  std::int32_t decide(double now_s);
  std::int32_t granted(const char* knob, double value);
  /// @param entry  Written when the number exists.
  std::int32_t list(std::uint32_t number, FlyballGovernorEntry& entry);

  /// Of the last `decide`.
  [[nodiscard]] const FlyballGovernorDecision& answer() const { return answer_; }
  [[nodiscard]] flyball::LastError& error() { return error_; }
  [[nodiscard]] const flyball::LastError& error() const { return error_; }
  [[nodiscard]] bool is_calling_back() const { return is_calling_back_; }

 private:
  std::int32_t refuse(const flyball::Error& error);
  std::int32_t check_set_up(const char* what);
  std::int32_t check_open(const char* what);
  std::int32_t advance(double now_s);
  std::int32_t check_stage(std::uint32_t stage);
  void add_frame(flyball::Duration latency);
  void observe_loop();
  void observe_stages();
  void observe_knobs();
  void answer(const flyball::Decision& decision, const flyball::Observation& seen);
  [[nodiscard]] double safe_speed_m_s(const flyball::Observation& seen) const;
  [[nodiscard]] flyball::Duration latency_bound() const;
  std::int32_t record(const flyball::Observation& seen);
  [[nodiscard]] FlyballGovernorEntry signal_entry(std::size_t signal) const;
  [[nodiscard]] FlyballGovernorEntry knob_entry(std::size_t knob) const;
  [[nodiscard]] std::optional<FlyballGovernorEntry> stage_entry(std::size_t number) const;
  [[nodiscard]] FlyballGovernorEntry measure_entry(std::size_t stage, std::size_t number) const;

  flyball::LastError error_{};
  flyball::CallersKnobs knobs_{};
  flyball::StageTimes stages_{};
  flyball::ObservedSignals signals_{};
  std::optional<flyball::PolicyGovernor> governor_{};
  FlyballGovernorSettings settings_{};  ///< As opened; its texts and its board may be gone.
  flyball::LatencyWindow latencies_{flyball::Duration{}};
  flyball::GuardSettings guard_{};
  std::optional<flyball::MissionTime> now_{};
  std::uint64_t frames_{};
  bool is_calling_back_{};
  FlyballGovernorDecision answer_{};
  std::array<char, 1024> why_{};
  std::array<char, 8192> line_{};
};
