// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// GCC's shuffle of vectors, which clang lacks, lane by lane: the kernels' loops use it, and are
/// here only because a target links them.

#include <cstddef>

/// Lanes of `first` and then of `second`, as `places` says.
template <class Floats, class Ints>
// NOLINTNEXTLINE: the name is GCC's
inline Floats __builtin_shuffle(const Floats& first, const Floats& second, const Ints& places) {
  constexpr std::size_t lanes = sizeof(Floats) / sizeof(first[0]);
  Floats shuffled{};
  for (std::size_t i = 0; i < lanes; ++i) {
    const auto from = static_cast<std::size_t>(places[i]) % (2 * lanes);
    shuffled[i] = from < lanes ? first[from] : second[from - lanes];
  }
  return shuffled;
}

template <class Floats, class Ints>
// NOLINTNEXTLINE: the name is GCC's
inline Floats __builtin_shuffle(const Floats& from, const Ints& places) {
  return __builtin_shuffle(from, from, places);
}
