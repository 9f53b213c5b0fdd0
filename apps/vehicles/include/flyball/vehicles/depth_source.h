// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A depth camera that is not simulated.

#include "flyball/runtime/result.h"
#include "flyball/runtime/time.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

struct DepthReading {
  Duration arrived{};  ///< By the source's clock.
  /// Along the optical axis [m], row by row; not a number where nothing was measured, which neither
  /// marks nor clears anything in a map.
  std::vector<float> depth_m{};
};

/// An interface, because a test has a camera without a device. Called by one thread.
class DepthSource {
 public:
  DepthSource() = default;
  virtual ~DepthSource() = default;
  DepthSource(const DepthSource&) = delete;
  DepthSource& operator=(const DepthSource&) = delete;

  /// Waits for the first image.
  /// @param stop  Asked often; true ends the wait. May be empty.
  /// @error `unavailable`: none came within 15 s, or stopped; `invalid_input`: what came is no
  /// image
  ///        of the size that was asked for.
  virtual Status await(const std::function<bool()>& stop) = 0;
  /// The newest image, if there is one since the last call.
  virtual std::optional<DepthReading> take() = 0;
  /// Of the clock that stamps the images.
  [[nodiscard]] virtual Duration now() const = 0;
};

struct DepthPipeSettings {
  int width_px{};
  int height_px{};
  /// Called, by whoever calls the source, with one sentence for each thing that a person should
  /// know: that no images come, and that they come again.
  std::function<void(const std::string&)> tell{};
  std::function<Duration()> clock{};  ///< The time since any moment. Never empty.
};

/// Reads 16-bit PGM images, one after the other, whose values are millimetres, from a pipe: its
/// name, or "-" for standard input. 0 says that nothing was measured there; what is beyond the
/// camera's range, as 65535 is, says that all up to there is free. A thread reads, so that an
/// image's time is when it came.
/// @error `invalid_input` where that is no pipe; `unavailable` where the system refuses.
[[nodiscard]] Result<std::unique_ptr<DepthSource>> open_depth_pipe(
    const std::string& name, const DepthPipeSettings& settings);

}  // namespace flyball
