// SPDX-License-Identifier: BSD-3-Clause
#include "brick_revisions.h"

#include <algorithm>

namespace flyball {

std::shared_ptr<const BrickCells> BrickRevisions::hand_on(const BrickCells& now, bool is_changed) {
  if (is_changed || newest_ == nullptr) {
    newest_ = &idle_revision(now);
    newest_->number = ++last_;
  }
  Revision* revision = newest_;
  revision->readers.fetch_add(1, std::memory_order_relaxed);
  // Releases what the reader has read: the map acquires it before it writes there again.
  return {&revision->cells, [keeper = shared_from_this(), revision](const BrickCells*) {
            revision->readers.fetch_sub(1, std::memory_order_release);
          }};
}

/// A revision without readers, with the map's index.
BrickRevisions::Revision& BrickRevisions::idle_revision(const BrickCells& now) {
  const auto is_idle = [](const std::unique_ptr<Revision>& revision) {
    return revision->readers.load(std::memory_order_acquire) == 0;
  };
  const auto idle = std::stable_partition(revisions_.begin(), revisions_.end(),
                                          [&](const auto& revision) { return !is_idle(revision); });
  if (idle == revisions_.end()) {
    return *revisions_.emplace_back(std::make_unique<Revision>(now));
  }
  Revision& reused = **idle;
  reused.cells = now;
  if (revisions_.end() - idle > static_cast<std::ptrdiff_t>(most_idle)) {
    revisions_.erase(idle + most_idle, revisions_.end());
  }
  return reused;
}

BrickRevisions::Number BrickRevisions::newest_read() const {
  Number newest = 0;
  for (const auto& revision : revisions_) {
    if (revision->readers.load(std::memory_order_acquire) > 0) {
      newest = std::max(newest, revision->number);
    }
  }
  return newest;
}

std::unique_ptr<Chunk> BrickRevisions::copy_of(const Chunk& chunk) {
  std::unique_ptr<Chunk> copy;
  if (spare_.empty()) {
    copy = std::make_unique<Chunk>(chunk);
  } else {
    copy = std::move(spare_.back());
    spare_.pop_back();
    *copy = chunk;
  }
  copy->first_revision = next();
  return copy;
}

void BrickRevisions::retire(std::unique_ptr<Chunk> chunk) {
  retired_.push_back({std::move(chunk), last_});
}

bool BrickRevisions::is_read(const Retired& retired) const {
  return std::any_of(revisions_.begin(), revisions_.end(), [&](const auto& revision) {
    return revision->number >= retired.chunk->first_revision &&
           revision->number <= retired.last_shown &&
           revision->readers.load(std::memory_order_acquire) > 0;
  });
}

void BrickRevisions::collect() {
  const auto unread = std::partition(retired_.begin(), retired_.end(),
                                     [this](const Retired& retired) { return is_read(retired); });
  for (auto retired = unread; retired != retired_.end(); ++retired) {
    if (spare_.size() < most_spare) {
      spare_.push_back(std::move(retired->chunk));
    }
  }
  retired_.erase(unread, retired_.end());
}

std::size_t BrickRevisions::bytes() const {
  std::size_t bytes = (retired_.size() + spare_.size()) * sizeof(Chunk);
  for (const auto& revision : revisions_) {
    bytes += revision->cells.bytes();
  }
  return bytes;
}

}  // namespace flyball
