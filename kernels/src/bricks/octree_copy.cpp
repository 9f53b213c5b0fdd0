// SPDX-License-Identifier: BSD-3-Clause
#include "octree_copy.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr unsigned tree_depth = 16;
constexpr unsigned chunk_depth = tree_depth - chunk_level;

float log_odds_of(std::int8_t cell) {
  return static_cast<float>(cell) / log_odds_steps;
}

/// Rounding never makes a free cell occupied, nor the other way round.
std::int8_t cell_of(float log_odds, bool is_occupied) {
  const float steps =
      std::nearbyint(std::clamp(log_odds * log_odds_steps, static_cast<float>(log_odds::least),
                                static_cast<float>(log_odds::most)));
  const auto cell = static_cast<int>(steps);
  return static_cast<std::int8_t>(is_occupied ? std::max(cell, 0) : std::min(cell, -1));
}

/// The key of a coarse cell in a tree whose own cells are as coarse: both have their origin in the
/// middle of the keys.
octomap::OcTreeKey coarse_key(const CellKey& cell, int level) {
  const auto key = [level](int k) {
    return static_cast<octomap::key_type>(k + Lattice::half_keys - (Lattice::half_keys >> level));
  };
  return {key(cell.x), key(cell.y), key(cell.z)};
}

/// The greatest log-odds among the finest cells of a cell.
std::int8_t most_in(const Chunk& chunk, const CellKey& cell, int level) {
  const int edge = 1 << level;
  std::int8_t most = log_odds::unknown;
  for (int i = 0; i < edge * edge * edge; ++i) {
    const CellKey finest{cell.x * edge + i % edge, cell.y * edge + i / edge % edge,
                         cell.z * edge + i / (edge * edge)};
    const Brick& brick = chunk.bricks[brick_number(finest.above(brick_level))];
    most = std::max(most, brick.cells[bit_in_brick(finest)]);
  }
  return most;
}

void prune_below(octomap::OcTreeNode* node, octomap::OcTree& tree) {
  if (tree.nodeHasChildren(node)) {
    for (unsigned child = 0; child < 8; ++child) {
      if (tree.nodeChildExists(node, child)) {
        prune_below(tree.getNodeChild(node, child), tree);
      }
    }
    (void)tree.pruneNode(node);
  }
}

/// The part of the tree that a chunk fills: without this a map would need ten times its memory.
void prune_chunk(const CellKey& chunk, int level, octomap::OcTree& tree) {
  const octomap::OcTreeKey key = coarse_key(chunk.below(chunk_level - level), level);
  octomap::OcTreeNode* node = tree.getRoot();
  for (int depth = tree_depth - 1; node != nullptr && depth >= chunk_level - level; --depth) {
    const unsigned child = octomap::computeChildIdx(key, depth);
    const bool exists = tree.nodeHasChildren(node) && tree.nodeChildExists(node, child);
    node = exists ? tree.getNodeChild(node, child) : nullptr;
  }
  if (node != nullptr) {
    prune_below(node, tree);
  }
}

struct CellsToAdd {
  int level;
  TreeCells kind;
};

struct CellOf {
  const Chunk& chunk;
  const CellKey& cell;
  const CellsToAdd& wanted;
};

float value_of(const CellOf& of, const octomap::OcTree& tree) {
  const float log_odds = log_odds_of(most_in(of.chunk, of.cell, of.wanted.level));
  if (of.wanted.kind == TreeCells::log_odds) {
    return log_odds;
  }
  return log_odds < 0.0F ? tree.getClampingThresMinLog() : tree.getClampingThresMaxLog();
}

void add_cell(const BrickMap& map, const CellOf& of, octomap::OcTree& tree) {
  const int level = of.wanted.level;
  if (map.cells().state(of.cell, level) != CellState::unknown) {
    tree.setNodeValue(coarse_key(of.cell, level), value_of(of, tree), true);
  }
}

