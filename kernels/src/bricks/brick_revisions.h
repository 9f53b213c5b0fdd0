// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Keeps the chunks of a brick map, and with them the revisions that readers on other threads hold.
///
/// A revision is a copy of the map's index; the chunks are shared. While somebody reads a revision,
/// the map copies a chunk before it changes it for the first time since then (copy on write), and
/// what was replaced waits here until no revision that shows it is read any more. Revisions are
/// numbered, and each chunk knows the first one that may show it, so that neither handing on a
/// revision nor giving it back counts references of chunks.
///
/// One thread, the map's, calls everything here. Readers touch nothing but the count of a revision
/// that they give back, and the index and the chunks, which nobody changes meanwhile.

#include "brick_cells.h"
#include <atomic>
#include <memory>
#include <vector>

namespace flyball {

class BrickRevisions : public std::enable_shared_from_this<BrickRevisions> {
 public:
  using Number = std::uint64_t;

  /// The chunks of the map as it is now, in its order.
  std::vector<std::unique_ptr<Chunk>> chunks{};

  /// Its owners are the readers that hold copies of the pointer. It keeps the chunks, too, when
  /// the map is gone.
  ///
  /// @param now         The map's own index.
  /// @param is_changed  Since the last revision; if not, that one is handed on again.
  [[nodiscard]] std::shared_ptr<const BrickCells> hand_on(const BrickCells& now, bool is_changed);

  /// The number that the next revision of a changed map will have.
  [[nodiscard]] Number next() const { return last_ + 1; }
  /// The newest revision that has a reader; 0 without one.
  [[nodiscard]] Number newest_read() const;
  /// A copy of a chunk, to be shown from the next revision on.
  [[nodiscard]] std::unique_ptr<Chunk> copy_of(const Chunk& chunk);
  /// Keeps a chunk that the map does not have any more for those who read it.
  void retire(std::unique_ptr<Chunk> chunk);
  /// Takes back the memory of retired chunks that no reader can reach any more.
  void collect();
  /// Without the chunks of the map as it is now.
  [[nodiscard]] std::size_t bytes() const;

 private:
  // Memory of chunks that is kept for the next copies: about what a frame with a range of 20 m
  // changes, measured, see tests/bench/map_revisions.cpp.
  static constexpr std::size_t most_spare = 256;
  static constexpr std::size_t most_idle =
      2;  ///< Revisions without a reader, kept for their memory.

  struct Revision {
    explicit Revision(const BrickCells& now) : cells{now} {}
    BrickCells cells;
    Number number{};
    std::atomic<int> readers{0};
  };
  struct Retired {
    std::unique_ptr<Chunk> chunk;
    Number last_shown;
  };
  [[nodiscard]] Revision& idle_revision(const BrickCells& now);
  [[nodiscard]] bool is_read(const Retired& retired) const;

  std::vector<std::unique_ptr<Revision>> revisions_{};
  Revision* newest_{};
  Number last_{};
  std::vector<Retired> retired_{};
  std::vector<std::unique_ptr<Chunk>> spare_{};
};

}  // namespace flyball
