// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The companion computer as the governor meets it: what is known of it before it flies, what its
/// meters say, and the operating point that is asked of it.

#include "flyball/runtime/camera_spec.h"
#include "flyball/runtime/guard.h"
#include "flyball/runtime/platform.h"
#include "flyball/runtime/time.h"
#include "flyball/runtime/units.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace flyball {

/// What is known on board of the vehicle that carries the computer.
struct VehicleModel {
  /// Of the body with its tracking tube at a crawl, both sides together. A Matrice 100's (MAVBench)
  /// where nobody says.
  double narrow_width_m{0.71};
  /// From the ground up to the lowest point of the body with its tube, where it cruises; empty: not
  /// known.
  std::optional<double> ground_clearance_m{};
  std::optional<DepthCameraSpec> depth_camera{};            ///< Empty: its noise is not known.
  Duration reaction_time{GuardSettings{}.reaction_time()};  ///< t_b, as its guard counts it.
};

/// Operating points, power and heat of one computer, as its platform file or its maker's data sheet
/// has them. What is left out is not known: a board that is all defaults is one of which nothing
/// is.
struct BoardModel {
  int max_cores{};                        ///< That may run jobs; 0: not known.
  std::vector<Hertz> frequencies{};       ///< Ascending; empty: not known.
  Duration switching_time{};              ///< How long a change of the clock takes.
  std::optional<PowerCost> power{};       ///< Input power of the whole computer.
  std::optional<ThermalModel> thermal{};  ///< Empty: it is not known to get too hot.
  VehicleModel vehicle{};
  std::optional<GpuModel> gpu{};  ///< Empty: there is none, or nothing is known of it.
  double memory_contention{};     ///< See `PlatformModel`; 0: not known.
};

/// What a platform's file says of the board; what work costs in time is left to be learned in
/// flight.
[[nodiscard]] BoardModel board_model_of(const PlatformModel& platform);

/// Those of `wanted` of which the board has none within 2 %: it would run at another clock than
/// whoever asked for them expects. Empty where its clocks are not known.
[[nodiscard]] std::vector<Hertz> clocks_missing_on(const BoardModel& board,
                                                   const std::vector<Hertz>& wanted);

/// Power of parts of the computer; 0 where the board has no meter for that part alone.
struct RailPower {
  Watts cpu{};
  Watts gpu{};
  Watts memory{};
  Watts soc{};  ///< The rest of the chip.
};

/// What a node has taken of the computer's own cores; a GPU and an edge computer do not count. A
/// job counts when it has ended.
struct NodeUse {
  double busy_core_s{};  ///< Core-seconds since the start.
  Duration latency{};    ///< Of the newest job, from release to end.
  double gigacycles{};   ///< Of the newest job, in 10^9, at the clock that it began with.
};

/// One look at every meter.
struct BoardReading {
  OperatingPoint granted{};
  double busy_core_s{};     ///< Core-seconds of work since the start.
  double busiest_core_s{};  ///< The same of the core that worked most.
  std::uint64_t drops{};    ///< Messages and triggers since the start; see `Executor::drops`.
  std::uint64_t deadline_misses{};  ///< Of jobs, since the start.
  Watts computer_power{};
  RailPower rails{};  ///< In `computer_power` too.
  Watts rotor_power{};
  double battery_percent{};
  double temperature_c{};  ///< 0: there is no sensor.
  double trip_c{};         ///< Above it the board takes clocks away; 0: it never does.
};

class Board {
 public:
  Board() = default;
  Board(const Board&) = delete;
  Board& operator=(const Board&) = delete;
  virtual ~Board() = default;

  [[nodiscard]] virtual BoardReading read() const = 0;
  /// Zero for a node that never ran, and where nobody counts.
  [[nodiscard]] virtual NodeUse use_of(int /*node*/) const { return {}; }
  /// What is granted may be less; the next reading tells.
  virtual void request(const OperatingPoint& point) = 0;
  /// Jobs of this node run on the edge computer from the next one on, or on board again. Nothing
  /// happens where there is no such node or no such computer.
  virtual void place(std::string_view /*node*/, bool /*on_edge*/) {}
};

}  // namespace flyball
