// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which settings of map and clock take the least energy over the next some tens of metres, for
/// whoever knows how long their jobs will take there.

#include "flyball/governors/clock_search.h"
#include "flyball/governors/foresight.h"
#include "flyball/governors/surroundings.h"

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
  /// Mean length of path from obstacle to obstacle. Chosen: in RoboRun's congestion it is 20 m, in
  /// a forest less.
  double spacing_m{10.0};
  double half_width_m{5.0};  ///< Half the width of such an obstacle: of a room, or of one of
                             ///< RoboRun's blocks with the space beside it.
};

/// What limits the choice at a place on the way.
struct PlaceLimits {
  Surroundings around{};
  double coarsest_m{};     ///< The largest cells with which the path ahead is passable.
  double least_range_m{};  ///< Of the map.
  double most_response_s{1e9};
  bool needs_top_clock{};  ///< Something is computed there that the price does not count.
};

/// Dynamic programming over arc length s, speed v and setting c:
///
///     V(s, v, c) = min over v', c' of E(s, (v + v') / 2, c) + switching(c, c') + V(s + ds, v', c')
///     E = ds (P_rotor(v) + P_computer(c)) / v * l
///
/// v <= v_c(s), eq. 2 for the true duration of a frame at s; v' within braking and acceleration of
/// v; c no coarser than what is passable at s. l is the length of the path over that of the
/// straight line: an obstacle of half width w that comes into view s ahead makes the path longer by
/// sqrt(s^2 + w^2) - s, and by the cell that its border fills,
///
///     l = 1 + (cell + sqrt(s^2 + w^2) - s) / spacing,  s = min(range - cell, visibility) - v delta
///
/// Nothing allocates after construction.
class HorizonSearch {
 public:
  /// @param points  The settings that are compared, by ascending cells. @pre Not empty.
  /// @param search  Gives the power of rotors and computer.
  HorizonSearch(const HorizonSettings& settings,
                const ClockSearch& search,
                std::vector<MapSetting> points);

  /// The settings whose durations a `Foresight` must tell, in this order.
  [[nodiscard]] const std::vector<MapSetting>& points() const { return points_; }
  /// @param truth   Its places are ascending, the first one here.
  /// @param limits  At each of these places.
  /// @param speed_m_s  Now.
  /// @return        The setting for now, with energy per metre over the whole horizon; empty where
  ///                no setting leads to the end.
  /// @pre Search and settings are those of the construction; two places at least.
  [[nodiscard]] std::optional<EnergyEstimate> choose(const ClockSearch& search,
                                                     const Foresight& truth,
                                                     const std::vector<PlaceLimits>& limits,
                                                     double speed_m_s);
  /// What the last `choose` expected of each setting, if it is the first one; infinite joules where
  /// it is not allowed.
  [[nodiscard]] const std::vector<EnergyEstimate>& weighed() const { return estimates_; }

 private:
  /// A stretch of path on which nothing changes but speed.
  struct Stretch {
    double length_m{};
    const PlaceLimits* limits{};
    const double* frame_s{};  ///< By point.
  };
  [[nodiscard]] double bounded_response_s(double frame_s) const;
  [[nodiscard]] double path_over_line(double resolution_m, double shows_m) const;
  [[nodiscard]] std::size_t fastest(std::size_t point, const Stretch& here) const;
  [[nodiscard]] bool is_allowed(std::size_t point, const Stretch& here) const;
  [[nodiscard]] double speed(std::size_t index) const;
  /// @param most  The fastest that it begins with.
  void price_edges(std::size_t point, const Stretch& here, std::size_t most);
  [[nodiscard]] double edge_j(std::size_t point, const Stretch& here, std::size_t speeds) const;
  [[nodiscard]] double onward_j(std::size_t point, const Stretch& here, std::size_t from) const;
  void end_at(const Stretch& last);
  void switch_where_it_pays();
  void note_computer(const ClockSearch& search, const Stretch& here);
  void go_back_over(const ClockSearch& search, const Stretch& here);
  void weigh_first(const ClockSearch& search, const Stretch& here, double speed_m_s);
  [[nodiscard]] std::optional<EnergyEstimate> best(double within) const;
  double& rest_j(std::size_t level, std::size_t speed) { return rest_j_[level * speeds_ + speed]; }

  HorizonSettings settings_;
  ClockSearchSettings price_;
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
