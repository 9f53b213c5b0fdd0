// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Memory that messages give back and take again, so that a running graph asks the system for none.

#include "flyball/runtime/realtime/priority_mutex.h"

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <new>
#include <utility>

namespace flyball {

/// Blocks of 64 bytes to 4 KiB, in sizes that double. What a block once was is kept for the next
/// one of its size; larger ones come from the heap each time. Any thread may use it, and an urgent
/// one does not wait for those between it and a less urgent one.
class MessagePool {
 public:
  MessagePool() = default;
  MessagePool(const MessagePool&) = delete;
  MessagePool& operator=(const MessagePool&) = delete;
  /// @pre All blocks have been given back.
  ~MessagePool() {
    for (Size& size : sizes_) {
      while (Block* block = size.free) {
        size.free = block->next;
        ::operator delete(block);
      }
    }
  }

  [[nodiscard]] void* take(std::size_t bytes) {
    const std::size_t place = place_of(bytes);
    if (place == sizes_.size()) {
      return ::operator new(bytes);
    }
    Size& size = sizes_[place];
    {
      const std::lock_guard lock{size.mutex};
      if (Block* block = size.free) {
        size.free = block->next;
        return block;
      }
    }
    return ::operator new(smallest_bytes << place);
  }
  /// @pre `take(bytes)` returned `memory`.
  void give_back(void* memory, std::size_t bytes) noexcept {
    const std::size_t place = place_of(bytes);
    if (place == sizes_.size()) {
      ::operator delete(memory);
      return;
    }
    Size& size = sizes_[place];
    const std::lock_guard lock{size.mutex};
    size.free = ::new (memory) Block{size.free};
  }

 private:
  static constexpr std::size_t smallest_bytes = 64;
  struct Block {
    Block* next;
  };
  struct Size {
    PriorityMutex mutex{};
    Block* free{};
  };
  /// The number of sizes for a block that is too large for all of them.
  [[nodiscard]] std::size_t place_of(std::size_t bytes) const {
    std::size_t place = 0;
    while (place < sizes_.size() && (smallest_bytes << place) < bytes) {
      ++place;
    }
    return place;
  }
  std::array<Size, 7> sizes_{};
};

/// For `std::allocate_shared`. A message holds its pool: it may outlive the executor that made it.
template <class T>
class PoolAllocator {
 public:
  using value_type = T;
  explicit PoolAllocator(std::shared_ptr<MessagePool> pool) : pool_{std::move(pool)} {}
  template <class U>
  // NOLINTNEXTLINE(google-explicit-constructor): the standard asks allocators for it.
  PoolAllocator(const PoolAllocator<U>& other) : pool_{other.pool()} {}

  [[nodiscard]] T* allocate(std::size_t count) {
    return static_cast<T*>(pool_->take(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t count) noexcept {
    // The message's control block holds this allocator: the pool must survive its last block.
    const std::shared_ptr<MessagePool> pool = pool_;
    pool->give_back(memory, count * sizeof(T));
  }
  [[nodiscard]] const std::shared_ptr<MessagePool>& pool() const { return pool_; }
  template <class U>
  friend bool operator==(const PoolAllocator& a, const PoolAllocator<U>& b) {
    return a.pool() == b.pool();
  }
  template <class U>
  friend bool operator!=(const PoolAllocator& a, const PoolAllocator<U>& b) {
    return !(a == b);
  }

 private:
  std::shared_ptr<MessagePool> pool_;  ///< Owners: the executor, and each message of the pool.
};

/// A message that holds `value`; without a pool, from the heap.
template <class T>
[[nodiscard]] std::shared_ptr<const T> make_message(const std::shared_ptr<MessagePool>& pool,
                                                    T value) {
  return pool ? std::allocate_shared<T>(PoolAllocator<T>{pool}, std::move(value))
              : std::make_shared<T>(std::move(value));
}

}  // namespace flyball