void add_chunk(const BrickMap& map,
               const Chunk& chunk,
               const CellsToAdd& wanted,
               octomap::OcTree& tree) {
  const int edge = 1 << (chunk_level - wanted.level);
  for (int z = 0; z < edge; ++z) {
    for (int y = 0; y < edge; ++y) {
      for (int x = 0; x < edge; ++x) {
        const CellKey cell{chunk.key.x * edge + x, chunk.key.y * edge + y, chunk.key.z * edge + z};
        add_cell(map, {chunk, cell, wanted}, tree);
      }
    }
  }
}

CellKey first_cell(const octomap::OcTreeKey& leaf, unsigned depth) {
  const int below = (1 << (tree_depth - depth)) - 1;
  return {leaf[0] & ~below, leaf[1] & ~below, leaf[2] & ~below};
}

/// Leaves come in Morton order, so those of one chunk follow each other.
std::size_t chunks_in(const octomap::OcTree& tree) {
  std::size_t chunks = 0;
  CellKey last{-1, -1, -1};
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs() && chunks <= most_chunks_read;
       ++leaf) {
    const CellKey chunk = first_cell(leaf.getKey(), leaf.getDepth()).above(chunk_level);
    if (leaf.getDepth() < chunk_depth) {
      chunks += std::size_t{1} << 3 * std::min(chunk_depth - leaf.getDepth(), 7U);
    } else if (!(chunk == last)) {
      ++chunks;
    }
    last = chunk;
  }
  return chunks;
}

/// Calls `see(brick)` for each brick that the cube of `edge` cells at `first` overlaps.
template <class See>
void for_each_brick(const CellKey& first, int edge, See&& see) {
  const CellKey low = first.above(brick_level);
  const int bricks = std::max(edge >> brick_level, 1);
  for (int z = 0; z < bricks; ++z) {
    for (int y = 0; y < bricks; ++y) {
      for (int x = 0; x < bricks; ++x) {
        see(CellKey{low.x + x, low.y + y, low.z + z});
      }
    }
  }
}

void fill_cube(Brick& brick, const CellKey& first, int edge, std::int8_t value) {
  for (int z = 0; z < edge; ++z) {
    for (int y = 0; y < edge; ++y) {
      const unsigned row = bit_in_brick({first.x, first.y + y, first.z + z});
      std::fill_n(brick.cells.begin() + row, edge, value);
    }
  }
}

}  // namespace

std::unique_ptr<octomap::OcTree> to_octree(const BrickMap& map, int level, TreeCells cells) {
  auto tree = std::make_unique<octomap::OcTree>(map.lattice().cell_m(level));
  tree->setClampingThresMin(0.12);  // both as in MAVBench's code
  tree->setClampingThresMax(0.97);
  for (const Chunk* chunk : map.cells().chunks()) {
    add_chunk(map, *chunk, {level, cells}, *tree);
    prune_chunk(chunk->key, level, *tree);
  }
  tree->updateInnerOccupancy();
  tree->prune();
  return tree;
}

Status check_extent(const octomap::OcTree& tree) {
  if (chunks_in(tree) > most_chunks_read) {
    return Error{ErrorCode::invalid_input,
                 "the map fills more than " + std::to_string(most_chunks_read) +
                     " blocks of 32 x 32 x 32 cells; cut it, or give it wider cells"};
  }
  return Done{};
}

Result<BrickMap> to_bricks(const octomap::OcTree& tree) {
  if (const Status fits = check_extent(tree); !fits) {
    return fits.error();
  }
  BrickMap map{tree.getResolution()};
  Brick brick{};
  brick.cells.fill(log_odds::unknown);
  CellKey at{-1, -1, -1};
  const auto put = [&] {
    if (at.x >= 0) {
      map.fill(at, brick);
    }
    brick.cells.fill(log_odds::unknown);
  };
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const CellKey first = first_cell(leaf.getKey(), leaf.getDepth());
    const int edge = 1 << (tree_depth - leaf.getDepth());
    const std::int8_t value = cell_of(leaf->getLogOdds(), tree.isNodeOccupied(*leaf));
    for_each_brick(first, edge, [&](const CellKey& key) {
      if (!(key == at)) {
        put();
        at = key;
      }
      if (edge >= 1 << brick_level) {
        brick.cells.fill(value);
      } else {
        fill_cube(brick, first, edge, value);
      }
    });
  }
  put();
  return map;
}

}  // namespace flyball
