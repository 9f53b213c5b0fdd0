// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What carries bytes to an autopilot and back.

#include "flyball/runtime/result.h"
#include "flyball/runtime/time.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace flyball {

/// One end of a line that may lose bytes. Sending and receiving never wait. An interface, so that a
/// test has an autopilot in memory.
class ByteStream {
 public:
  ByteStream() = default;
  virtual ~ByteStream() = default;
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;

  /// Sends whole messages; what there is no room for is lost.
  /// @error `unavailable`: the line is gone. Later calls of `receive` may find it again, as that of
  ///        a serial device that is back under its name.
  virtual Status send(const std::vector<std::uint8_t>& bytes) = 0;
  /// Appends what has arrived to `bytes`.
  /// @error As `send`.
  virtual Status receive(std::vector<std::uint8_t>& bytes) = 0;
  /// Returns when something has arrived or `at_most` has passed, and says how long that took.
  virtual Duration wait(Duration at_most) = 0;
};

/// `udp:HOST:PORT` listens there, on this computer only, and answers whoever sends first;
/// `serial:DEVICE:BAUD` opens a serial line.
/// @error `invalid_input` for any other address, or a host that is not this computer;
///        `unavailable` where the system refuses.
[[nodiscard]] Result<std::unique_ptr<ByteStream>> open_byte_stream(const std::string& address);

}  // namespace flyball
