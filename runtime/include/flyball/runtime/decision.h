// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a decision sets, and why.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace flyball {

/// What a policy went by, in short: a closed list, because libraries, scripts and records use it.
/// Who finds no word for his rule takes the nearest.
enum class Reason : std::uint8_t {
  fixed,     ///< A setting that was given, whatever is observed.
  density,   ///< Obstacles: how dense or near they are, or which gaps they leave.
  deadline,  ///< Something has to be done in time.
  energy,    ///< The least energy.
  load,      ///< How busy the computer is.
  fallback   ///< The governor decided instead of the policy.
};

[[nodiscard]] std::string_view to_string(Reason reason);

/// A value for any subset of knobs. Fixed capacity: deciding allocates nothing.
class Decision {
 public:
  struct Wish {
    std::string_view knob;  ///< Outlives the decision: a literal, or owned by the policy.
    double value{};
  };
  static constexpr std::size_t capacity = 24;

  Reason reason{Reason::fixed};

  /// Past `capacity` wishes the rest is dropped and `overflowed()` says so.
  void set(std::string_view knob, double value) noexcept {
    if (size_ < capacity) {
      wishes_[size_++] = {knob, value};
    } else {
      overflowed_ = true;
    }
  }
  [[nodiscard]] const Wish* begin() const noexcept { return wishes_.data(); }
  [[nodiscard]] const Wish* end() const noexcept { return wishes_.data() + size_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool overflowed() const noexcept { return overflowed_; }

 private:
  std::array<Wish, capacity> wishes_{};
  std::size_t size_{};
  bool overflowed_{};
};

}  // namespace flyball
