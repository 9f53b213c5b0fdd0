// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Missions as processes of their own: OMPL's random seed is global, and a crash takes one mission
/// with it, not all.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace flyball {

/// How a process ended.
struct ChildEnd {
  std::size_t index{};   ///< Of its arguments.
  int exit_code{};       ///< 128 + n when signal n ended it.
  std::string errors{};  ///< What it wrote to standard error.
};

/// Runs this program once for each list of arguments, `jobs` at a time, in order. Standard output
/// is thrown away. After SIGINT (Ctrl-C), SIGTERM or SIGHUP no further one starts and the running
/// ones get the signal; after another one they get that, too. They do not outlive this process,
/// however it ends.
///
/// @param ended  Called for each one that ends; in the order of their ends.
/// @return       The signal that interrupted it; 0: none did.
int run_children(const std::vector<std::vector<std::string>>& arguments,
                 std::size_t jobs,
                 const std::function<void(const ChildEnd&)>& ended);

}  // namespace flyball
