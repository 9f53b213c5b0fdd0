// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What every kernel is, whatever it computes.

#include "flyball/runtime/knob.h"
#include "flyball/runtime/parameters.h"
#include "flyball/runtime/result.h"

#include <functional>
#include <string>
#include <vector>

namespace flyball {

/// Where a file lies that a kernel needs and that does not come with the program (weights).
/// @error `not_found`, with the way out.
using FindModel = std::function<Result<std::string>(const std::string& file)>;

/// For kernels that need no such files.
[[nodiscard]] inline Result<std::string> no_models(const std::string& file) {
  return Error{ErrorCode::not_found, "no model files are at hand, so \"" + file + "\" is missing"};
}

/// A computation on the path from sensor to command. Families (mapper, planner, ...) add the
/// computation itself; each reports the work that it did.
class Kernel {
 public:
  Kernel() = default;
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;
  virtual ~Kernel() = default;

  /// Settings of this implementation that stay for the mission.
  [[nodiscard]] virtual std::vector<ParameterSpec> parameters() const { return {}; }
  /// Once, before the first job. A kernel that needs no model files also works without it, with the
  /// default of each parameter.
  ///
  /// @param chosen  Resolved from `parameters()`.
  /// @error         `not_found` for a file that is missing, `invalid_input` for parameters that do
  ///                not go together or a file that is not what it should be. The kernel must not be
  ///                used then.
  [[nodiscard]] virtual Status configure([[maybe_unused]] const Parameters& chosen,
                                         [[maybe_unused]] const FindModel& find_model) {
    return Done{};
  }
  /// What may change between two jobs. To be asked once the kernel is configured, since legal
  /// values and initial values may follow from its parameters. Those of the family come first; an
  /// implementation may add its own, whose names begin with the family's or its own name and a dot.
  [[nodiscard]] virtual std::vector<KnobSpec> knobs() const { return {}; }
  /// The knobs in force from now on, before each job. The family's functions are handed those of
  /// the family as arguments; an implementation overrides this to read its own.
  ///
  /// @pre `knobs` has those of `knobs()`.
  virtual void apply([[maybe_unused]] const KnobSettings& knobs) {}
};

}  // namespace flyball
