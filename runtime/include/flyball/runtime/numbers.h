// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The numbers of a message by name: what a fault may change, and what may be implausible.

#include "flyball/runtime/geometry.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace flyball {

enum class Quantity : std::uint8_t {
  position,      ///< In W [m].
  reach,         ///< From the camera to what it sees, along one axis [m].
  distance,      ///< Along a path [m].
  velocity,      ///< [m/s]
  acceleration,  ///< [m/s^2]
  angle,         ///< [rad]
  rate,          ///< [rad/s]
  other,
};

/// A type of messages tells its numbers by a function `visit_numbers(message, visitor)` in its
/// header, always in the same order. A name may come several times.
class NumberVisitor {
 public:
  NumberVisitor() = default;
  NumberVisitor(const NumberVisitor&) = delete;
  NumberVisitor& operator=(const NumberVisitor&) = delete;
  virtual ~NumberVisitor() = default;

  virtual void visit(std::string_view name, Quantity quantity, double& number) = 0;
  virtual void visit(std::string_view name, Quantity quantity, float& number) = 0;
};

template <class Vector>
void visit_vector(NumberVisitor& visitor,
                  const std::array<std::string_view, 3>& names,
                  Quantity quantity,
                  Vector& vector) {
  for (int i = 0; i < 3; ++i) {
    visitor.visit(names[static_cast<std::size_t>(i)], quantity, vector[i]);
  }
}

}  // namespace flyball
