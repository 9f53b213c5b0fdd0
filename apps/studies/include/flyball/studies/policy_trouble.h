// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Whether a policy flew at all: one that fails is replaced by safe settings, and then time and
/// energy are theirs.

#include "flyball/records/summary.h"

#include <cstdint>
#include <string>

namespace flyball {

/// Over all flights of one policy, also those that failed.
struct PolicyTrouble {
  std::uint64_t decisions{};
  std::uint64_t faults{};  ///< Decisions in which safe settings replaced the policy's.
  std::string why{};       ///< Reason of the first of these.

  void add(const Summary& flight);
  void add(const PolicyTrouble& others);
  /// `policy bad was replaced by safe settings in 3 of 400 decisions ...`; empty where it never
  /// failed.
  [[nodiscard]] std::string text(const std::string& policy) const;
};

}  // namespace flyball
