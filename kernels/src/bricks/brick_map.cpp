// SPDX-License-Identifier: BSD-3-Clause
#include "brick_map.h"

#include <algorithm>

namespace flyball {
namespace {

constexpr std::size_t first_slots = 256;
constexpr std::size_t near_slots = 32 * 32 * 8;

/// The cells of level 0 or 1 that a cell of the finest level is in.
std::uint64_t cells_around(unsigned bit, int level) {
  constexpr std::uint64_t eight = 0x330033;  // two along each axis
  constexpr unsigned first_of_eight = 0b101010;
  return level == 0 ? std::uint64_t{1} << bit : eight << (bit & first_of_eight);
}

/// Its tag has to be none in particular.
const Chunk& unknown_chunk() {
  static const Chunk nothing = [] {
    Chunk chunk{CellKey{-1, -1, -1}};
    chunk.tag_bits = 0;
    return chunk;
  }();
  return nothing;
}

/// Places of bricks (see packed::brick_place) by their numbers.
constexpr std::array<std::uint16_t, 512> places_of_numbers() {
  std::array<std::uint16_t, 512> places{};
  for (std::size_t place = 0; place < 512; ++place) {
    places[packed::brick_number_at[place]] = static_cast<std::uint16_t>(place);
  }
  return places;
}
constexpr std::array<std::uint16_t, 512> place_of = places_of_numbers();

}  // namespace

Chunk::Chunk(const CellKey& at) {
  set_key(at);
  codes.fill(brick_code::all_unknown);
  has_unknown.fill(~std::uint64_t{0});
  for (Brick& brick : bricks) {
    brick.cells.fill(log_odds::unknown);
  }
}

void Chunk::set_key(const CellKey& at) {
  key = at;
  tag = packed::chunk(at);
  tag_bits = ~std::uint64_t{0};
}

void Chunk::set_masks(std::size_t brick, const CellMasks& cells) {
  masks[brick] = cells;
  const std::uint64_t bit = std::uint64_t{1} << (brick & 63U);
  const auto set = [&](BrickBits& bits, bool is) {
    std::uint64_t& word = bits[brick >> 6U];
    word = is ? word | bit : word & ~bit;
  };
  set(has_unknown, cells.unknown != 0);
  set(has_known, ~cells.unknown != 0);
  const unsigned unknown = cells.unknown == 0    ? brick_code::none_unknown
                           : ~cells.unknown == 0 ? brick_code::all_unknown
                                                 : brick_code::some_unknown;
  std::uint8_t& code = codes[place_of[brick]];
  code = static_cast<std::uint8_t>((code & ~3U) | unknown);
  if ((cells.occupied != 0) != ((has_occupied[brick >> 6U] & bit) != 0)) {
    flip_occupied(brick);
  }
}

/// Seldom: in the codes of all bricks of its coarser blocks, as far as these change.
void Chunk::flip_occupied(std::size_t brick) {
  const auto any_at = [&](int level) { return any(has_occupied, level, brick); };
  const std::array<bool, 4> before{any_at(2), any_at(3), any_at(4), any_at(5)};
  has_occupied[brick >> 6U] ^= std::uint64_t{1} << (brick & 63U);
  for (int level = brick_level; level <= chunk_level; ++level) {
    if (any_at(level) == before[static_cast<std::size_t>(level - brick_level)]) {
      return;  // nor do the coarser ones
    }
    const std::size_t width = std::size_t{1} << 3 * static_cast<unsigned>(level - brick_level);
    const std::size_t first = brick & ~(width - 1);
    for (std::size_t i = first; i < first + width; ++i) {
      std::uint8_t& code = codes[place_of[i]];
      code = static_cast<std::uint8_t>(code ^ brick_code::occupied(level));
    }
  }
}

BrickMap::BrickMap(double finest_m, Simd simd)
    : lattice_{finest_m},
      loops_{&inner_loops(simd)},
      nothing_{&unknown_chunk()},
      near_(near_slots, nothing_),
      slots_(first_slots, Slot{}) {}

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
    chunk->set_masks(brick, loops_->update_brick(chunk->bricks[brick], change.free, change.hit));
  }
}

