// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What the process of an isolated policy does.

#include "child_process.h"
#include "isolated_policy.h"

namespace flyball {

/// Sends what the policy declares, or why it cannot be made.
void declare_policy(const PacketSocket& socket, const PolicyMaker& make);

/// The process's whole life: start, then an answer for each observation. Does not return, because
/// what was loaded has no more to say.
[[noreturn]] void serve_policy(const PacketSocket& socket,
                               const PolicyMaker& make,
                               const Parameters& given,
                               const KnobSettings& knobs,
                               const BoardModel& board);

}  // namespace flyball
