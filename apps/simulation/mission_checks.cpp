// SPDX-License-Identifier: BSD-3-Clause
// tested-in: mission
#include "simulation/mission_checks.h"

#include "flyball/records/report.h"

#include <filesystem>

namespace flyball {

Status check_map_name(const std::string& path) {
  const std::string ending = std::filesystem::path{path}.extension().string();
  if (!path.empty() && ending != ".bt" && ending != ".ot") {
    return Error{ErrorCode::invalid_input, "map file \"" + path +
                                               "\" must end in .bt (free or occupied) or .ot "
                                               "(log-odds)"};
  }
  return path.empty() ? Status{Done{}} : check_place(path);
}

Status check_executor(const Scenario& scenario, const MissionHooks& hooks) {
  if (!hooks.executor) {
    return Done{};
  }
  std::string key;
  if (scenario.edge.platform != "none") {
    key = "edge.platform = \"" + scenario.edge.platform + "\"";
  } else if (scenario.faults.detector != "none") {
    key = "faults.detector = \"" + scenario.faults.detector + "\"";
  }
  for (std::size_t i = 0; i < scenario.events.size(); ++i) {
    if (scenario.events[i].kind == "bit_flip") {
      key = "events." + std::to_string(i + 1) + ".kind = \"bit_flip\"";
    }
  }
  return key.empty() ? Status{Done{}}
                     : Status{Error{ErrorCode::invalid_input,
                                    key + " needs the modeled computer; leave it out, or fly " +
                                        "without --executor realtime"}};
}

Status check_depth_camera(const Scenario& scenario,
                          const MissionSetup& setup,
                          const MissionHooks& hooks) {
  if (hooks.depth_camera == nullptr) {
    return Done{};
  }
  std::string why;
  if (hooks.autopilot == nullptr) {
    why = "no simulated vehicle carries it; add --autopilot";
  } else if (scenario.camera.count != 1) {
    why = "camera.count = " + std::to_string(scenario.camera.count) + "; set it to 1";
  } else if (setup.things.cameras.forward) {
    why = "kernels.localizer = \"" + scenario.kernels.localizer +
          "\" takes images in colour, too; set it to truth, which is the autopilot's pose then";
  } else if (setup.things.cameras.gimbal) {
    why = "mission.workload = \"" + scenario.mission.workload +
          "\" looks for people in colour; fly another workload";
  }
  return why.empty() ? Status{Done{}}
                     : Status{Error{ErrorCode::invalid_input,
                                    "a real depth camera cannot be flown with: " + why}};
}

}  // namespace flyball
