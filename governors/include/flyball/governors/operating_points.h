// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The settings that are worth looking at.

#include "flyball/runtime/knob.h"

#include <cstddef>
#include <string>
#include <vector>

namespace flyball {

/// One knob of the lattice and the values that it may take.
struct KnobAxis {
  std::string knob;
  std::vector<double> values;
};

/// Every combination of some knobs' values. What a policy then searches is short, and looking
/// through it allocates nothing.
class OperatingPoints {
 public:
  /// All combinations, the last axis changing fastest.
  /// @error `invalid_input` for an unknown knob, a value that is not legal, an axis without values,
  /// no axis, or more than `limit` combinations.
  static Result<OperatingPoints> lattice(std::vector<KnobAxis> axes,
                                         const KnobSettings& knobs,
                                         std::size_t limit = 100000);

  [[nodiscard]] std::size_t size() const { return values_.size() / axes_.size(); }
  [[nodiscard]] const std::vector<KnobAxis>& axes() const { return axes_; }
  /// The values of one point, in the order of the axes. @pre `point < size()`.
  [[nodiscard]] const double* values(std::size_t point) const {
    return values_.data() + point * axes_.size();
  }

 private:
  std::vector<KnobAxis> axes_{};
  std::vector<double> values_{};  ///< Row after row.
};

}  // namespace flyball
