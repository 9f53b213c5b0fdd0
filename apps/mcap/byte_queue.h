// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Rows on their way from the thread that has them to the one that writes them.

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

namespace flyball {

/// What stands before a row's bytes in the queue.
struct RowHead {
  std::int64_t at_ns{};
  std::uint32_t bytes{};
  std::uint32_t sequence{};
  std::uint16_t channel{};
  bool is_later{};  ///< Its bytes are still to be made.
};

/// A ring of bytes between one thread that pushes and one that pops. Neither waits for the other,
/// and nothing is allocated after the construction.
class ByteQueue {
 public:
  /// @pre `bytes` is a power of two.
  explicit ByteQueue(std::size_t bytes) : size_{bytes}, ring_{new char[bytes]()} {}

  /// False, and nothing has changed, when there is no room.
  [[nodiscard]] bool push(const RowHead& head, std::string_view row) {
    const std::uint64_t at = pushed_.load(std::memory_order_relaxed);
    if (size_ - (at - popped_.load(std::memory_order_acquire)) < sizeof head + row.size()) {
      return false;
    }
    put(at, &head, sizeof head);
    if (!row.empty()) {  // A row that is still to be made has no bytes, and no place either.
      put(at + sizeof head, row.data(), row.size());
    }
    pushed_.store(at + sizeof head + row.size(), std::memory_order_release);
    return true;
  }
  /// False, and nothing has changed, when it is empty.
  [[nodiscard]] bool pop(RowHead& head, std::string& row) {
    const std::uint64_t at = popped_.load(std::memory_order_relaxed);
    if (pushed_.load(std::memory_order_acquire) == at) {
      return false;
    }
    take(at, &head, sizeof head);
    row.resize(head.bytes);
    take(at + sizeof head, row.data(), row.size());
    popped_.store(at + sizeof head + row.size(), std::memory_order_release);
    return true;
  }
  [[nodiscard]] bool is_half_full() const {
    return pushed_.load(std::memory_order_relaxed) - popped_.load(std::memory_order_relaxed) >
           size_ / 2;
  }
  /// Whether such a row fits when the queue is empty.
  [[nodiscard]] bool could_hold(std::size_t row_bytes) const {
    return row_bytes <= size_ - sizeof(RowHead);
  }

 private:
  static_assert(std::is_trivially_copyable_v<RowHead>);
  void put(std::uint64_t at, const void* from, std::size_t bytes) {
    const std::size_t place = at & (size_ - 1);
    const std::size_t first = std::min(bytes, size_ - place);
    std::memcpy(ring_.get() + place, from, first);
    std::memcpy(ring_.get(), static_cast<const char*>(from) + first, bytes - first);
  }
  void take(std::uint64_t at, void* to, std::size_t bytes) const {
    const std::size_t place = at & (size_ - 1);
    const std::size_t first = std::min(bytes, size_ - place);
    std::memcpy(to, ring_.get() + place, first);
    std::memcpy(static_cast<char*>(to) + first, ring_.get(), bytes - first);
  }

  std::size_t size_;
  std::unique_ptr<char[]> ring_;  // NOLINT(modernize-avoid-c-arrays): the size is the caller's.
  std::atomic<std::uint64_t> pushed_{};  ///< Bytes since the start.
  std::atomic<std::uint64_t> popped_{};
};

}  // namespace flyball
