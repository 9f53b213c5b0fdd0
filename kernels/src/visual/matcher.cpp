// SPDX-License-Identifier: BSD-3-Clause
// tested-in: visual_slam
#include "visual/matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

namespace flyball {
namespace {

constexpr int grid_cell_px = 16;
// Lowe 2004's ratio test, and ORB-SLAM's limits on a difference (TH_HIGH 100, TH_LOW 50; Mur-Artal
// et al. 2015) between them.
constexpr int widest_by_place = 70;
constexpr int widest_by_look = 60;
constexpr double ratio_limit = 0.8;
constexpr int octave_slack = 2;
constexpr double twin_px = 4.0;  // Nearer than this it is the same corner in another octave.

struct Best {
  int feature{-1};
  int difference{std::numeric_limits<int>::max()};
  int second{std::numeric_limits<int>::max()};

  [[nodiscard]] bool is_clear(int widest) const {
    return feature >= 0 && difference <= widest && difference < ratio_limit * second;
  }
};

void compare(const Descriptor& wanted,
             const std::vector<Feature>& features,
             const std::vector<std::size_t>& candidates,
             std::vector<int>& differences) {
  differences.clear();
  for (const std::size_t i : candidates) {
    differences.push_back(difference(wanted, features[i].descriptor));
  }
}

/// The most alike of the candidates; the second one must be another corner.
Best choose(const std::vector<Feature>& features,
            const std::vector<std::size_t>& candidates,
            const std::vector<int>& differences) {
  Best best;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (differences[i] < best.difference) {
      best.difference = differences[i];
      best.feature = static_cast<int>(candidates[i]);
    }
  }
  if (best.feature >= 0) {
    const Eigen::Vector2d& at = features[static_cast<std::size_t>(best.feature)].pixel;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if ((features[candidates[i]].pixel - at).norm() > twin_px) {
        best.second = std::min(best.second, differences[i]);
      }
    }
  }
  return best;
}

/// A feature is one landmark at most: the one it resembles most.
std::vector<Match> one_each(std::vector<Match> matches) {
  std::sort(matches.begin(), matches.end(), [](const Match& a, const Match& b) {
    return std::tie(a.feature, a.difference, a.landmark) <
           std::tie(b.feature, b.difference, b.landmark);
  });
  matches.erase(std::unique(matches.begin(), matches.end(),
                            [](const Match& a, const Match& b) { return a.feature == b.feature; }),
                matches.end());
  return matches;
}

bool is_inside(const CameraModel& camera, const Eigen::Vector2d& pixel) {
  return pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() < camera.width_px &&
         pixel.y() < camera.height_px;
}

/// The octave in which a landmark should show: a coarser one when it is nearer than in the first
/// view.
double octave_from(const Landmark& mark, double distance_m) {
  return mark.octave + std::log(mark.distance_m / distance_m) / std::log(octave_scale);
}

/// Where a camera sees the point, if it is before it and in the image.
std::optional<Eigen::Vector2d> pixel_in_view(const CameraModel& camera, const Vec3& p_C) {
  constexpr double nearest_m = 0.1;
  if (p_C.z() < nearest_m) {
    return std::nullopt;
  }
  const Eigen::Vector2d pixel = project(camera, p_C).pixel;
  return is_inside(camera, pixel) ? std::optional{pixel} : std::nullopt;
}

void keep_octave(std::vector<std::size_t>& candidates,
                 const std::vector<Feature>& features,
                 double octave) {
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                  [&](std::size_t i) {
                                    return std::abs(features[i].octave - octave) > octave_slack;
                                  }),
                   candidates.end());
}

}  // namespace

FeatureGrid::FeatureGrid(const std::vector<Feature>& features, const CameraModel& camera)
    : features_{features},
      columns_{camera.width_px / grid_cell_px + 1},
      rows_{camera.height_px / grid_cell_px + 1},
      cells_(static_cast<std::size_t>(columns_ * rows_)) {
  for (std::size_t i = 0; i < features.size(); ++i) {
    if (is_inside(camera, features[i].pixel)) {
      const int column = static_cast<int>(features[i].pixel.x()) / grid_cell_px;
      const int row = static_cast<int>(features[i].pixel.y()) / grid_cell_px;
      cells_[place_of(column, row)].push_back(i);
    }
  }
}

