// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The working store: what is known of every cell, at every level.
///
/// Space is cut into chunks of 32 x 32 x 32 finest cells, found by hashing. A chunk holds 512
/// bricks in Morton order, so that the eight bricks of a coarser cell are neighbours. Beside the
/// log-odds it keeps, with every change, which cells are occupied and which are unknown (a bit
/// each), and which bricks hold such cells. Questions look at bits only: at a level above 0 the
/// bits of a cell are neighbours in one word (or, for the whole chunk, in eight). Most bricks are
/// all free or all unknown, which stands in a byte each, so that a question about a point seldom
/// looks at a brick's own masks.

#include "flyball/runtime/occupancy.h"

#include "lattice.h"
#include "scans/inner_loops.h"
#include "scans/packed_cell.h"
#include "scans/scan_masks.h"
#include <array>
#include <functional>
#include <memory>
#include <vector>

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

/// 32^3 finest cells.
struct Chunk {
  static constexpr int bricks_per_edge = 8;

  CellKey key{};
  std::uint64_t tag{};       ///< `packed::chunk(key)`.
  std::uint64_t tag_bits{};  ///< Which bits of a tag have to be those: all, or none for `nothing`.
  std::array<std::uint8_t, 512> codes;  ///< By places of bricks, see packed::brick_place.
  BrickBits has_occupied{};
  BrickBits has_unknown;
  BrickBits has_known{};
  std::array<CellMasks, 512> masks{};
  std::array<Brick, 512> bricks;

  explicit Chunk(const CellKey& at);
  void set_masks(std::size_t brick, const CellMasks& cells);
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

class BrickMap {
 public:
  static constexpr int coarsest_level = chunk_level;

  explicit BrickMap(double finest_m, Simd simd = widest_simd());

  [[nodiscard]] const Lattice& lattice() const { return lattice_; }
  [[nodiscard]] const InnerLoops& loops() const { return *loops_; }
  /// Makes room, so that mapping so many more chunks allocates nothing.
  void reserve(std::size_t chunks);
  void apply(const std::vector<BrickMasks>& changes);
  /// Replaces a brick, as a file has it.
  void fill(const CellKey& brick, const Brick& cells);
  /// Forgets the chunks that lie farther from `p_W` than `radius_m` as a whole. Their memory is
  /// kept for new ones.
  ///
  /// @param show  Sees each of them before it goes.
  /// @return      How many.
  std::size_t drop_beyond(
      const Vec3& p_W,
      double radius_m,
      const std::function<void(const Chunk&)>& show = [](const Chunk&) {});

  /// @param cell  Key at `level`, which is 0..5.
  [[nodiscard]] BlockSummary summary(const CellKey& cell, int level) const;
  /// A coarse cell is occupied when any part of it is, free when no part of it is unknown.
  [[nodiscard]] CellState state(const CellKey& cell, int level) const;
  /// A chunk of unknown cells where nothing is known. What is found there decides no branch, so
  /// that questions about random places do not wait for wrong guesses.
  [[nodiscard]] const Chunk& chunk_at(const CellKey& chunk) const {
    return chunk_with(packed::chunk(chunk));
  }
  /// The same, of a cell of the lattice.
  [[nodiscard]] const Chunk& chunk_of(PackedCell cell) const {
    return chunk_with(packed::chunk(cell));
  }
  /// Most often the cell's chunk, or the one of unknown cells: if it `answers`.
  [[nodiscard]] const Chunk& near_chunk(PackedCell cell) const {
    return *near_[packed::near_number(packed::chunk(cell))];
  }
  /// Null where nothing is known.
  [[nodiscard]] const Chunk* find(const CellKey& chunk) const {
    const Chunk* found = &chunk_at(chunk);
    return found == nothing_ ? nullptr : found;
  }
  /// In the order in which they were first seen.
  [[nodiscard]] const std::vector<std::unique_ptr<Chunk>>& chunks() const { return chunks_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Slot {
    std::uint64_t key;
    Chunk* chunk;  ///< Null where the slot is empty.
  };
  [[nodiscard]] const Chunk& chunk_with(std::uint64_t key) const {
    const Chunk& near = *near_[packed::near_number(key)];
    return near.answers(key) ? near : far_chunk(key);
  }
  [[nodiscard]] const Chunk& far_chunk(std::uint64_t key) const;
  /// The slot with this chunk, or the empty one where it belongs.
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const {
    constexpr std::uint64_t golden = 0x9E3779B97F4A7C15;  // 2^64 / golden ratio: Knuth, TAOCP 6.4
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = (key * golden >> 32U) & mask;
    while (slots_[slot].chunk != nullptr && slots_[slot].key != key) {
      slot = (slot + 1) & mask;
    }
    return slot;
  }
  Chunk& at(const CellKey& chunk);
  /// Unless another one has it.
  void take_near_slot(const Chunk& chunk);
  void rehash(std::size_t slots);

  Lattice lattice_;
  const InnerLoops* loops_;
  std::vector<std::unique_ptr<Chunk>> chunks_{};
  std::vector<std::unique_ptr<Chunk>> spare_{};
  const Chunk* nothing_;
  /// The first chunk that came to a place, or the one of unknown cells. Chunks have places of their
  /// own as long as the map is not wider than 32 x 32 x 8 of them.
  std::vector<const Chunk*> near_;
  std::vector<Slot> slots_;  ///< All chunks. Open addressing; a power of two, at most half full.
};

}  // namespace flyball
