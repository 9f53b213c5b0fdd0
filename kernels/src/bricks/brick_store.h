// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Bricks as a store of LayeredMapper: the cells of one resolution, freed by stock's rule.

#include "brick_contents.h"
#include "brick_map.h"
#include "map_file.h"
#include "maps/layered_mapper.h"

namespace flyball {

class BrickStore {
 public:
  explicit BrickStore(double cell_m) : map_{cell_m} {}

  [[nodiscard]] double cell_m() const { return map_.lattice().cell_m(0); }
  [[nodiscard]] const BrickCells& cells() const { return map_.cells(); }
  [[nodiscard]] std::shared_ptr<const BrickCells> revision() { return map_.revision(); }

  void write(const std::vector<BrickMasks>& masks) { map_.apply(masks); }

  void show(const BrickStates& brick) { map_.show({brick}); }

  [[nodiscard]] bool is_occupied(const CellKey& cell) const {
    return log_odds::is_occupied(log_odds_of(cell));
  }
  [[nodiscard]] bool is_confirmed(const CellKey& cell) const {
    constexpr auto steps = static_cast<std::int8_t>(confirmed_log_odds * log_odds_steps);
    return log_odds_of(cell) >= steps;
  }
  void confirm(const CellKey& cell) {
    const BrickMasks hit{cell.above(brick_level), 0, std::uint64_t{1} << bit_in_brick(cell)};
    while (!is_confirmed(cell)) {
      map_.apply({hit});
    }
  }

  [[nodiscard]] MapLevel counts() const { return contents_of(map_, 0).levels.front(); }
  [[nodiscard]] std::size_t bytes() const { return map_.bytes(); }

  [[nodiscard]] Status write_file(const std::string& path) const {
    return write_map_file(map_, std::nullopt, path);
  }
  [[nodiscard]] static Result<BrickStore> read_file(const std::string& path) {
    auto map = read_map_file(path);
    if (!map) {
      return map.error();
    }
    return BrickStore{std::move(*map)};
  }

 private:
  explicit BrickStore(BrickMap map) : map_{std::move(map)} {}

  /// Of a cell that is known.
  [[nodiscard]] std::int8_t log_odds_of(const CellKey& cell) const {
    const Chunk& chunk = map_.cells().chunk_at(cell.above(chunk_level));
    return chunk.bricks[brick_number(cell.above(brick_level))].cells[bit_in_brick(cell)];
  }

  BrickMap map_;
};

}  // namespace flyball
