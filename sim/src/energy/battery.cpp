// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/sim/battery.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr double empty_cell_v = 3.0;       // Chen & Rincon-Mora's end of discharge
constexpr double reference_ah = 0.85;      // the cell that they measured
constexpr double resistance_factor = 0.3;  // fitted to the maker's endurances of the Matrice 100
// C1 goes negative below .5 % of charge, C2 below 1.1 %: floors at their values at 1.05 and 1.28 %.
constexpr double least_short_f = 50.0;
constexpr double least_long_f = 200.0;

/// Chen & Rincon-Mora 2006, eqs. 2 to 7, for their own cell; s is the state of charge.
struct Cell {
  double open_v;
  double series_ohm;
  double short_ohm;
  double short_f;
  double long_ohm;
  double long_f;
};

Cell cell_at(double s) {
  Cell cell{};
  cell.open_v =
      -1.031 * std::exp(-35.0 * s) + 3.685 + 0.2156 * s - 0.1178 * s * s + 0.3201 * s * s * s;
  cell.series_ohm = 0.1562 * std::exp(-24.37 * s) + 0.07446;
  cell.short_ohm = 0.3208 * std::exp(-29.14 * s) + 0.04669;
  cell.short_f = std::max(least_short_f, -752.9 * std::exp(-13.51 * s) + 703.6);
  cell.long_ohm = 6.603 * std::exp(-155.2 * s) + 0.04984;
  cell.long_f = std::max(least_long_f, -6056.0 * std::exp(-27.12 * s) + 4475.0);
  return cell;
}

}  // namespace

Battery::Battery(int cells, double capacity_ah, double charge)
    : cells_{cells}, capacity_ah_{capacity_ah}, charge_{charge} {
  FLYBALL_ASSERT(cells >= 1, "cells=%d", cells);
  FLYBALL_ASSERT(capacity_ah > 0.0, "capacity_ah=%g", capacity_ah);
  FLYBALL_ASSERT(charge > 0.0 && charge <= 1.0, "charge=%g", charge);
  voltage_v_ = cells_ * cell_at(charge_).open_v;
}

void Battery::draw(double power_w, double dt_s) {
  FLYBALL_ASSERT(dt_s >= 0.0 && power_w >= 0.0, "power_w=%g dt_s=%g", power_w, dt_s);
  if (empty_) {
    return;
  }
  const Cell cell = cell_at(charge_);
  // A larger cell is many small ones side by side: R falls and C grows with the capacity, and the
  // time constants stay.
  const double scale = resistance_factor * reference_ah / capacity_ah_;
  const double series_ohm = scale * cell.series_ohm;
  const double source_v = cell.open_v - transient_short_v_ - transient_long_v_;
  const double cell_w = power_w / cells_;
  // P = i (E - R i): the smaller root. Without one, no current gives this power.
  const double discriminant = source_v * source_v - 4.0 * series_ohm * cell_w;
  if (discriminant < 0.0) {
    empty_ = true;
    return;
  }
  const double current_a = 2.0 * cell_w / (source_v + std::sqrt(discriminant));
  const auto relax = [&](double& transient_v, double ohm, double farad) {
    const double settled_v = current_a * scale * ohm;
    transient_v = settled_v + (transient_v - settled_v) * std::exp(-dt_s / (ohm * farad));
  };
  relax(transient_short_v_, cell.short_ohm, cell.short_f);
  relax(transient_long_v_, cell.long_ohm, cell.long_f);
  charge_ = std::max(0.0, charge_ - current_a * dt_s / (3600.0 * capacity_ah_));
  const double cell_v = source_v - current_a * series_ohm;
  voltage_v_ = cells_ * cell_v;
  empty_ = cell_v < empty_cell_v || charge_ <= 0.0;
}

}  // namespace flyball
