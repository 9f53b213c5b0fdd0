// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board.h"

namespace flyball {

BoardModel board_model_of(const PlatformModel& platform) {
  BoardModel board;
  board.max_cores = platform.max_cores;
  board.frequencies = platform.frequencies;
  board.switching_time = platform.switching_time;
  board.power = platform.power;
  board.thermal = platform.thermal;
  board.gpu = platform.gpu;
  board.memory_contention = platform.memory_contention;
  return board;
}

}  // namespace flyball
