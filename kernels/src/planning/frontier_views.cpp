// SPDX-License-Identifier: BSD-3-Clause
#include "planning/frontier_views.h"

#include "planning/side_by_side.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace flyball {
namespace {

// Chosen by hand.
constexpr double cube_m = 1.2;             // Frontier cells within a cube count as one frontier.
constexpr double same_place_m = 0.4;       // A view this near to one that was taken, ...
constexpr double same_heading_rad = 0.35;  // ... with about its heading, would show the same.
constexpr double given_up_m = 0.5;  // Views this near to a place that was given up are left out.
// A view also takes time for turning, mapping and the next decision. Together that is as long as a
// path of this length at indoor speed.
constexpr double fixed_path_m = 3.0;
constexpr std::size_t looked_at_together = 12;

struct Gathered {
  double faces{};
  Vec3 sum_W{Vec3::Zero()};
  std::vector<GridCell> cells{};
};

double unknown_faces(const StateGrid& grid, const GridCell& cell, const Aabb& volume_W) {
  double faces = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const int step : {-1, 1}) {
      GridCell next = cell;
      next[axis] += step;
      const bool is_inside = grid.contains(next) && volume_W.contains(grid.centre(next));
      faces += is_inside && grid.at(next) == CellState::unknown ? 1.0 : 0.0;
    }
  }
  return faces;
}

GridCell nearest_to(const Vec3& p_W, const StateGrid& grid, const std::vector<GridCell>& cells) {
  return *std::min_element(cells.begin(), cells.end(), [&](const auto& a, const auto& b) {
    return (grid.centre(a) - p_W).squaredNorm() < (grid.centre(b) - p_W).squaredNorm();
  });
}

class Search {
 public:
  Search(const ExploreRequest& request, const StateGrid& grid, const StandingPlaces& places)
      : request_{request}, grid_{grid}, places_{places}, pyramid_{request.field} {}

  /// From two of the places that see the frontier: the first one on the way, and the one nearest to
  /// the frontier. The first sees it past the edge of a door, the nearest also what is behind it.
  /// @param ray_cells  Those crossed are added.
  [[nodiscard]] std::vector<FrontierView> views_of(const Frontier& frontier,
                                                   double& ray_cells) const {
    const Vec3 target_W = grid_.centre(frontier.cell);
    std::vector<FrontierView> views;
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const Place& place : places_.thinned()) {
      const Vec3 here_W = grid_.centre(place.cell);
      const Vec3 to = target_W - here_W;
      const Viewpoint view{here_W, yaw_of(to)};
      const Vec3 camera_W = pyramid_.apex_W(view);
      if (to.norm() >= nearest_m || !is_in_view(target_W - camera_W)) {
        continue;
      }
      if (!is_spent(request_, view) && grid_.sees(camera_W, frontier.cell, ray_cells)) {
        if (views.size() == 2) {
          views.pop_back();
        }
        views.push_back({view, place.path_m, 0.0});
        nearest_m = to.norm();
      }
    }
    return views;
  }

 private:
  // The middle of the frontier and some space behind it must lie in the field of view. A frontier
  // nearer than half a metre does not count, because its cells lie in too many directions.
  [[nodiscard]] bool is_in_view(const Vec3& to) const {
    constexpr double behind_m = 1.0;
    const double across_m = to.head<2>().norm();
    return across_m > 0.5 && pyramid_.to_edge_m(across_m, to.z()) > 0.0 &&
           to.norm() < request_.field.range_m - behind_m;
  }

  const ExploreRequest& request_;
  const StateGrid& grid_;
  const StandingPlaces& places_;
  Pyramid pyramid_;
};

double worth(double seen, double path_m) {
  return seen / (path_m + fixed_path_m);
}

struct Candidate {
  FrontierView view{};
  double promise{};  ///< Unknown faces for each metre.
};

