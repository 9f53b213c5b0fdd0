// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Brings back what an MCAP file holds whose writer did not end as it should.

#include "flyball/runtime/result.h"
#include "flyball/runtime/time.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace flyball {

struct McapRecovery {
  std::size_t chunks{};
  std::uint64_t messages{};
  MissionTime begin{};  ///< Of the messages.
  MissionTime end{};
  std::size_t damaged_chunks{};  ///< That were left out.
  std::uint64_t lost_bytes{};    ///< Behind the last whole record.
  std::uint64_t missing_rows{};  ///< Gaps in the messages' sequence numbers.
  bool was_whole{};              ///< The file had its end already.
};

/// Writes all chunks of `broken` that are whole, with a new index, to `out`, which appears whole or
/// not at all. Nothing is computed anew: each message keeps its bytes, times and sequence number.
///
/// @error `not_found`: there is no file `broken`; `invalid_input`: it is no MCAP file, none of its
///        chunks is whole, or `out` is the same file; `unavailable`, `failed`: `out` cannot be
///        written.
[[nodiscard]] Result<McapRecovery> recover_mcap(const std::string& broken, const std::string& out);

}  // namespace flyball
