// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Scalars that carry their unit in the type. Construction from double is explicit.

namespace flyball {

template <class Tag>
class Scalar {
 public:
  constexpr Scalar() = default;
  constexpr explicit Scalar(double value) : value_{value} {}
  [[nodiscard]] constexpr double value() const { return value_; }
  friend constexpr bool operator==(Scalar a, Scalar b) { return a.value_ == b.value_; }
  friend constexpr bool operator!=(Scalar a, Scalar b) { return !(a == b); }
  friend constexpr bool operator<(Scalar a, Scalar b) { return a.value_ < b.value_; }
  friend constexpr bool operator>(Scalar a, Scalar b) { return b < a; }
  friend constexpr Scalar operator+(Scalar a, Scalar b) { return Scalar{a.value_ + b.value_}; }
  friend constexpr Scalar operator-(Scalar a, Scalar b) { return Scalar{a.value_ - b.value_}; }
  friend constexpr Scalar operator*(double k, Scalar a) { return Scalar{k * a.value_}; }
  friend constexpr Scalar operator*(Scalar a, double k) { return k * a; }

 private:
  double value_ = 0.0;
};

using Hertz = Scalar<struct HertzTag>;
using Watts = Scalar<struct WattsTag>;

}  // namespace flyball
