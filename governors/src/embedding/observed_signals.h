// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// An observation that grows signal by signal: from the caller's mouth, or derived for him.

#include "flyball/runtime/observation_fields.h"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace flyball {

/// What a caller observes himself is believed, and never derived again. Allocates only when it is
/// made.
class ObservedSignals {
 public:
  ObservedSignals();
  [[nodiscard]] std::optional<std::size_t> index(std::string_view name) const;
  /// @return  Whether the signal can have such a value. Until it gets one that can be, the
  /// observation as a whole is not believable.
  bool observe(std::size_t signal, double value);
  /// Does nothing where the caller says it himself; who was refused at once does not yet. @pre
  /// There is a signal of this name.
  void derive(std::string_view name, double value);
  [[nodiscard]] bool is_callers(std::string_view name) const;
  [[nodiscard]] bool is_known(std::size_t signal) const { return states_[signal].is_known; }
  [[nodiscard]] double value(std::size_t signal) const;
  [[nodiscard]] Observation seen(MissionTime now) const;
  /// The name of a signal whose newest value was refused; null: there is none.
  [[nodiscard]] const char* refused() const;
  /// Counts that are meant since the last decision begin anew.
  void begin_counts_anew();

 private:
  struct State {
    bool is_known{};
    bool is_callers{};
    bool is_refused{};
  };
  const std::vector<ObservationField>& fields_;
  std::vector<State> states_;
  Observation seen_{};
};

}  // namespace flyball
