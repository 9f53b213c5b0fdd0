// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Knobs that belong to somebody else's program, and are turned by calling it back.

#include "flyball/governors/governor.h"
#include "flyball/runtime/decision.h"
#include "flyball/runtime/knob.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace flyball {

/// Who turns the knobs; see governor.h.
enum class KnobMode : std::uint8_t { governing, dry_run, shadow };
[[nodiscard]] const char* to_string(KnobMode mode);

/// Allocates only in `add` and `settings`.
class CallersKnobs {
 public:
  struct Knob {
    KnobSpec spec;
    std::int32_t (*apply)(void* context, double value){};
    void* context{};
    double decided{};
    double asked{};  ///< For which the caller was called back last, with success.
    double in_force{};
  };

  /// @error What is wrong with it; then it is not added.
  [[nodiscard]] Status add(const FlyballGovernorKnob& given);
  [[nodiscard]] const std::vector<Knob>& all() const { return knobs_; }
  [[nodiscard]] std::optional<std::size_t> index(std::string_view name) const;
  [[nodiscard]] KnobSettings settings() const;
  /// As long as nobody says so, the mode is `governing`.
  void set_mode(KnobMode mode) { mode_ = mode; }
  [[nodiscard]] KnobMode mode() const { return mode_; }
  /// What is really in force; a dry run does not listen.
  void grant(std::size_t knob, double value);
  /// Notes what was decided, and calls back for what nobody was asked for yet.
  /// @return  The first knob that could not be applied; null: all could.
  const Knob* put_in_force(const Decision& decision) noexcept;

 private:
  [[nodiscard]] static bool apply(Knob& knob) noexcept;

  std::vector<Knob> knobs_;
  KnobMode mode_{KnobMode::governing};
};

/// A name as governor.h allows it: neither null nor empty nor too long, without control characters.
/// @error One sentence; `what` says what has the name.
[[nodiscard]] Status check_name(const char* what, const char* name);

}  // namespace flyball
