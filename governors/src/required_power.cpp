// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/required_power.h"

#include <algorithm>
#include <array>

namespace flyball {
namespace {

// Megawatts. The cube of a clock times more could exceed what a number can be.
constexpr double most = 1e6;

bool is_possible(const PowerCost& power) {
  const std::array<double, 9> all{power.board_w,       power.converter,      power.soc_w,
                                  power.memory_w,      power.cpu_constant_w, power.cpu_linear_w,
                                  power.core_linear_w, power.core_cubic_w,   power.memory_linear_w};
  return std::all_of(all.begin(), all.end(),
                     [](double one) { return one >= 0.0 && one <= most; });  // False for NaN.
}

}  // namespace

Result<PowerCost> required_power(const std::string& owner, const BoardModel& board) {
  if (!board.power) {
    return Error{ErrorCode::invalid_input,
                 owner +
                     ": needs the computer's power; pass a flyball::BoardModel with `power` to "
                     "Policy::start, for example board_model_of() of a platform file"};
  }
  if (!is_possible(*board.power)) {
    return Error{ErrorCode::invalid_input,
                 owner + ": each number of the board's `power` must be from 0 to 1e6"};
  }
  return *board.power;
}

}  // namespace flyball
