// SPDX-License-Identifier: BSD-3-Clause
#include "cli/computer/autopilot_option.h"

#include "flyball/simulation/tracking_remarks.h"

#include "cli/computer/host_clock.h"
#include "cli/console.h"
#include "cli/flight_options.h"
#include <algorithm>
#include <utility>

#include <CLI/CLI.hpp>

namespace flyball {

void add_autopilot(CLI::App& command, AutopilotOption& option) {
  refuse_empty(
      *command
           .add_option("--autopilot", option.address,
                       "with --executor realtime: PX4 or ArduPilot flies the vehicle, and the "
                       "simulator draws what its cameras see: udp:127.0.0.1:PORT or "
                       "serial:DEVICE:BAUD")
           ->type_name("ADDRESS"));
}

std::variant<LoadedScenario, std::vector<Error>> load_to_fly(const std::string& name_or_path,
                                                             const std::vector<Override>& overrides,
                                                             const Plugins& plugins,
                                                             const AutopilotOption& option,
                                                             std::string& told) {
  auto loaded = load_overridden_scenario(name_or_path, overrides, plugins);
  const auto* flown = std::get_if<LoadedScenario>(&loaded);
  if (flown == nullptr || option.address.empty()) {
    return loaded;
  }
  std::vector<Override> all;
  std::string changed;
  for (const std::string& setting : careful_settings(flown->scenario)) {
    const bool is_given =
        std::any_of(overrides.begin(), overrides.end(), [&setting](const Override& given) {
          return key_of(given.key_and_value) == key_of(setting);
        });
    if (!is_given) {
      all.push_back({setting, "--autopilot"});
      changed += (changed.empty() ? "" : ", ") + setting;
    }
  }
  if (!changed.empty()) {
    told = "an autopilot is flown with " + changed + "; --set says otherwise";
  }
  all.insert(all.end(), overrides.begin(), overrides.end());
  return load_overridden_scenario(name_or_path, all, plugins);
}

Result<std::unique_ptr<AutopilotLink>> open_autopilot(const AutopilotOption& option,
                                                      const ExecutorOptions& executor) {
  if (option.address.empty()) {
    return std::unique_ptr<AutopilotLink>{};
  }
  if (executor.executor == "virtual") {
    return Error{ErrorCode::invalid_input,
                 "--autopilot flies in real time; add --executor realtime"};
  }
  auto stream = open_byte_stream(option.address);
  if (!stream) {
    return stream.error();
  }
  return std::make_unique<AutopilotLink>(
      std::move(*stream), [](const std::string& sentence) { note(sentence); }, host_clock);
}

}  // namespace flyball
