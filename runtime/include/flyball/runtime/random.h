// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Random streams named by (seed, purpose): adding a draw in one place changes no other stream.
/// The standard library's distributions differ between implementations, so they are not used.

#include <cmath>
#include <cstdint>
#include <string_view>

namespace flyball {

/// SplitMix64 (Steele, Lea, Flood 2014, doi:10.1145/2660193.2660195).
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view purpose, std::uint64_t index = 0)
      : state_{mix(seed) ^ mix(hash(purpose)) ^ mix(index + 0x51ed2701)} {}

  [[nodiscard]] std::uint64_t next() {
    state_ += step;
    return mix(state_);
  }
  /// Draw n from now on is `mix(state() + n * step)`, n = 1, 2, ...: whoever makes many can make
  /// them side by side.
  [[nodiscard]] std::uint64_t state() const { return state_; }
  static constexpr std::uint64_t step = 0x9e3779b97f4a7c15ULL;
  static constexpr std::uint64_t first_factor = 0xbf58476d1ce4e5b9ULL;
  static constexpr std::uint64_t second_factor = 0x94d049bb133111ebULL;
  [[nodiscard]] static std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * first_factor;
    z = (z ^ (z >> 27U)) * second_factor;
    return z ^ (z >> 31U);
  }
  /// In [0, 1).
  [[nodiscard]] double uniform() { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }
  [[nodiscard]] double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Standard normal, Box-Muller (one of the pair is thrown away: streams stay aligned).
  [[nodiscard]] double normal() {
    const double u = 1.0 - uniform();
    const double v = uniform();
    constexpr double two_pi = 6.283185307179586;
    return std::sqrt(-2.0 * std::log(u)) * std::cos(two_pi * v);
  }

 private:
  static std::uint64_t hash(std::string_view text) {  // FNV-1a
    std::uint64_t h = 0xcbf29ce484222325ULL;
    for (const char c : text) {
      h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    }
    return h;
  }
  std::uint64_t state_;
};

}  // namespace flyball