void FeatureGrid::around(const Eigen::Vector2d& pixel,
                         double radius_px,
                         std::vector<std::size_t>& out) const {
  out.clear();
  const auto cell = [](double at, int end) {
    return std::clamp(static_cast<int>(std::floor(at / grid_cell_px)), 0, end - 1);
  };
  for (int row = cell(pixel.y() - radius_px, rows_); row <= cell(pixel.y() + radius_px, rows_);
       ++row) {
    for (int column = cell(pixel.x() - radius_px, columns_);
         column <= cell(pixel.x() + radius_px, columns_); ++column) {
      add_near(cells_[place_of(column, row)], pixel, radius_px, out);
    }
  }
}

void FeatureGrid::add_near(const std::vector<std::size_t>& cell,
                           const Eigen::Vector2d& pixel,
                           double radius_px,
                           std::vector<std::size_t>& out) const {
  for (const std::size_t i : cell) {
    if ((features_[i].pixel - pixel).cwiseAbs().maxCoeff() <= radius_px) {
      out.push_back(i);
    }
  }
}

std::vector<Match> match_by_place(const LandmarkMap& map,
                                  const std::vector<int>& landmarks,
                                  const FeatureGrid& grid,
                                  const LandmarkSearch& view,
                                  Work& work) {
  const Pose X_CW = view.X_WC.inverse();
  const std::vector<Feature>& features = grid.features();
  std::vector<Match> matches;
  std::vector<std::size_t> candidates;
  std::vector<int> differences;
  double compared = 0.0;
  for (const int id : landmarks) {
    const Vec3 p_C = X_CW * map.p_W(id);
    const auto pixel = pixel_in_view(view.camera, p_C);
    if (!pixel) {
      continue;
    }
    if (view.in_view != nullptr) {
      view.in_view->push_back(id);
    }
    grid.around(*pixel, view.radius_px, candidates);
    keep_octave(candidates, features, octave_from(map.landmark(id), p_C.norm()));
    compare(map.landmark(id).descriptor, features, candidates, differences);
    compared += static_cast<double>(candidates.size());
    const Best best = choose(features, candidates, differences);
    if (best.is_clear(widest_by_place)) {
      matches.push_back({static_cast<std::size_t>(best.feature), id, best.difference});
    }
  }
  work.add("matches", compared);
  return one_each(std::move(matches));
}

std::vector<Match> match_by_look(const LandmarkMap& map,
                                 std::size_t keyframe,
                                 const std::vector<Feature>& features,
                                 Work& work) {
  std::vector<int> ids;
  std::vector<Feature> known;
  std::vector<std::size_t> all;
  const Keyframe& frame = map.keyframes()[keyframe];
  for (std::size_t i = 0; i < frame.features.size(); ++i) {
    if (frame.landmarks[i] != no_landmark && !map.is_doubtful(frame.landmarks[i])) {
      all.push_back(ids.size());
      ids.push_back(frame.landmarks[i]);
      known.push_back(frame.features[i]);
    }
  }
  std::vector<Match> matches;
  std::vector<int> differences;
  for (std::size_t i = 0; i < features.size(); ++i) {
    compare(features[i].descriptor, known, all, differences);
    const Best best = choose(known, all, differences);
    if (best.is_clear(widest_by_look)) {
      matches.push_back({i, ids[static_cast<std::size_t>(best.feature)], best.difference});
    }
  }
  work.add("matches", static_cast<double>(features.size()) * static_cast<double>(known.size()));
  // The other way round too: a landmark is one feature at most.
  std::sort(matches.begin(), matches.end(), [](const Match& a, const Match& b) {
    return std::tie(a.landmark, a.difference, a.feature) <
           std::tie(b.landmark, b.difference, b.feature);
  });
  matches.erase(
      std::unique(matches.begin(), matches.end(),
                  [](const Match& a, const Match& b) { return a.landmark == b.landmark; }),
      matches.end());
  return matches;
}

}  // namespace flyball
