// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A broken precondition ends the program with the values that broke it, in every build type.

#include <cstdio>
#include <cstdlib>

/// `FLYBALL_ASSERT(a < b, "a=%g b=%g", a, b)`
// NOLINTBEGIN(cppcoreguidelines-pro-type-vararg): printf needs no allocation while the program dies
#define FLYBALL_ASSERT(condition, ...)                                                          \
  ((condition)                                                                                  \
       ? static_cast<void>(0)                                                                   \
       : (std::fprintf(stderr, "flyball: %s:%d: broken: %s: ", __FILE__, __LINE__, #condition), \
          std::fprintf(stderr, __VA_ARGS__), std::fputc('\n', stderr), std::abort()))
// NOLINTEND(cppcoreguidelines-pro-type-vararg)
