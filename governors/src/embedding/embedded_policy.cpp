// SPDX-License-Identifier: BSD-3-Clause
// tested-in: governor_policy
#include "embedded_policy.h"

#include "flyball/governors/policy_file.h"
#include "flyball/governors/preset.h"
#include "flyball/runtime/registry.h"

#include "known_policies.h"
#include "sized_structure.h"
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace flyball {
namespace {

Error wrong(const std::string& what) {
  return {ErrorCode::invalid_input, what};
}

std::string known_names(const Registry& known) {
  std::string list;
  for (const std::string& name : known.names<Policy>()) {
    list += (list.empty() ? "" : ", ") + name;
  }
  return list;
}

Result<PolicyChoice> choice_of(const FlyballGovernorSettings& settings, const Registry& known) {
  if (settings.policy == nullptr || *settings.policy == '\0') {
    return wrong("settings need a policy: a file, or one of " + known_names(known));
  }
  const std::string policy = settings.policy;
  if (is_policy_file(policy)) {
    return load_policy(policy, known, settings.seed);
  }
  if (known.make<Policy>(policy) == nullptr) {
    return Error{ErrorCode::not_found,
                 "this library has no policy \"" + policy + "\"; it has " + known_names(known)};
  }
  return PolicyChoice{"policy \"" + policy + "\"", [&known, policy] {
                        return Result<std::unique_ptr<Policy>>{known.make<Policy>(policy)};
                      }};
}

Status add_parameters(const char* text, PolicyChoice& choice) {
  if (text == nullptr) {
    return Done{};
  }
  auto given = read_parameters(text);
  if (!given) {
    return given.error();
  }
  for (auto& [name, value] : *given) {
    choice.parameters[name] = std::move(value);
  }
  return Done{};
}

Status add_clocks(const FlyballGovernorBoard& given, BoardModel& board) {
  if (given.clock_count > 0 && given.clocks_hz == nullptr) {
    return wrong("the board has " + std::to_string(given.clock_count) +
                 " clocks, but clocks_hz is NULL");
  }
  for (std::uint32_t i = 0; i < given.clock_count; ++i) {
    const double clock_hz = given.clocks_hz[i];
    const double least_hz = board.frequencies.empty() ? 0.0 : board.frequencies.back().value();
    if (!std::isfinite(clock_hz) || clock_hz <= least_hz) {
      return wrong("the board's clocks_hz must be positive and ascending; number " +
                   std::to_string(i) + " is not");
    }
    board.frequencies.emplace_back(clock_hz);
  }
  return Done{};
}

Result<BoardModel> board_of(const FlyballGovernorBoard* at) {
  BoardModel board;
  if (at == nullptr) {
    return board;
  }
  if (size_of_given(at) < offsetof(FlyballGovernorBoard, board_w)) {
    return wrong("the board's struct_size is " + std::to_string(size_of_given(at)) +
                 "; set it to sizeof(FlyballGovernorBoard)");
  }
  const FlyballGovernorBoard given = read_sized(at);
  constexpr std::uint32_t most_cores = 4096;  // More than Linux is built for anywhere on a vehicle.
  if (given.max_cores > most_cores || !std::isfinite(given.switching_s) ||
      given.switching_s < 0.0) {
    return wrong("the board needs at most 4096 cores and a finite switching_s of at least 0");
  }
  board.max_cores = static_cast<int>(given.max_cores);
  board.switching_time = from_seconds(given.switching_s);
  if (Status clocks = add_clocks(given, board); !clocks) {
    return clocks.error();
  }
  if (given.converter != 0.0) {  // Whether its numbers can be is checked by whoever uses them.
    PowerCost power;
    power.board_w = given.board_w;
    power.converter = given.converter;
    power.soc_w = given.soc_w;
    power.memory_w = given.memory_w;
    power.cpu_constant_w = given.cpu_constant_w;
    power.cpu_linear_w = given.cpu_linear_w;
    power.core_linear_w = given.core_linear_w;
    power.core_cubic_w = given.core_cubic_w;
    board.power = std::move(power);
  }
  return board;
}

/// The problems of a file or of parameters come as one line each.
Error on_one_line(Error error) {
  for (std::size_t at = error.message.find('\n'); at != std::string::npos;
       at = error.message.find('\n', at)) {
    error.message.replace(at, 1, "; ");
  }
  return error;
}

}  // namespace

Result<std::unique_ptr<Policy>> start_embedded_policy(const FlyballGovernorSettings& settings,
                                                      const KnobSettings& knobs,
                                                      Duration reaction_time) {
  Registry known;
  register_known_policies(known);
  auto choice = choice_of(settings, known);
  if (!choice) {
    return on_one_line(choice.error());
  }
  if (const Status added = add_parameters(settings.parameters, *choice); !added) {
    return on_one_line(added.error());
  }
  auto board = board_of(settings.board);
  if (!board) {
    return board.error();
  }
  board->vehicle.reaction_time = reaction_time;
  auto policy = choice->started(knobs, *board);
  if (!policy) {
    return on_one_line(policy.error());
  }
  return policy;
}

}  // namespace flyball
