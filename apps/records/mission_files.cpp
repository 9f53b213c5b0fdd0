// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/mission_files.h"

#include "flyball/governors/policy_file.h"
#include "flyball/runtime/recorder.h"
#include "flyball/scenario/files.h"
#include "flyball/scenario/policy_choice.h"
#include "flyball/sim/platform_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <variant>

namespace flyball {

namespace fs = std::filesystem;

std::vector<std::string> files_of_mission(const Scenario& scenario) {
  std::vector<std::string> files;
  const auto add = [&files](const std::vector<std::string>& more) {
    files.insert(files.end(), more.begin(), more.end());
  };
  if (const auto airframe = find_shipped("airframes", scenario.vehicle.airframe)) {
    add({*airframe});
  }
  for (const std::string& name : {scenario.platform.name, scenario.edge.platform}) {
    if (const auto platform = find_shipped("platforms", name)) {
      add(files_of_platform(*platform, share_folder("platforms")));
    }
  }
  add(files_behind_policy(scenario.governor.policy));
  for (const auto& [name, value] : scenario.world.parameters) {  // A map, a mesh.
    const std::string* file = std::get_if<std::string>(&value);
    std::error_code failed;
    if (file != nullptr && fs::is_regular_file(*file, failed)) {
      add({*file});
    }
  }
  add(scenario.plugins.libraries());
  return files;
}

std::string data_fingerprint(const Scenario& scenario) {
  TraceHash hash;
  for (const std::string& path : files_of_mission(scenario)) {
    std::ifstream file{path, std::ios::binary};
    hash.add(std::string{std::istreambuf_iterator<char>{file}, {}});
  }
  return hash.hex();
}

Status keep_inputs(const Scenario& scenario,
                   const std::vector<std::string>& inputs,
                   const std::vector<std::string>& outputs) {
  std::vector<std::string> all = files_of_mission(scenario);
  all.insert(all.end(), inputs.begin(), inputs.end());
  for (const std::string& input : all) {
    for (const std::string& output : outputs) {
      std::error_code ignored;  // Of one that is not there.
      if (fs::equivalent(input, output, ignored)) {
        return Error{ErrorCode::invalid_input,
                     "the flight reads \"" + input +
                         "\" and would overwrite it; choose another place for what it writes"};
      }
    }
  }
  return Done{};
}

}  // namespace flyball
