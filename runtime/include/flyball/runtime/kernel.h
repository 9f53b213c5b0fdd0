// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What every kernel is, whatever it computes.

namespace flyball {

/// A computation on the path from sensor to command. Families (mapper, planner, ...) add the
/// computation itself; each reports the work that it did.
class Kernel {
 public:
  Kernel() = default;
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;
  virtual ~Kernel() = default;
};

}  // namespace flyball
