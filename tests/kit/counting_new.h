// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Counts what the present thread allocates, so that a test can prove that something allocates
/// nothing. It replaces the program's operator new: include it in exactly one file of a program.

#include <cstddef>
#include <cstdlib>
#include <new>

namespace flyball {

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): operator new has no other state
inline thread_local std::size_t allocations_of_thread = 0;
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

[[nodiscard]] inline std::size_t allocation_count() {
  return allocations_of_thread;
}

}  // namespace flyball

// NOLINTBEGIN(cppcoreguidelines-no-malloc, misc-definitions-in-headers): see above
// Not inlined: the compiler would see malloc and free in place of the operators and warn of a mix.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++flyball::allocations_of_thread;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) {
    return memory;
  }
  throw std::bad_alloc{};
}
// std::stable_sort's buffer comes this way and goes back through the operator below.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  ++flyball::allocations_of_thread;
  return std::malloc(size == 0 ? 1 : size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}
// NOLINTEND(cppcoreguidelines-no-malloc, misc-definitions-in-headers)
