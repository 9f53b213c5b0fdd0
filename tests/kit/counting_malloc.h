// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Counts what the present thread allocates, shared libraries included. A library that brings a C++
/// library of its own does not call the program's operator new, but it calls the program's malloc.
/// Include it in exactly one file of a program. A sanitizer needs malloc for itself, and
/// libflyball_governor has no C++ library of its own there: then operator new is counted.

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#include "counting_new.h"
#else

#include <cstddef>

namespace flyball {

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): malloc has no other state
inline thread_local std::size_t allocations_of_thread = 0;
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

[[nodiscard]] inline std::size_t allocation_count() {
  return allocations_of_thread;
}

}  // namespace flyball

// NOLINTBEGIN(cppcoreguidelines-no-malloc, misc-definitions-in-headers): see above
extern "C" {
void* __libc_malloc(std::size_t size);  // NOLINT(bugprone-reserved-identifier): glibc's own.

void* malloc(std::size_t size) {
  ++flyball::allocations_of_thread;
  return __libc_malloc(size);
}
}
// NOLINTEND(cppcoreguidelines-no-malloc, misc-definitions-in-headers)

#endif
