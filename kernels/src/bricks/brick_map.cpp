// SPDX-License-Identifier: BSD-3-Clause
#include "brick_map.h"

#include <algorithm>

namespace flyball {
namespace {

constexpr std::size_t first_slots = 256;

/// Where in `Chunk::blocks` a level begins.
constexpr std::array<std::size_t, 4> level_begin{0, 512, 512 + 64, 512 + 64 + 8};

std::size_t block_index(int level, std::size_t brick) {
  const auto above = static_cast<std::size_t>(level - brick_level);
  return level_begin[above] + (brick >> 3 * above);
}

}  // namespace

Chunk::Chunk(const CellKey& at) : key{at} {
  for (Brick& brick : bricks) {
    brick.cells.fill(log_odds::unknown);
  }
}

BlockSummary& Chunk::block(int level, std::size_t brick) {
  return blocks[block_index(level, brick)];
}

const BlockSummary& Chunk::block(int level, std::size_t brick) const {
  return blocks[block_index(level, brick)];
}

void Chunk::set_summary(std::size_t brick, const BlockSummary& summary) {
  block(brick_level, brick) = summary;
  for (int above = brick_level + 1; above <= chunk_level; ++above) {
    const std::size_t first = brick >> 3 * static_cast<unsigned>(above - brick_level)
                                           << 3 * static_cast<unsigned>(above - brick_level);
    const BlockSummary* parts = &block(above - 1, first);
    BlockSummary whole = parts[0];
    for (std::size_t part = 1; part < 8; ++part) {
      whole.most = std::max(whole.most, parts[part].most);
      whole.has_unknown = whole.has_unknown || parts[part].has_unknown;
    }
    BlockSummary& known = block(above, brick);
    if (known.most == whole.most && known.has_unknown == whole.has_unknown) {
      return;
    }
    known = whole;
  }
}

BrickMap::BrickMap(double finest_m, Simd simd)
    : lattice_{finest_m}, loops_{&inner_loops(simd)}, slots_(first_slots, nullptr) {}

void BrickMap::reserve(std::size_t chunks) {
  while (spare_.size() < chunks) {
    spare_.push_back(std::make_unique<Chunk>(CellKey{}));
  }
  const std::size_t needed = chunks_.size() + chunks;
  chunks_.reserve(needed);
  std::size_t slots = slots_.size();
  while (slots < 2 * needed) {
    slots *= 2;
  }
  if (slots != slots_.size()) {
    rehash(slots);
  }
}

void BrickMap::apply(const std::vector<BrickMasks>& changes) {
  Chunk* chunk = nullptr;
  for (const BrickMasks& change : changes) {
    const CellKey key = change.brick.above(chunk_level - brick_level);
    if (chunk == nullptr || !(chunk->key == key)) {
      chunk = &at(key);
    }
    const std::size_t brick = brick_number(change.brick);
    const BlockSummary summary =
        loops_->update_brick(chunk->bricks[brick], change.free, change.hit);
    const BlockSummary& known = chunk->block(brick_level, brick);
    if (summary.most != known.most || summary.has_unknown != known.has_unknown) {
      chunk->set_summary(brick, summary);
    }
  }
}

BlockSummary BrickMap::summary(const CellKey& cell, int level) const {
  const Chunk* chunk = find(cell.above(chunk_level - level));
  if (chunk == nullptr) {
    return {};
  }
  if (level >= brick_level) {
    const int down = level - brick_level;
    return chunk->block(level, brick_number({cell.x << down, cell.y << down, cell.z << down}));
  }
  const Brick& brick = chunk->bricks[brick_number(cell.above(brick_level - level))];
  const CellKey low{cell.x << level, cell.y << level, cell.z << level};
  const unsigned first = bit_in_brick(low);
  BlockSummary whole{brick.cells[first], brick.cells[first] == log_odds::unknown};
  for (unsigned offset = 1; level == 1 && offset < 8; ++offset) {
    const unsigned bit = first + (offset & 1U) + (offset >> 1U & 1U) * 4 + (offset >> 2U) * 16;
    whole.most = std::max(whole.most, brick.cells[bit]);
    whole.has_unknown = whole.has_unknown || brick.cells[bit] == log_odds::unknown;
  }
  return whole;
}

CellState BrickMap::state(const CellKey& cell, int level) const {
  const BlockSummary whole = summary(cell, level);
  if (log_odds::is_occupied(whole.most)) {
    return CellState::occupied;
  }
  return whole.has_unknown ? CellState::unknown : CellState::free;
}

const Chunk* BrickMap::find(const CellKey& chunk) const {
  return slots_[slot_of(chunk)];
}

std::size_t BrickMap::bytes() const {
  return (chunks_.size() + spare_.size()) * sizeof(Chunk) + slots_.size() * sizeof(Chunk*);
}

/// The slot with this chunk, or the empty one where it belongs.
std::size_t BrickMap::slot_of(const CellKey& chunk) const {
  const auto packed = static_cast<std::uint64_t>(static_cast<std::uint32_t>(chunk.x)) << 42U ^
                      static_cast<std::uint64_t>(static_cast<std::uint32_t>(chunk.y)) << 21U ^
                      static_cast<std::uint64_t>(static_cast<std::uint32_t>(chunk.z));
  constexpr std::uint64_t golden = 0x9E3779B97F4A7C15;  // 2^64 / golden ratio: Knuth, TAOCP 6.4
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = (packed * golden >> 32U) & mask;
  while (slots_[slot] != nullptr && !(slots_[slot]->key == chunk)) {
    slot = (slot + 1) & mask;
  }
  return slot;
}

Chunk& BrickMap::at(const CellKey& chunk) {
  const std::size_t slot = slot_of(chunk);
  if (slots_[slot] != nullptr) {
    return *slots_[slot];
  }
  if (spare_.empty()) {
    chunks_.push_back(std::make_unique<Chunk>(chunk));
  } else {
    chunks_.push_back(std::move(spare_.back()));
    spare_.pop_back();
    chunks_.back()->key = chunk;
  }
  Chunk& made = *chunks_.back();
  slots_[slot] = &made;
  if (2 * chunks_.size() > slots_.size()) {
    rehash(2 * slots_.size());
  }
  return made;
}

void BrickMap::rehash(std::size_t slots) {
  slots_.assign(slots, nullptr);
  for (const auto& chunk : chunks_) {
    slots_[slot_of(chunk->key)] = chunk.get();
  }
}

}  // namespace flyball
