// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What is known of every cell, at every level: the part of the brick map that questions look at.
///
/// Space is cut into chunks of 32 x 32 x 32 finest cells, found by hashing. This is only the index
/// that finds them; their owner is another one. A copy of it is a revision of the map, as long as
/// the chunks that it names stay as they are (see BrickRevisions). Nothing is cached on the way to
/// an answer, so any number of threads may ask at the same time.

#include "flyball/runtime/occupancy.h"

#include "chunk.h"
#include "scans/inner_loops.h"
#include <optional>
#include <vector>

namespace flyball {

class BrickCells {
 public:
  static constexpr int coarsest_level = chunk_level;

  explicit BrickCells(double finest_m, Simd simd = widest_simd());

  [[nodiscard]] const Lattice& lattice() const { return lattice_; }
  [[nodiscard]] const InnerLoops& loops() const { return *loops_; }

  /// @param cell  Key at `level`, which is 0..5.
  [[nodiscard]] BlockSummary summary(const CellKey& cell, int level) const;
  /// A coarse cell is occupied when any part of it is, free when no part of it is unknown.
  [[nodiscard]] CellState state(const CellKey& cell, int level) const;
  /// @param brick  Key at `brick_level`.
  [[nodiscard]] const CellMasks& masks(const CellKey& brick) const {
    return chunk_at(brick.above(chunk_level - brick_level)).masks[brick_number(brick)];
  }
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
  [[nodiscard]] const std::vector<const Chunk*>& chunks() const { return chunks_; }
  [[nodiscard]] std::size_t bytes() const;

  /// Makes room for so many more chunks.
  void reserve(std::size_t chunks);
  /// Where a chunk stands among `chunks()`.
  [[nodiscard]] std::optional<std::size_t> number_of(const CellKey& chunk) const;
  /// @pre There is none with its key. All chunks outlive their last use here.
  void add(const Chunk& chunk);
  /// @pre They have the same key.
  void replace(std::size_t number, const Chunk& chunk);
  /// Replaces all of them. Gives back no memory.
  void assign(const std::vector<const Chunk*>& chunks);

 private:
  struct Slot {
    std::uint64_t key;
    std::size_t number_plus_one;  ///< Among `chunks()`; 0 where the slot is empty.
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
    while (slots_[slot].number_plus_one != 0 && slots_[slot].key != key) {
      slot = (slot + 1) & mask;
    }
    return slot;
  }
  /// Unless another one has it.
  void take_near_slot(const Chunk& chunk);
  void rehash(std::size_t slots);

  Lattice lattice_;
  const InnerLoops* loops_;
  const Chunk* nothing_;
  std::vector<const Chunk*> chunks_{};
  /// The first chunk that came to a place, or the one of unknown cells. Chunks have places of their
  /// own as long as the map is not wider than 32 x 32 x 8 of them.
  std::vector<const Chunk*> near_;
  std::vector<Slot> slots_;  ///< All chunks. Open addressing; a power of two, at most half full.
};

}  // namespace flyball
