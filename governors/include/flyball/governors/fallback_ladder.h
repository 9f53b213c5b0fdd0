// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What is done when a policy, or what it relies on, fails: one step after another away from it.

#include "flyball/runtime/knob.h"
#include "flyball/runtime/observation.h"

#include <cstdint>
#include <optional>
#include <string_view>

namespace flyball {

/// From none to all of the policy taken away; the highest one that has a cause is in force.
enum class Fallback : std::uint8_t {
  none,
  wide_bound,  ///< Maps came later than the age that the guard counts with: that bound is widened,
               ///< the policy goes on.
  table,  ///< Its input cannot be believed: every knob at its default, clock and cores at most.
  safe_static,  ///< It failed or took too long: every knob at its default.
  hover  ///< Deadlines are missed again and again: brake and stand, with the table's settings.
};
[[nodiscard]] std::string_view to_string(Fallback fallback);

/// The thresholds lie above what missions do that nothing is wrong with: in twelve of
/// delivery_outdoor_to_indoor, 12 000 maps and 15 000 looks, no map was late and no look saw more
/// than one deadline missed.
///
/// A map is late when its latency is longer than `Observation::latency_bound` was while it was
/// made. The guard counts with maps of that age, so a late map is older on arrival than a map
/// should ever become, and the vehicle has flown too fast. A bound on the latency alone, as a
/// policy states it, is tighter and is meant to be violated by some 5 % of the maps: that is no
/// alarm. In the C library the two are the same: the bound is there 1.1 times the largest latency
/// of the last 20 frames, and the safe speed follows from it.
struct FallbackSettings {
  bool enabled{true};
  int late_maps{2};          ///< Of the last `map_window`: alarm.
  int map_window{20};        ///< At most 64.
  double bound_factor{1.5};  ///< While the alarm lasts: until fewer than `late_maps` were late.
  /// Granted clock or cores are less than what was requested for so long: a switch takes its time.
  Duration mismatch_patience{std::chrono::seconds{1}};
  /// The table asks for the most. What is still granted after so long is what there is (a computer
  /// that is too hot): the policy goes on with it.
  Duration cap_patience{std::chrono::seconds{2}};
  /// Each missed deadline adds 1 to a count, which falls by `miss_drain_hz` a second: above this
  /// the vehicle hovers, until the count is 0 again and `least_hover` has passed.
  double missed_deadlines{5.0};
  double miss_drain_hz{2.5};
  Duration least_hover{std::chrono::seconds{2}};
};

/// Watches the input of decisions. An observation whose phase was never set is a mistake of whoever
/// observes, and is met by the table even where the ladder is not enabled. Allocates nothing after
/// construction.
class FallbackLadder {
 public:
  /// @pre `map_window` is 1 to 64.
  explicit FallbackLadder(const FallbackSettings& settings);

  /// Clock and cores that were asked for; empty where there is no such knob.
  struct Request {
    std::optional<double> frequency_hz{};
    std::optional<double> cores{};
  };
  /// What this observation asks for; faults of the policy itself are not seen here.
  [[nodiscard]] Fallback look(const Observation& seen, const Request& request);
  /// Why, in one sentence; empty for `none`.
  [[nodiscard]] std::string_view why() const { return why_; }

 private:
  struct Grant {
    double frequency_hz{};
    double cores{};
  };
  void note_cap(const Grant& grant, MissionTime now);
  [[nodiscard]] bool has_coverage_alarm(const Observation& seen);
  [[nodiscard]] bool is_mismatched(const Observation& seen, const Request& request);
  [[nodiscard]] bool must_hover(const Observation& seen);

  FallbackSettings settings_;
  std::string_view why_{};
  std::uint64_t revision_{};
  Duration bound_{};      ///< Age that the next map's latency shall not exceed.
  std::uint64_t late_{};  ///< One bit for each of the newest maps.
  Request last_request_{};
  bool is_table_{};  ///< Which asks for more than the policy did: no new beginning.
  std::optional<MissionTime> mismatched_since_{};
  Grant under_table_{};  ///< Granted last while the table asked.
  MissionTime under_table_since_{};
  Grant cap_;  ///< More has turned out not to be granted.
  double missed_{};
  std::optional<MissionTime> last_look_{};
  std::optional<MissionTime> hovering_since_{};
};

}  // namespace flyball
