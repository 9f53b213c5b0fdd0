// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which settings of map and clock take the least energy over the next some tens of metres, for
/// whoever knows how long their jobs will take there.

#include "flyball/governors/energy_search.h"
#include "flyball/governors/foresight.h"

#include <optional>
#include <vector>

namespace flyball {

struct HorizonSettings {
  std::size_t places{16};        ///< At most; with steps of 4 m they reach 60 m.
  double speed_step_m_s{0.5};    ///< Of the lattice of speeds.
  double most_speed_m_s{20.0};   ///< The highest speed of the lattice.
  double accelerates_m_s2{3.0};  ///< The path follower's usual acceleration.
  /// A change of resolution costs as much as so long a hover, because the other map starts with one
  /// frame. Chosen.
  double switching_s{0.2};
  double bound_over_true{1.1};  ///< The navigator's bound over the largest latency measured.
};

/// Dynamic programming over arc length s, speed v and setting c:
///
///     V(s, v, c) = min over v', c' of E(s, (v + v') / 2, c) + switching(c, c') + V(s + ds, v', c')
///     E = ds (P_rotor(v) + P_computer(c)) / v * l
///
/// v <= v_c(s), eq. 2 for the true duration of a frame at s; v' within braking and acceleration of
/// v; c no coarser than what is passable at s. l is that of `EnergySearch`. Nothing allocates after
/// construction.
class HorizonSearch {
 public:
  /// @param search  Gives the points, and the power of rotors and computer.
  HorizonSearch(const HorizonSettings& settings, const EnergySearch& search);

  /// The settings whose durations a `Foresight` must tell, in this order.
  [[nodiscard]] const std::vector<MapSetting>& points() const { return points_; }
  /// @param truth   Its places are ascending, the first one here.
  /// @param around  What limits the search at each of these places.
  /// @param speed_m_s  Now.
  /// @return        The setting for now, with energy per metre over the whole horizon; empty where
  /// no
  ///                setting leads to the end.
  /// @pre Search and settings are those of the construction; two places at least.
  [[nodiscard]] std::optional<EnergyEstimate> choose(const EnergySearch& search,
                                                     const Foresight& truth,
                                                     const std::vector<Surroundings>& around,
                                                     double speed_m_s);
  /// What the last `choose` expected of each setting, if it is the first one; infinite joules where
  /// it is not allowed.
  [[nodiscard]] const std::vector<EnergyEstimate>& weighed() const { return estimates_; }

 private:
  /// A stretch of path on which nothing changes but speed.
  struct Stretch {
    double length_m{};
    const Surroundings* around{};
    const double* frame_s{};  ///< By point.
  };
  [[nodiscard]] double response_s(double frame_s) const;
  [[nodiscard]] std::size_t fastest(std::size_t point, const Stretch& here) const;
  [[nodiscard]] bool is_allowed(std::size_t point, const Stretch& here) const;
  [[nodiscard]] double speed(std::size_t index) const;
  /// @param most  The fastest that it begins with.
  void price_edges(std::size_t point, const Stretch& here, std::size_t most);
  [[nodiscard]] double edge_j(std::size_t point, const Stretch& here, std::size_t speeds) const;
  [[nodiscard]] double onward_j(std::size_t point, const Stretch& here, std::size_t from) const;
  void end_at(const Stretch& last);
  void switch_where_it_pays();
  void note_computer(const EnergySearch& search, const Stretch& here);
  void go_back_over(const EnergySearch& search, const Stretch& here);
  void weigh_first(const EnergySearch& search, const Stretch& here, double speed_m_s);
  [[nodiscard]] std::optional<EnergyEstimate> best(double within) const;
  double& rest_j(std::size_t level, std::size_t speed) { return rest_j_[level * speeds_ + speed]; }

  HorizonSettings settings_;
  EnergySearchSettings price_;
  std::vector<MapSetting> points_{};
  std::vector<std::size_t> level_of_{};  ///< Of each point's cells.
  std::size_t levels_{};
  double finest_m_{};
  double top_clock_hz_{};
  std::size_t speeds_{};
  std::vector<double> rotor_w_{};     ///< At half steps of speed, in the decision being made.
  std::vector<double> computer_w_{};  ///< Of each point on the stretch that is looked at.
  std::vector<double> edge_j_{};      ///< Of that stretch with the point that is looked at.
  std::vector<double> rest_j_{};      ///< From the next place to the end, by level and speed.
  std::vector<double> here_j_{};      ///< The same from the place that is looked at.
  std::vector<EnergyEstimate> estimates_{};
};

}  // namespace flyball
