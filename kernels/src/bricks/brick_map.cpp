// SPDX-License-Identifier: BSD-3-Clause
#include "brick_map.h"

#include "flyball/runtime/assert.h"

namespace flyball {

BrickMap::BrickMap(double finest_m, Simd simd) : cells_{finest_m, simd} {}

BrickMap BrickMap::of_states(double finest_m) {
  BrickMap map{finest_m};
  map.keeps_log_odds_ = false;
  return map;
}

std::shared_ptr<const BrickCells> BrickMap::revision() {
  auto revision = revisions_->hand_on(cells_, is_changed_);
  is_changed_ = false;
  return revision;
}

void BrickMap::reserve(std::size_t chunks) {
  while (spare_.size() < chunks) {
    spare_.push_back(make_spare());
  }
  cells_.reserve(chunks);
  revisions_->chunks.reserve(cells_.chunks().size() + chunks);
  bricks_.reserve(cells_.chunks().size() + chunks);
}

void BrickMap::apply(const std::vector<BrickMasks>& changes) {
  begin_change();
  Chunk* chunk = nullptr;
  for (const BrickMasks& change : changes) {
    const CellKey key = change.brick.above(chunk_level - brick_level);
    if (chunk == nullptr || !(chunk->key == key)) {
      chunk = &at(key);
    }
    const std::size_t brick = brick_number(change.brick);
    chunk->set_masks(brick,
                     cells_.loops().update_brick(chunk->bricks[brick], change.free, change.hit));
  }
}

void BrickMap::fill(const CellKey& brick, const Brick& cells) {
  begin_change();
  Chunk& chunk = at(brick.above(chunk_level - brick_level));
  const std::size_t number = brick_number(brick);
  chunk.bricks[number] = cells;
  CellMasks masks{0, 0};
  for (unsigned cell = 0; cell < 64; ++cell) {
    const std::int8_t value = cells.cells[cell];
    masks.occupied |= static_cast<std::uint64_t>(log_odds::is_occupied(value)) << cell;
    masks.unknown |= static_cast<std::uint64_t>(value == log_odds::unknown) << cell;
  }
  chunk.set_masks(number, masks);
}

void BrickMap::show(const std::vector<BrickStates>& bricks) {
  begin_change();
  Chunk* chunk = nullptr;
  for (const BrickStates& shown : bricks) {
    const CellKey key = shown.brick.above(chunk_level - brick_level);
    if (chunk == nullptr || !(chunk->key == key)) {
      chunk = &at(key);
    }
    chunk->set_masks(brick_number(shown.brick), shown.states);
  }
}

bool BrickMap::is_beyond(const CellKey& chunk, const Vec3& p_W, double radius_m) const {
  const Aabb cube = lattice().cube(chunk, chunk_level);
  const Vec3 nearest = cube.nearest(p_W);
  return (p_W - nearest).squaredNorm() > radius_m * radius_m;
}

void BrickMap::forget_occupied(const Vec3& p_W, double radius_m) {
  FLYBALL_ASSERT(keeps_log_odds_, "radius_m=%g", radius_m);
  begin_change();
  for (const Chunk* chunk : std::vector<const Chunk*>{cells_.chunks()}) {
    if (chunk->block(chunk_level, 0).has_occupied && !is_beyond(chunk->key, p_W, radius_m)) {
      at(chunk->key).forget_occupied();
    }
  }
}

std::size_t BrickMap::drop_beyond(const Vec3& p_W,
                                  double radius_m,
                                  const std::function<void(const Chunk&)>& show) {
  begin_change();
  auto& chunks = revisions_->chunks;
  std::vector<const Chunk*> kept;  // In their order, which decides in which order cells are shown.
  for (std::size_t number = 0; number < chunks.size(); ++number) {
    if (is_beyond(chunks[number]->key, p_W, radius_m)) {
      show(*chunks[number]);
      drop(number);
    } else {
      std::swap(chunks[kept.size()], chunks[number]);
      std::swap(bricks_[kept.size()], bricks_[number]);
      kept.push_back(chunks[kept.size()].get());
    }
  }
  const std::size_t dropped = chunks.size() - kept.size();
  if (dropped > 0) {
    chunks.resize(kept.size());
    bricks_.resize(kept.size());
    cells_.assign(kept);
  }
  return dropped;
}

std::size_t BrickMap::bytes() const {
  const std::size_t whole_chunk = sizeof(Chunk) + (keeps_log_odds_ ? sizeof(Chunk::Bricks) : 0);
  return (cells_.chunks().size() + spare_.size()) * whole_chunk + cells_.bytes() +
         revisions_->bytes();
}

BrickMap::Spare BrickMap::make_spare() const {
  if (!keeps_log_odds_) {
    return {nullptr, std::make_unique<Chunk>(CellKey{})};
  }
  auto bricks = std::make_unique<Chunk::Bricks>();
  clear(*bricks);
  auto chunk = std::make_unique<Chunk>(CellKey{}, bricks.get());
  return {std::move(bricks), std::move(chunk)};
}

void BrickMap::begin_change() {
  revisions_->collect();
  newest_read_ = revisions_->newest_read();
  is_changed_ = true;
}

Chunk& BrickMap::at(const CellKey& chunk) {
  const auto number = cells_.number_of(chunk);
  if (!number) {
    return make(chunk);
  }
  auto& present = revisions_->chunks[*number];
  if (present->first_revision <= newest_read_) {
    auto copy = revisions_->copy_of(*present);
    std::swap(present, copy);
    cells_.replace(*number, *present);
    revisions_->retire(std::move(copy));
  }
  return *present;
}

Chunk& BrickMap::make(const CellKey& chunk) {
  if (spare_.empty()) {
    spare_.push_back(make_spare());
  }
  Spare made = std::move(spare_.back());
  spare_.pop_back();
  made.chunk->set_key(chunk);
  made.chunk->first_revision = revisions_->next();
  cells_.add(*made.chunk);
  bricks_.push_back(std::move(made.bricks));
  return *revisions_->chunks.emplace_back(std::move(made.chunk));
}

/// Leaves empty places in the lists.
void BrickMap::drop(std::size_t number) {
  Spare left{std::move(bricks_[number]), std::move(revisions_->chunks[number])};
  if (keeps_log_odds_) {
    clear(*left.bricks);
  }
  if (left.chunk->first_revision <= newest_read_) {
    revisions_->retire(std::move(left.chunk));
    left.chunk = std::make_unique<Chunk>(CellKey{}, left.bricks.get());
  } else {
    *left.chunk = Chunk{CellKey{}, left.bricks.get()};
  }
  spare_.push_back(std::move(left));
}

}  // namespace flyball
