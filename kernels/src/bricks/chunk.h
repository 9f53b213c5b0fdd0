// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// 32 x 32 x 32 finest cells: what questions about them look at, and where their log-odds are.
///
/// A chunk holds 512 bricks in Morton order, so that the eight bricks of a coarser cell are
/// neighbours. It keeps which cells are occupied and which are unknown (a bit each), and which
/// bricks hold such cells. Questions look at bits only: at a level above 0 the bits of a cell are
/// neighbours in one word (or, for the whole chunk, in eight). Most bricks are all free or all
/// unknown, which stands in a byte each, so that a question about a point seldom looks at a brick's
/// own masks. The log-odds lie beside the chunk, because only the map that changes needs them: a
/// revision for a reader costs a copy of the bits, a fifth of the whole.

#include "brick.h"
#include "lattice.h"
#include "scans/packed_cell.h"
#include <array>
#include <cstddef>
#include <cstdint>

namespace flyball {

/// A bit for each brick of a chunk.
using BrickBits = std::array<std::uint64_t, 8>;

/// What is known of a brick without a look at its masks, in a byte.
namespace brick_code {
/// The lowest two bits: none, all or some of its cells are unknown.
inline constexpr unsigned none_unknown = 0;
inline constexpr unsigned all_unknown = 1;
inline constexpr unsigned some_unknown = 2;
/// Whether any cell is occupied in the block of `level` (2..5) that contains the brick.
[[nodiscard]] constexpr unsigned occupied(int level) {
  return 1U << static_cast<unsigned>(level);
}
inline constexpr unsigned count = 64;
}  // namespace brick_code

struct alignas(64) Chunk {
  static constexpr std::size_t brick_count = 512;
  using Bricks = std::array<Brick, brick_count>;

  CellKey key{};
  std::uint64_t tag{};       ///< `packed::chunk(key)`.
  std::uint64_t tag_bits{};  ///< Which bits of a tag have to be those: all, or none for `nothing`.
  /// Log-odds, by numbers of bricks. They are those of the map as it is now, also where this chunk
  /// belongs to an older revision: only the thread that changes the map may look at them. Null
  /// where the map keeps none.
  Brick* bricks{};
  std::uint64_t first_revision{};  ///< The first revision (see BrickRevisions) that may show it.
  std::array<std::uint8_t, brick_count> codes{};  ///< By places of bricks, see packed::brick_place.
  BrickBits has_occupied{};
  BrickBits has_unknown{};
  BrickBits has_known{};
  std::array<CellMasks, brick_count> masks{};

  /// All is unknown. @param log_odds  All unknown as well; they outlive the chunk. Null where the
  ///                                  map keeps none.
  explicit Chunk(const CellKey& at, Bricks* log_odds = nullptr);
  void set_masks(std::size_t brick, const CellMasks& cells);
  /// Occupied cells become unknown. @pre The map keeps log-odds.
  void forget_occupied();
  void set_key(const CellKey& at);
  /// Whether it is the chunk with this tag, or the one of unknown cells.
  [[nodiscard]] bool answers(std::uint64_t of_tag) const {
    return ((tag ^ of_tag) & tag_bits) == 0;
  }
  /// Of the block of `level` (2..5) that contains the brick with this number.
  [[nodiscard]] BlockSummary block(int level, std::size_t brick) const {
    return {any(has_occupied, level, brick), any(has_unknown, level, brick),
            any(has_known, level, brick)};
  }
  [[nodiscard]] static bool any(const BrickBits& bits, int level, std::size_t brick) {
    if (level == chunk_level) {
      return (bits[0] | bits[1] | bits[2] | bits[3] | bits[4] | bits[5] | bits[6] | bits[7]) != 0;
    }
    const unsigned width = 1U << 3 * static_cast<unsigned>(level - brick_level);
    const std::uint64_t block = ~std::uint64_t{0} >> (64 - width);
    return (bits[brick >> 6U] >> (brick & 63U & ~(width - 1)) & block) != 0;
  }

 private:
  void flip_occupied(std::size_t brick);
};

/// Makes all log-odds unknown.
void clear(Chunk::Bricks& log_odds);

/// The chunk of every place where nothing is known.
[[nodiscard]] const Chunk& unknown_chunk();

}  // namespace flyball
