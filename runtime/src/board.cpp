// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/runtime/board.h"

#include <algorithm>
#include <cmath>

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

std::vector<Hertz> clocks_missing_on(const BoardModel& board, const std::vector<Hertz>& wanted) {
  constexpr double tolerance = 0.02;
  std::vector<Hertz> missing;
  for (const Hertz clock : wanted) {
    const auto is_near = [clock](Hertz own) {
      return std::abs(own.value() - clock.value()) <= tolerance * clock.value();
    };
    const auto& all = board.frequencies;
    if (!all.empty() && std::none_of(all.begin(), all.end(), is_near)) {
      missing.push_back(clock);
    }
  }
  return missing;
}

}  // namespace flyball
