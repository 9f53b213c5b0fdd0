// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/future_frames.h"

#include "flyball/flight/navigation/gap_scan.h"
#include "flyball/flight/perception/perception_nodes.h"
#include "flyball/runtime/assert.h"

#include "scenario/kernel_choice.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace flyball {
namespace {

constexpr double step_m = 4.0;
constexpr int steps = 15;                              // 60 m.
constexpr double direction_rad = 0.39269908169872414;  // An eighth of a half turn.
constexpr double half_band_m = 0.3;                    // As the governor loop looks at the map.
constexpr double nearest_m = 20.0;
constexpr double path_width_reach_m = 8.0;  // Farther on the path will often be another one.

template <class Family>
std::unique_ptr<Family> made(const Plugins& plugins, const KernelSettings& kernels) {
  auto kernel = make_kernel<Family>(plugins, kernels);
  FLYBALL_ASSERT(kernel.ok(), "%s", kernel.error().message.c_str());
  return std::move(*kernel);
}

/// Level; any direction where it leads straight up or down.
Vec3 level(const Vec3& direction_W) {
  const Vec3 flat_W{direction_W.x(), direction_W.y(), 0.0};
  return flat_W.norm() > 1e-6 ? Vec3{flat_W.normalized()} : Vec3{Vec3::UnitX()};
}

}  // namespace

FutureFrames::FutureFrames(std::shared_ptr<const Brief> brief,
                           const Plugins& plugins,
                           const World& world,
                           const Platform& computer,
                           std::vector<MapSetting> settings)
    : brief_{std::move(brief)},
      point_cloud_{made<PointCloudBuilder>(plugins, brief_->settings.kernels)},
      computer_{computer},
      settings_{std::move(settings)},
      camera_{world, brief_->settings.camera, brief_->settings.seed},
      mapper_{made<Mapper>(plugins, brief_->settings.kernels)} {}

FutureFrames::Spot FutureFrames::spot(const NavigatorState& navigator, double ahead_m) {
  Vec3 end_W = navigator.position_W;
  double beyond_m = ahead_m;
  if (navigator.has_path()) {
    const Path& path = *navigator.path;
    const double s_m = navigator.s_m + ahead_m;
    if (s_m <= path.length_m()) {
      const Path::Sample here = path.at(s_m);
      return {here.p_W, level(here.tangent_W)};
    }
    end_W = path.at(path.length_m()).p_W;
    beyond_m = s_m - path.length_m();
  }
  const Vec3 to_goal_W = navigator.goal_W - end_W;
  const double left_m = to_goal_W.norm();
  const Vec3 p_W = end_W + (left_m > beyond_m ? beyond_m / left_m : 1.0) * to_goal_W;
  return {p_W, level(to_goal_W)};
}

PlaceAhead FutureFrames::place(const NavigatorState& navigator,
                               const Situation& situation,
                               const Spot& spot,
                               double ahead_m) {
  PlaceAhead place;
  place.ahead_m = ahead_m;
  place.speed_limit_m_s = situation.speed_limit_m_s(spot.p_W);
  GapScan line;
  line.reach_m = 0.0;
  line.half_band_m = half_band_m;
  line.bounds_W = situation.brief.site.bounds_W;
  const Vec3 onward_W = spot.p_W + spot.tangent_W;
  place.opening_m = gaps_ahead(situation.map, spot.p_W, onward_W, line).narrowest_m;
  place.obstacle_m = situation.map.nearest_obstacle_m(spot.p_W, nearest_m, half_band_m);
  const double s_m = navigator.s_m + ahead_m;
  if (navigator.has_path() && s_m < navigator.path->length_m() && ahead_m <= path_width_reach_m) {
    const PathSpan here{navigator.path.get(), s_m, step_m};
    place.opening_m =
        std::min(place.opening_m, narrowest_on(situation.map, here, half_band_m).width_m);
  }
  return place;
}

/// The cloud that the map takes next was captured at most one frame before it begins.
double FutureFrames::duration_s(const Work& points, const Work& map, Hertz clock) const {
  const KernelSettings& kernels = brief_->settings.kernels;
  const double map_s = to_seconds(computer_.job_time(mapper_cost(kernels), map, clock));
  const double frame_s = 1.0 / brief_->settings.camera.rate_hz;
  return to_seconds(computer_.job_time(kernels.point_cloud, points, clock)) + map_s +
         (map_s > frame_s ? frame_s : 0.0);
}

std::vector<double> FutureFrames::taken_at(const Spot& spot) {
  Pose X_WB = Pose::Identity();
  X_WB.translation() = spot.p_W;
  const double yaw_rad = yaw_of(spot.tangent_W);
  X_WB.linear() = Eigen::AngleAxisd{yaw_rad, Vec3::UnitZ()}.toRotationMatrix();
  const Pose X_WC = camera_pose(X_WB, brief_->settings.camera);
  const DepthFrame frame = camera_.frame(X_WC, MissionTime{}, durations_s_.size());
  std::vector<double> durations_s(settings_.size());
  std::map<std::pair<double, double>, std::pair<Work, Work>> works;  // By cells and range.
  for (std::size_t i = 0; i < settings_.size(); ++i) {
    const MapSetting& one = settings_[i];
    const auto [found, is_new] = works.try_emplace({one.resolution_m, one.range_m});
    auto& [points, map] = found->second;
    if (is_new) {
      const auto cloud = point_cloud_->build(frame, one.range_m, points);
      auto work = mapper_->prepare(cloud.cloud_C.value(), X_WC, {one.resolution_m, one.range_m});
      FLYBALL_ASSERT(work.ok(), "%s", work.error().message.c_str());
      map = std::move(*work);
    }
    durations_s[i] = duration_s(points, map, Hertz{one.clock_hz});
  }
  return durations_s;
}

const std::vector<double>& FutureFrames::durations_s(const Spot& spot) {
  const Vec3 cell = spot.p_W / step_m;
  const std::array<int, 4> key{
      static_cast<int>(std::floor(cell.x())), static_cast<int>(std::floor(cell.y())),
      static_cast<int>(std::floor(cell.z())),
      static_cast<int>(std::lround(yaw_of(spot.tangent_W) / direction_rad))};
  const auto found = durations_s_.find(key);
  return found != durations_s_.end() ? found->second
                                     : durations_s_.emplace(key, taken_at(spot)).first->second;
}

const Foresight& FutureFrames::look(const NavigatorState& navigator, const Situation& situation) {
  foresight_.places.clear();
  foresight_.frame_s.clear();
  for (int i = 0; i <= steps; ++i) {
    const double ahead_m = step_m * i;
    const Spot here = spot(navigator, ahead_m);
    foresight_.places.push_back(place(navigator, situation, here, ahead_m));
    const std::vector<double>& row = durations_s(here);
    foresight_.frame_s.insert(foresight_.frame_s.end(), row.begin(), row.end());
  }
  return foresight_;
}

}  // namespace flyball
