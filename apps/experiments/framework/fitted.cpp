// SPDX-License-Identifier: BSD-3-Clause

#include "experiments/framework/fitted.h"

#include "flyball/records/text_table.h"
#include "flyball/scenario/shipped_platform.h"

#include <array>

namespace flyball {
namespace {

constexpr const char* platform_file = "sim/platforms/jetson_tx2.toml";

/// A kernel whose scale brings recorded work to a time that a paper prints.
struct FittedScale {
  const char* kernel;
  const char* to;
};

constexpr std::array<FittedScale, 11> scales{{
    {"depth_to_points", "MAVBench's 2 ms, one image of 256 x 144"},
    {"octomap", "MAVBench's 630 ms in package delivery, scene A (outdoors before the door)"},
    {"swept_cylinder", "MAVBench's 1 ms, the next 7 m of the path in scene A"},
    {"rrt_connect", "MAVBench's 182 ms in package delivery, mean of the plans of scene A"},
    {"lawnmower", "MAVBench's 89 ms, a survey of 100 x 100 m in 5 lanes"},
    {"visual_slam", "MAVBench's 55 ms in package delivery, one image"},
    {"visual_slam_frames", "MAVBench's 55 ms in package delivery, ORB SLAM's counts in scene A"},
    {"nbvp", "MAVBench's 2647 ms in 3-D mapping, 28 decisions in scene C (an office)"},
    {"yolov2", "the mean of MAVBench's 307 and 271 ms"},
    {"kcf_buffered", "MAVBench's 80 ms: one start and 6 updates"},
    {"kcf_real_time", "MAVBench's 18 ms: one update"},
}};

/// The kernel's scale; where that is 1, its only price.
Fitted fitted_price(const FittedScale& fitted, const KernelCost& cost) {
  const std::string kernel = fitted.kernel;
  if (cost.scale != 1.0 || cost.seconds_per.empty()) {
    return {"scale of " + kernel, rounded(cost.scale, 1), fitted.to, platform_file};
  }
  const auto& [operation, seconds] = *cost.seconds_per.rbegin();
  return {"price of " + kernel,
          rounded(1e3 * seconds, 1) + " ms for one of its " + operation + " at 1 GHz", fitted.to,
          platform_file};
}

/// What other files hold.
std::vector<Fitted> other_values() {
  return {
      {"prices of stock OctoMap's operations", "",
       "least squares of insertPointCloud on an x86 host, 6 resolutions from .15 to .98 m",
       platform_file},
      {"prices of ORB SLAM's operations", "",
       "least squares of 1800 frames on an x86 host, outdoors and in rooms", platform_file},
      {"fixed cost per frame of the resolution curve", "5.2 ms of the host",
       "MAVBench's 4.5 times between .15 and .98 m; shown beside the curve, charged to no flight",
       "apps/studies/platform_fit.cpp"},
      {"resistance of the battery's cells", "0.3 times that of the published cell",
       "the maker's endurances of the Matrice 100", "sim/src/energy/battery.cpp"},
      {"gains of the flight controller", "", "steps and circles flown by the Matrice 100",
       "sim/include/flyball/sim/flight_controller.h"},
      {"gains and filter of the target follower", "",
       "the walk of photography_park at the highest operating point",
       "apps/flight/people/target_follower.cpp"},
      {"how long an unseen person is expected to keep a direction", "2 s",
       "15 flights of photography_park: the most that succeed",
       "apps/flight/people/target_follower.cpp"},
      {"lens, detector's steps, threshold and image size of photography_park", "",
       "people who are seen from 14 m instead of 11 m",
       "apps/scenario/scenarios/photography_park.toml"},
      {"bays of the ruin in scene D", "as large as the rooms of scene B",
       "the kernel times of search and rescue, which it checks; no flight uses this world",
       "apps/studies/fit_exploration.cpp"},
      {"texture of rubble in collapsed_building", "",
       "looks broken instead of smooth; with smooth rubble ORB SLAM would take 36 ms in scene D, "
       "and MAVBench has 45 ms",
       "sim/src/world/surface_colour.cpp"},
      {"place of doors on the map's grid", "on the centre of a cell",
       "doors that are open at .15 m and shut at .80 m, as MAVBench reports; see kindness",
       "sim/README.md"},
      {"coverage of mapping_office", "90 %",
       "a map that has nine tenths of the surfaces; MAVBench asks for 85 %",
       "apps/scenario/scenarios/mapping_office.toml"},
      {"costs of octomap and of the fixed stages on platform roborun", "",
       "RoboRun's published insertion times and stages", "sim/platforms/roborun.toml"},
      {"latency model of roborun_own", "", "RoboRun's six published insertion times",
       "policies/presets/roborun_own.toml"},
      {"cells and range of fixed_tuned", "", "least energy of 6 settings on 2 training worlds",
       "policies/presets/fixed_tuned.toml"},
      {"range of fixed_tuned_mixed", "", "least energy of 4 settings on 4 training worlds",
       "policies/presets/fixed_tuned_mixed.toml"},
      {"levels and ranges of two_level_tuned", "",
       "least energy of 8 settings on 4 training worlds", "policies/presets/two_level_tuned.toml"},
  };
}

}  // namespace

Result<std::vector<Fitted>> fitted_values() {
  const auto model = find_platform("jetson_tx2");
  if (!model) {
    return model.error();
  }
  std::vector<Fitted> all;
  for (const FittedScale& scale : scales) {
    const auto cost = model->kernels.find(scale.kernel);
    if (cost == model->kernels.end()) {
      return Error{ErrorCode::invalid_input,
                   std::string{"kernel \""} + scale.kernel + "\" has no price on " + model->name};
    }
    all.push_back(fitted_price(scale, cost->second));
  }
  const std::vector<Fitted> others = other_values();
  all.insert(all.end(), others.begin(), others.end());
  return all;
}

}  // namespace flyball
