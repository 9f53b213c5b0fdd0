// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a job's threads take of the processor.

#include "flyball/runtime/time.h"

namespace flyball {

/// CPU time that the calling thread has used since it began.
[[nodiscard]] Duration thread_cpu_time();
/// Other threads used so much for the job that the calling one runs: to the governor it is a part
/// of that job.
void add_helpers_time(Duration used);
/// All of it since the last call on this thread: the executor asks after each job.
[[nodiscard]] Duration take_helpers_time();

}  // namespace flyball
