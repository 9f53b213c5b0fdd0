// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A structure of governor.h as an older caller has it: a shorter block of memory, so that the
/// address sanitizer sees whoever reads or writes behind it.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace flyball::kit {

template <class T>
class SizedMemory {
 public:
  /// @pre `size <= sizeof(T)`.
  SizedMemory(T value, std::size_t size) : block_{std::malloc(size)} {
    value.struct_size = static_cast<std::uint32_t>(size);
    std::memcpy(block_, &value, size);
  }
  ~SizedMemory() { std::free(block_); }
  SizedMemory(const SizedMemory&) = delete;
  SizedMemory& operator=(const SizedMemory&) = delete;
  /// Only what the caller knows of it may be looked at.
  [[nodiscard]] T* get() const { return static_cast<T*>(block_); }

 private:
  void* block_;
};

}  // namespace flyball::kit
