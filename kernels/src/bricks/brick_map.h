// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The working store: what is known of every cell, at every level.
///
/// Space is cut into chunks of 32 x 32 x 32 finest cells, found by hashing. A chunk holds 512
/// bricks in Morton order, so that the eight bricks of a coarser cell are neighbours, and for each
/// cell of level 2 (a brick) to 5 (the chunk) the greatest log-odds in it and whether any of it is
/// unknown. They are kept up with every change, so a question about a cell of any level costs the
/// same.

#include "flyball/runtime/occupancy.h"

#include "inner_loops.h"
#include "lattice.h"
#include "scan_masks.h"
#include <memory>
#include <vector>

namespace flyball {

/// 32^3 finest cells.
struct Chunk {
  static constexpr int bricks_per_edge = 8;

  CellKey key{};
  std::array<Brick, 512> bricks;
  std::array<BlockSummary, 512 + 64 + 8 + 1> blocks;  ///< Levels 2, 3, 4, 5, one after the other.

  explicit Chunk(const CellKey& at);
  /// Of the block of `level` (2..5) that contains the brick with this number.
  [[nodiscard]] BlockSummary& block(int level, std::size_t brick);
  [[nodiscard]] const BlockSummary& block(int level, std::size_t brick) const;
  void set_summary(std::size_t brick, const BlockSummary& summary);
};

class BrickMap {
 public:
  static constexpr int coarsest_level = chunk_level;

  explicit BrickMap(double finest_m, Simd simd = widest_simd());

  [[nodiscard]] const Lattice& lattice() const { return lattice_; }
  /// Makes room, so that mapping so many more chunks allocates nothing.
  void reserve(std::size_t chunks);
  void apply(const std::vector<BrickMasks>& changes);

  /// @param cell  Key at `level`, which is 0..5.
  [[nodiscard]] BlockSummary summary(const CellKey& cell, int level) const;
  /// A coarse cell is occupied when any part of it is, free when no part of it is unknown.
  [[nodiscard]] CellState state(const CellKey& cell, int level) const;
  /// Null where nothing is known.
  [[nodiscard]] const Chunk* find(const CellKey& chunk) const;
  /// In the order in which they were first seen.
  [[nodiscard]] const std::vector<std::unique_ptr<Chunk>>& chunks() const { return chunks_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  [[nodiscard]] std::size_t slot_of(const CellKey& chunk) const;
  Chunk& at(const CellKey& chunk);
  void rehash(std::size_t slots);

  Lattice lattice_;
  const InnerLoops* loops_;
  std::vector<std::unique_ptr<Chunk>> chunks_{};
  std::vector<std::unique_ptr<Chunk>> spare_{};
  std::vector<Chunk*> slots_;  ///< Open addressing; a power of two, at most half full.
};

}  // namespace flyball
