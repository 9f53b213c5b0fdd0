// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How many flights each task of a job array gets.

#include <cstddef>
#include <vector>

namespace flyball {

/// Large tasks first and small ones last, so that all processors end at nearly the same time though
/// no flight's duration is known, while few tasks have to be started: each round gives half of what
/// is left to as many equal tasks as there are processors (factoring: Flynn Hummel, Schonberg and
/// Flynn, CACM 1992, doi:10.1145/135226.135232).
/// @param processors  At least 1.
/// @param most_tasks  At least 1.
/// @return Each at least 1; together `flights`. At most `most_tasks`, the smallest ones being as
///         large as that takes.
[[nodiscard]] std::vector<std::size_t> task_sizes(std::size_t flights,
                                                  std::size_t processors,
                                                  std::size_t most_tasks);

}  // namespace flyball
