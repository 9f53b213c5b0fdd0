// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The working store: the log-odds of every cell, and what questions look at (see BrickCells),
/// which is kept up with every change. Readers on other threads get revisions of the latter.

#include "brick_cells.h"
#include "brick_revisions.h"
#include "scans/scan_masks.h"
#include <functional>
#include <memory>
#include <vector>

namespace flyball {

class BrickMap {
 public:
  explicit BrickMap(double finest_m, Simd simd = widest_simd());
  /// A map that keeps the states of cells and no log-odds, in a quarter of the memory. Only `show`
  /// may change it.
  [[nodiscard]] static BrickMap of_states(double finest_m);

  /// What is known now.
  [[nodiscard]] const BrickCells& cells() const { return cells_; }
  [[nodiscard]] const Lattice& lattice() const { return cells_.lattice(); }
  /// What is known now and stays so: it may be read on another thread, without a lock, while this
  /// map changes and after it is gone. Its owners are those who hold copies of the pointer. Costs a
  /// copy of the index; until it is given back, each chunk is copied when it changes for the first
  /// time. To be called by the thread that changes the map.
  [[nodiscard]] std::shared_ptr<const BrickCells> revision();

  /// Makes room, so that mapping so many more chunks allocates nothing.
  void reserve(std::size_t chunks);
  void apply(const std::vector<BrickMasks>& changes);
  /// Replaces a brick, as a file has it.
  void fill(const CellKey& brick, const Brick& cells);
  /// Sets what questions find in bricks. Log-odds stay as they are.
  void show(const std::vector<BrickStates>& bricks);
  /// Forgets the chunks that lie farther from `p_W` than `radius_m` as a whole. Their memory is
  /// kept for new ones.
  ///
  /// @param show  Sees each of them before it goes.
  /// @return      How many.
  std::size_t drop_beyond(
      const Vec3& p_W,
      double radius_m,
      const std::function<void(const Chunk&)>& show = [](const Chunk&) {});

  /// Makes the occupied cells unknown in all chunks of which a part lies within `radius_m`.
  /// @pre The map keeps log-odds.
  void forget_occupied(const Vec3& p_W, double radius_m);

  [[nodiscard]] std::size_t bytes() const;

 private:
  /// A chunk with its log-odds, if the map keeps them, all unknown, not in use.
  struct Spare {
    std::unique_ptr<Chunk::Bricks> bricks;
    std::unique_ptr<Chunk> chunk;
  };
  [[nodiscard]] Spare make_spare() const;
  /// Whether a chunk as a whole lies farther from `p_W`.
  [[nodiscard]] bool is_beyond(const CellKey& chunk, const Vec3& p_W, double radius_m) const;
  /// Takes note of who reads, before the map changes.
  void begin_change();
  /// A chunk that no reader sees, made or copied if need be.
  Chunk& at(const CellKey& chunk);
  Chunk& make(const CellKey& chunk);
  void drop(std::size_t number);

  BrickCells cells_;
  bool keeps_log_odds_{true};
  /// Keeps the chunks. Owners: this map and those who hold revisions of it.
  std::shared_ptr<BrickRevisions> revisions_{std::make_shared<BrickRevisions>()};
  std::vector<std::unique_ptr<Chunk::Bricks>> bricks_{};  ///< Of the chunks, in their order.
  std::vector<Spare> spare_{};
  BrickRevisions::Number newest_read_{};
  bool is_changed_{true};  ///< Since the last revision.
};

}  // namespace flyball
