// SPDX-License-Identifier: BSD-3-Clause
// tested-in: brick_map
#include "brick_cells.h"

#include "scans/scan_masks.h"

namespace flyball {
namespace {

constexpr std::size_t first_slots = 256;
constexpr std::size_t near_slots = std::size_t{32} * 32 * 8;

/// The cells of level 0 or 1 that a cell of the finest level is in.
std::uint64_t cells_around(unsigned bit, int level) {
  constexpr std::uint64_t eight = 0x330033;  // two along each axis
  constexpr unsigned first_of_eight = 0b101010;
  return level == 0 ? std::uint64_t{1} << bit : eight << (bit & first_of_eight);
}

}  // namespace

BrickCells::BrickCells(double finest_m, Simd simd)
    : lattice_{finest_m},
      loops_{&inner_loops(simd)},
      nothing_{&unknown_chunk()},
      near_(near_slots, nothing_),
      slots_(first_slots, Slot{}) {}

const Chunk& BrickCells::far_chunk(std::uint64_t key) const {
  const std::size_t number = slots_[slot_of(key)].number_plus_one;
  return number == 0 ? *nothing_ : *chunks_[number - 1];
}

BlockSummary BrickCells::summary(const CellKey& cell, int level) const {
  const Chunk& chunk = chunk_at(cell.above(chunk_level - level));
  if (level >= brick_level) {
    return chunk.block(level, brick_number(cell.below(level - brick_level)));
  }
  const CellMasks& masks = chunk.masks[brick_number(cell.above(brick_level - level))];
  const std::uint64_t cells = cells_around(bit_in_brick(cell.below(level)), level);
  return {(masks.occupied & cells) != 0, (masks.unknown & cells) != 0,
          (~masks.unknown & cells) != 0};
}

CellState BrickCells::state(const CellKey& cell, int level) const {
  const BlockSummary whole = summary(cell, level);
  if (whole.has_occupied) {
    return CellState::occupied;
  }
  return whole.has_unknown ? CellState::unknown : CellState::free;
}

std::size_t BrickCells::bytes() const {
  return (near_.size() + chunks_.capacity()) * sizeof(const Chunk*) + slots_.size() * sizeof(Slot);
}

void BrickCells::reserve(std::size_t chunks) {
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

std::optional<std::size_t> BrickCells::number_of(const CellKey& chunk) const {
  const std::size_t number = slots_[slot_of(packed::chunk(chunk))].number_plus_one;
  return number == 0 ? std::nullopt : std::optional{number - 1};
}

void BrickCells::add(const Chunk& chunk) {
  chunks_.push_back(&chunk);
  slots_[slot_of(chunk.tag)] = {chunk.tag, chunks_.size()};
  take_near_slot(chunk);
  if (2 * chunks_.size() > slots_.size()) {
    rehash(2 * slots_.size());
  }
}

void BrickCells::replace(std::size_t number, const Chunk& chunk) {
  const Chunk*& near = near_[packed::near_number(chunk.tag)];
  if (near == chunks_[number]) {
    near = &chunk;
  }
  chunks_[number] = &chunk;
}

void BrickCells::assign(const std::vector<const Chunk*>& chunks) {
  chunks_ = chunks;
  rehash(slots_.size());
  near_.assign(near_slots, nothing_);
  for (const Chunk* chunk : chunks_) {
    take_near_slot(*chunk);
  }
}

void BrickCells::take_near_slot(const Chunk& chunk) {
  const Chunk*& near = near_[packed::near_number(chunk.tag)];
  if (near == nothing_) {
    near = &chunk;
  }
}

void BrickCells::rehash(std::size_t slots) {
  slots_.assign(slots, Slot{});
  for (std::size_t number = 0; number < chunks_.size(); ++number) {
    const std::uint64_t key = chunks_[number]->tag;
    slots_[slot_of(key)] = {key, number + 1};
  }
}

}  // namespace flyball
