// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One computation for each of many things, by several threads at once.

#include <cstddef>
#include <functional>

namespace flyball {

/// Calls `job(i)` once for each i below `count`: on the calling thread and on up to `threads` - 1
/// others, which use its cores when nobody else wants them. A call changes nothing but what belongs
/// to its index, so that the result does not depend on who made it. Where the system has no thread
/// left, those that there are do all. What the others take is told to the executor
/// (`add_helpers_time`).
void for_each_index(std::size_t count, int threads, const std::function<void(std::size_t)>& job);

}  // namespace flyball