/// Views of all frontiers, in order of what they promise.
std::vector<Candidate> candidates_of(const ExploreRequest& request,
                                     const StandingPlaces& places,
                                     double& ray_cells) {
  const Search search{request, places.grid(), places};
  const std::vector<Frontier> frontiers = find_frontiers(places.grid(), request.volume_W);
  std::vector<std::vector<FrontierView>> views(frontiers.size());
  std::vector<double> crossed(frontiers.size(), 0.0);
  for_each_index(frontiers.size(), request.settings.threads,
                 [&](std::size_t i) { views[i] = search.views_of(frontiers[i], crossed[i]); });
  ray_cells += std::accumulate(crossed.begin(), crossed.end(), 0.0);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < frontiers.size(); ++i) {
    for (const FrontierView& view : views[i]) {
      candidates.push_back({view, worth(frontiers[i].faces, view.path_m)});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.promise > b.promise; });
  return candidates;
}

std::vector<double> gains_of(const std::vector<Candidate>& candidates,
                             std::size_t begin,
                             std::size_t end,
                             ViewGain& gain) {
  std::vector<Viewpoint> views;
  for (std::size_t i = begin; i < end; ++i) {
    views.push_back(candidates[i].view.view);
  }
  return gain.gains_m3(views);
}

}  // namespace

std::vector<Frontier> find_frontiers(const StateGrid& grid, const Aabb& volume_W) {
  std::map<GridCell, Gathered> cubes;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const GridCell cell = grid.cell_at(i);
    const Vec3 p_W = grid.centre(cell);
    if (grid.at(cell) != CellState::free || !volume_W.contains(p_W)) {
      continue;
    }
    if (const double faces = unknown_faces(grid, cell, volume_W); faces > 0.0) {
      Gathered& cube = cubes[grid_cell_of(p_W, cube_m)];
      cube.faces += faces;
      cube.sum_W += p_W;
      cube.cells.push_back(cell);
    }
  }
  std::vector<Frontier> frontiers;
  for (const auto& [key, cube] : cubes) {
    const Vec3 middle_W = cube.sum_W / static_cast<double>(cube.cells.size());
    frontiers.push_back({nearest_to(middle_W, grid, cube.cells), cube.faces});
  }
  return frontiers;
}

bool is_spent(const ExploreRequest& request, const Viewpoint& view) {
  const auto is_same = [&](const Viewpoint& old) {
    return (old.p_W - view.p_W).norm() < same_place_m &&
           std::abs(wrap_angle(old.yaw_rad - view.yaw_rad)) < same_heading_rad;
  };
  const auto is_near = [&](const Vec3& p_W) { return (p_W - view.p_W).norm() < given_up_m; };
  return std::any_of(request.taken.begin(), request.taken.end(), is_same) ||
         std::any_of(request.unreachable_W.begin(), request.unreachable_W.end(), is_near);
}

std::optional<FrontierView> best_frontier_view(const ExploreRequest& request,
                                               const StandingPlaces& places,
                                               ViewGain& gain,
                                               const WantedGain& wanted,
                                               double& ray_cells) {
  std::vector<Candidate> candidates = candidates_of(request, places, ray_cells);
  std::optional<FrontierView> best;
  for (std::size_t begin = 0; begin < candidates.size(); begin += looked_at_together) {
    if (best && best->gain_m3 >= wanted.enough_m3) {
      break;
    }
    const std::size_t end = std::min(begin + looked_at_together, candidates.size());
    const std::vector<double> gains_m3 = gains_of(candidates, begin, end, gain);
    for (std::size_t i = begin; i < end; ++i) {
      FrontierView& view = candidates[i].view;
      view.gain_m3 = gains_m3[i - begin];
      if (view.gain_m3 >= wanted.least_m3 &&
          (!best || worth(view.gain_m3, view.path_m) > worth(best->gain_m3, best->path_m))) {
        best = view;
      }
    }
  }
  return best;
}

}  // namespace flyball
