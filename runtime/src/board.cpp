// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board.h"

namespace flyball {

BoardModel board_model_of(const PlatformModel& platform) {
  return {platform.max_cores, platform.frequencies, platform.switching_time, platform.power,
          platform.thermal};
}

}  // namespace flyball
