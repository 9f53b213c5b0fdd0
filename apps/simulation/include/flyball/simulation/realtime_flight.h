// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The nodes of a mission on this machine's cores in real time, and the simulator beside them.

#include "flyball/runtime/realtime/realtime_executor.h"
#include "flyball/simulation/mission.h"

namespace flyball {

/// For `MissionHooks::executor`. The simulator keeps the calling thread, which is bound to the last
/// core that the process may use, for good; the nodes have the others, or all where there is only
/// one. Work takes as long as it takes here: the platform of the scenario says what the governor
/// expects and what the computer's power is.
[[nodiscard]] MakeExecutor in_real_time(const RealtimeSettings& settings);

}  // namespace flyball
