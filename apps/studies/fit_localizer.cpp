// SPDX-License-Identifier: BSD-3-Clause
// tested-in: platform_fit
#include "studies/fit_localizer.h"

#include "flyball/flight/perception/perception_nodes.h"
#include "flyball/flight/perception/view.h"
#include "flyball/kernels/localizer.h"
#include "flyball/sim/depth_camera.h"
#include "flyball/sim/world.h"

#include "scenario/kernel_choice.h"
#include "simulation/seeing_setup.h"
#include <algorithm>
#include <cmath>

namespace flyball {
namespace {

constexpr const char* localizer_name = "visual_slam";
constexpr double walking_m_s = 1.5;
constexpr double ramp_s = 1.0;

double flown_m(const Stretch& stretch, double t_s) {
  if (stretch.speed_m_s <= walking_m_s) {
    return stretch.speed_m_s * t_s;
  }
  const double rising_s = std::min(t_s, ramp_s);
  return stretch.speed_m_s * (rising_s * rising_s / (2.0 * ramp_s) + (t_s - rising_s));
}

}  // namespace

Result<std::vector<VisualFrame>> frames_of(const Stretch& stretch,
                                           const Scenario& scenario,
                                           const World& world) {
  const DepthCamera depth{world, scenario.camera, scenario.seed};
  const auto colour = ColourCamera::make(world, colour_beside(scenario.camera));
  if (!colour) {
    return colour.error();
  }
  const double rate_hz = scenario.camera.rate_hz;
  std::vector<VisualFrame> frames;
  for (int i = 0; i < static_cast<int>(std::lround(stretch.duration_s * rate_hz)); ++i) {
    Pose X_WB = stretch.X_WB;
    X_WB.translation() += X_WB.linear().col(0) * flown_m(stretch, i / rate_hz);
    const Pose X_WC = camera_pose(X_WB, scenario.camera);
    const MissionTime now{from_seconds(i / rate_hz)};
    const auto sequence = static_cast<std::uint64_t>(i);
    View view;
    view.X_BC = X_WB.inverse() * X_WC;
    view.depth = depth.frame(X_WC, now, sequence);
    view.colour = (*colour)->frame({X_WC, view.X_BC}, now, sequence);
    frames.push_back(visual_frame(view));
  }
  return frames;
}

Status track_stretches(const std::vector<Stretch>& stretches,
                       const Scenario& scenario,
                       const World& world,
                       KernelLoads& loads) {
  KernelSettings kernels;
  kernels.localizer = localizer_name;
  kernels.localizer_parameters = {{"weak_corner", 7.0}, {"strong_corner", 20.0}};
  std::vector<Work>& calls = loads[frame_cost(localizer_name)].calls;
  for (const Stretch& stretch : stretches) {
    const auto frames = frames_of(stretch, scenario, world);
    if (!frames) {
      return frames.error();
    }
    const auto made = make_kernel<Localizer>(scenario.plugins, kernels);
    if (!made) {
      return made.error();
    }
    const auto& localizer = *made;
    localizer->start({});
    localizer->set_initial_pose(stretch.X_WB);
    for (const VisualFrame& frame : *frames) {
      Work work;
      if (const auto fix = localizer->track_frame(frame, work); !fix) {
        return fix.error();
      }
      if (&frame != &frames->front()) {
        calls.push_back(work);
      }
    }
  }
  return Done{};
}

}  // namespace flyball
