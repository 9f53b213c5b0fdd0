// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/apps/policy_choice.h"

#include "flyball/apps/files.h"
#include "flyball/apps/mission.h"

#include "scenario_parameters.h"

namespace flyball {

Result<PolicyChoice> choose_policy(const std::string& name, std::uint64_t seed) {
  const auto file = find_shipped("presets", name);
  if (file) {
    return load_policy(*file, all_plugins(), seed);
  }
  if (all_plugins().make<Policy>(name)) {
    return PolicyChoice{"policy \"" + name + "\"", [name] {
                          return Result<std::unique_ptr<Policy>>{all_plugins().make<Policy>(name)};
                        }};
  }
  return file.error();
}

}  // namespace flyball
