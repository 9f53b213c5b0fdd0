// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A policy that somebody brings in a file, of one of three kinds:
/// - `mine.toml`: a preset (preset.h): a policy that exists with other parameters. Its `policy` may
///   be a file of the other kinds, seen from the preset's folder.
/// - `mine.lua`: a script, with a budget of instructions and memory and without a way out.
/// - `libmine.so`: a library behind plugin_abi.h, in a process of its own, because it may crash,
///   hang or eat memory. That process reads files until the policy has started and none afterwards;
///   writing, the network, other processes and shared memory end it.

#include "flyball/governors/policy.h"
#include "flyball/runtime/registry.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace flyball {

/// How to make a policy, and the parameters that were given for it.
struct PolicyChoice {
  std::string name{};  ///< For messages: `policy "density"`, `./mine.lua`.
  std::function<Result<std::unique_ptr<Policy>>()> make{};
  std::map<std::string, ParameterValue> parameters{};
  std::string caution{};  ///< What its user should know before it flies; empty: nothing.

  /// One that is ready to decide on this board.
  /// @error What is wrong with the parameters, a line for each, or why it does not start.
  [[nodiscard]] Result<std::unique_ptr<Policy>> started(const KnobSettings& knobs,
                                                        const BoardModel& board) const;
};

/// By its ending: .toml, .lua or .so.
[[nodiscard]] bool is_policy_file(const std::string& text);

/// @param known  For presets: the policies that have names.
/// @param seed   Of the random stream that the policy may draw from.
/// @error `not_found`; `invalid_input` with the file and, where it has lines, the line.
[[nodiscard]] Result<PolicyChoice> load_policy(const std::string& path,
                                               const Registry& known,
                                               std::uint64_t seed);

/// The file itself, and the one that a preset names: what the policy consists of.
[[nodiscard]] std::vector<std::string> files_of_policy(const std::string& path);

}  // namespace flyball
