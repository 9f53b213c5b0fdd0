// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which cores a process and its threads may use, which threads stand back, and what they take.

#include "flyball/runtime/time.h"

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

/// CPU time that the calling thread has used since it began.
[[nodiscard]] Duration thread_cpu_time();
/// Other threads used so much for the job that the calling one runs: to the governor it is a part
/// of that job.
void add_helpers_time(Duration used);
/// All of it since the last call on this thread: the executor asks after each job.
[[nodiscard]] Duration take_helpers_time();

}  // namespace flyball
