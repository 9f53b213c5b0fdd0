// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Exploration: what is known of a volume in, the next place to look from out.

#include "flyball/runtime/kernel.h"
#include "flyball/runtime/occupancy.h"
#include "flyball/runtime/work.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace flyball {

/// Where a vehicle's body is, and its heading.
struct Viewpoint {
  Vec3 p_W{Vec3::Zero()};
  double yaw_rad{};
};

/// What a camera sees: a pyramid, cut at a distance; and how the camera is mounted on the body.
struct ViewField {
  double horizontal_rad{1.5707963267948966};
  double vertical_rad{1.0};
  double range_m{6.0};
  double pitch_down_rad{};  ///< Of the pyramid's axis, from level.
  double forward_m{};       ///< Of the camera, from the body's centre.
  double up_m{};
};

struct ExploreSettings {
  double gain_range_m{6.0};       ///< How far a view counts (MAVBench).
  double extension_m{4.0};        ///< Longest edge (MAVBench).
  int iterations{15};             ///< Nodes of a tree until a policy sets it (MAVBench), ...
  int most_iterations{80};        ///< ... as many as this while none of them has a gain.
  double discount_1_m{0.5};       ///< lambda of Bircher et al. 2016, its code's default.
  double coverage_percent{85.0};  ///< Of the reachable volume, to be mapped (MAVBench).
  int threads{1};                 ///< So many look at views at once until a policy sets it.
};

struct ExploreRequest {
  Viewpoint from{};
  Aabb volume_W{};  ///< To be explored.
  Aabb bounds_W{};  ///< The body's centre stays inside.
  Cylinder body{};  ///< With its tracking tube.
  ViewField field{};
  ExploreSettings settings{};
  std::vector<Viewpoint> taken{};     ///< Views that were had: what they did not show stays hidden.
  std::vector<Vec3> unreachable_W{};  ///< Places to which no path was found.
  double max_slope_rad{0.35};         ///< Of each edge; about 20 degrees.
  std::uint64_t seed{};               ///< Of this one request.
};

struct ExploreStep {
  std::optional<Viewpoint> next{};  ///< Empty: nothing more can be seen from anywhere.
  double gain_m3{};                 ///< Unknown space that the path there, or the view, will show.
  bool is_far{};                    ///< Not over a straight edge through known-free space.
  Work work{};  ///< `iterations`, `cells` (looked at), `ray_cells` (crossed), `collision_queries`.
};

class Explorer : public Kernel {
 public:
  static constexpr int most_threads = 16;

  /// How much one step may cost, and how many cores may share it: `ExploreSettings::iterations` and
  /// `threads`.
  [[nodiscard]] std::vector<KnobSpec> knobs() const override {
    KnobSpec threads{"explore.threads",
                     "threads",
                     "explore",
                     {},
                     1.0,
                     most_threads,
                     1.0,
                     "so many look for the next view at once"};
    for (int n = 1; n <= most_threads; ++n) {
      threads.legal.push_back(n);
    }
    return {{"explore.iterations",
             "nodes",
             "explore",
             {},
             1.0,
             10000.0,
             15.0,
             "nodes of the tree in which the next view is looked for"},
            threads};
  }
  /// May remember earlier steps of the same mission. Same requests and maps, same steps. From a
  /// place, or in a volume, that is not finite nothing can be seen.
  [[nodiscard]] virtual ExploreStep explore(const ExploreRequest& request,
                                            const OccupancyView& map) = 0;
};

}  // namespace flyball
