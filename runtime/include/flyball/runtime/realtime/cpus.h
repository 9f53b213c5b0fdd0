// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which cores a process and its threads may use, and which threads stand back or come first.

#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace flyball {

/// Cores that the process may use, ascending.
[[nodiscard]] std::vector<int> usable_cpus();

/// Binds a thread (0: the calling one) to these cores, and reads that back; a sentence if it
/// failed.
[[nodiscard]] std::optional<std::string> bind_thread(pid_t thread, const std::vector<int>& cpus);

/// The calling thread runs when no other one on its core wants to, whatever priority it had from
/// the one that made it. Where that fails it runs on as it did.
void step_back();

/// The calling thread runs before all others of the process, and as soon as it wants to: for one
/// that keeps a vehicle in the air and hardly computes. It gets the highest priority of SCHED_FIFO
/// that the system permits (`CAP_SYS_NICE`, or the user's rtprio limit); where that is none, the
/// thread runs on as it did.
void come_first();

}  // namespace flyball