void BrickMap::fill(const CellKey& brick, const Brick& cells) {
  Chunk& chunk = at(brick.above(chunk_level - brick_level));
  const std::size_t number = brick_number(brick);
  chunk.bricks[number] = cells;
  CellMasks masks{0, 0};
  for (unsigned cell = 0; cell < 64; ++cell) {
    const std::int8_t value = cells.cells[cell];
    masks.occupied |= std::uint64_t{log_odds::is_occupied(value)} << cell;
    masks.unknown |= std::uint64_t{value == log_odds::unknown} << cell;
  }
  chunk.set_masks(number, masks);
}

std::size_t BrickMap::drop_beyond(const Vec3& p_W,
                                  double radius_m,
                                  const std::function<void(const Chunk&)>& show) {
  const auto is_far = [&](const Chunk& chunk) {
    const Aabb cube = lattice_.cube(chunk.key, chunk_level);
    const Vec3 nearest = p_W.cwiseMax(cube.min).cwiseMin(cube.max);
    return (p_W - nearest).squaredNorm() > radius_m * radius_m;
  };
  std::size_t kept = 0;  // In their order, which decides the order in which cells are shown.
  for (auto& chunk : chunks_) {
    if (is_far(*chunk)) {
      show(*chunk);
      *chunk = Chunk{CellKey{}};
      spare_.push_back(std::move(chunk));
    } else if (&chunks_[kept] != &chunk) {
      chunks_[kept++] = std::move(chunk);
    } else {
      ++kept;
    }
  }
  const std::size_t dropped = chunks_.size() - kept;
  chunks_.resize(kept);
  if (dropped > 0) {
    rehash(slots_.size());
    near_.assign(near_slots, nothing_);
    for (const auto& chunk : chunks_) {
      take_near_slot(*chunk);
    }
  }
  return dropped;
}

const Chunk& BrickMap::far_chunk(std::uint64_t key) const {
  const Chunk* found = slots_[slot_of(key)].chunk;
  return found == nullptr ? *nothing_ : *found;
}

BlockSummary BrickMap::summary(const CellKey& cell, int level) const {
  const Chunk& chunk = chunk_at(cell.above(chunk_level - level));
  if (level >= brick_level) {
    const int down = level - brick_level;
    return chunk.block(level, brick_number({cell.x << down, cell.y << down, cell.z << down}));
  }
  const CellMasks& masks = chunk.masks[brick_number(cell.above(brick_level - level))];
  const CellKey low{cell.x << level, cell.y << level, cell.z << level};
  const std::uint64_t cells = cells_around(bit_in_brick(low), level);
  return {(masks.occupied & cells) != 0, (masks.unknown & cells) != 0,
          (~masks.unknown & cells) != 0};
}

CellState BrickMap::state(const CellKey& cell, int level) const {
  const BlockSummary whole = summary(cell, level);
  if (whole.has_occupied) {
    return CellState::occupied;
  }
  return whole.has_unknown ? CellState::unknown : CellState::free;
}

std::size_t BrickMap::bytes() const {
  return (chunks_.size() + spare_.size()) * sizeof(Chunk) + near_.size() * sizeof(const Chunk*) +
         slots_.size() * sizeof(Slot);
}

Chunk& BrickMap::at(const CellKey& chunk) {
  const std::uint64_t key = packed::chunk(chunk);
  const std::size_t slot = slot_of(key);
  if (slots_[slot].chunk != nullptr) {
    return *slots_[slot].chunk;
  }
  if (spare_.empty()) {
    chunks_.push_back(std::make_unique<Chunk>(chunk));
  } else {
    chunks_.push_back(std::move(spare_.back()));
    spare_.pop_back();
    chunks_.back()->set_key(chunk);
  }
  Chunk& made = *chunks_.back();
  slots_[slot] = {key, &made};
  take_near_slot(made);
  if (2 * chunks_.size() > slots_.size()) {
    rehash(2 * slots_.size());
  }
  return made;
}

void BrickMap::take_near_slot(const Chunk& chunk) {
  const Chunk*& near = near_[packed::near_number(chunk.tag)];
  if (near == nothing_) {
    near = &chunk;
  }
}

void BrickMap::rehash(std::size_t slots) {
  slots_.assign(slots, Slot{});
  for (const auto& chunk : chunks_) {
    const std::uint64_t key = packed::chunk(chunk->key);
    slots_[slot_of(key)] = {key, chunk.get()};
  }
}

}  // namespace flyball
