// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One battery for rotors and computer: coulomb counter, voltage from state of charge and load.

namespace flyball {

/// Cell model of Chen and Rincon-Mora (2006, doi:10.1109/TEC.2006.874229), scaled from its 850 mAh
/// cell to the pack: series count from the pack, R times .3 * .85 / capacity_Ah (the .3 is fitted
/// to the maker's endurances), C inversely; both C have a floor. Empty at 3.0 V a cell under load.
class Battery {
 public:
  /// @pre `cells >= 1`, `capacity_ah > 0`, 0 < `charge` <= 1.
  Battery(int cells, double capacity_ah, double charge = 1.0);

  /// Draws `power_w` for `dt_s`. Drawing from an empty battery leaves it empty.
  void draw(double power_w, double dt_s);
  [[nodiscard]] double charge() const { return charge_; }  ///< 0..1
  [[nodiscard]] double percent() const { return 100.0 * charge_; }
  [[nodiscard]] double voltage_v() const { return voltage_v_; }
  [[nodiscard]] bool is_empty() const { return empty_; }

 private:
  int cells_;
  double capacity_ah_;
  double charge_;
  double voltage_v_{};
  double transient_short_v_{};  ///< Over R1 C1, per cell.
  double transient_long_v_{};   ///< Over R2 C2, per cell.
  bool empty_{false};
};

}  // namespace flyball
