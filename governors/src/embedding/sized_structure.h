// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Structures of governor.h, whose callers may have an older or a newer header.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace flyball {

/// The size that a caller wrote in front of his structure. @pre `given` is not null.
template <class T>
[[nodiscard]] std::uint32_t size_of_given(const T* given) noexcept {
  std::uint32_t size = 0;
  std::memcpy(&size, given, sizeof size);
  return size;
}

/// What the caller knows of a structure; the rest is zero.
/// @pre `given` is as long as it says, and long enough for what must not be absent.
template <class T>
[[nodiscard]] T read_sized(const T* given) noexcept {
  static_assert(std::is_trivially_copyable_v<T>, "bytes are copied");
  T all{};
  std::memcpy(&all, given, std::min<std::size_t>(size_of_given(given), sizeof all));
  return all;
}

/// Writes what the caller knows of a structure; its size stays as he gave it.
template <class T>
void write_sized(T* given, T all) noexcept {
  static_assert(std::is_trivially_copyable_v<T>, "bytes are copied");
  all.struct_size = size_of_given(given);
  std::memcpy(given, &all, std::min<std::size_t>(all.struct_size, sizeof all));
}

}  // namespace flyball
