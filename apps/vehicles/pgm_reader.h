// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Images of 16 bits a pixel that come one after the other, as netpbm's PGM writes them.

#include "flyball/runtime/result.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace flyball {

struct PgmImage {
  int width_px{};
  int height_px{};
  std::vector<std::uint16_t> values{};  ///< Row by row, from the top.
};

/// The format "P5" (netpbm.sourceforge.net/doc/pgm.html): a header in letters, then the values, big
/// end first. Several images may follow each other without anything between them.
class PgmReader {
 public:
  /// The bytes that have come. Only the newest image is kept.
  /// @error `invalid_input`: they are no such image. Nobody can say where the next one would begin.
  Status read(const std::uint8_t* bytes, std::size_t count);
  /// The newest image that is complete; empty if none was since the last call.
  [[nodiscard]] std::optional<PgmImage> take();

 private:
  struct Header {
    int width_px{};
    int height_px{};
    std::size_t bytes{};  ///< Of the header itself.
    [[nodiscard]] std::size_t image_bytes() const {
      return bytes + 2 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    }
  };
  /// Empty while it has not come as a whole.
  [[nodiscard]] Result<std::optional<Header>> header() const;

  std::vector<std::uint8_t> waiting_{};
  std::optional<PgmImage> newest_{};
};

}  // namespace flyball
