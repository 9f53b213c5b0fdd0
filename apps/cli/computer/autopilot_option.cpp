// SPDX-License-Identifier: BSD-3-Clause
#include "cli/computer/autopilot_option.h"

#include "flyball/runtime/text/listed.h"
#include "flyball/simulation/tracking_remarks.h"

#include "cli/computer/host_clock.h"
#include "cli/console.h"
#include "cli/flight_options.h"
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

std::variant<Scenario, std::vector<Error>> load_to_fly(const std::string& name_or_path,
                                                       const std::vector<Override>& overrides,
                                                       const Plugins& plugins,
                                                       const AutopilotOption& option,
                                                       std::string& told) {
  auto loaded = load_overridden_scenario(name_or_path, overrides, plugins);
  if (auto* errors = std::get_if<std::vector<Error>>(&loaded)) {
    return std::move(*errors);
  }
  Scenario scenario = std::move(std::get<LoadedScenario>(loaded).scenario);
  if (option.address.empty()) {
    return scenario;
  }
  std::vector<std::string> given;
  given.reserve(overrides.size());
  for (const Override& one : overrides) {
    given.push_back(key_of(one.key_and_value));
  }
  const std::string changed = listed(make_careful(scenario, given));
  if (!changed.empty()) {
    told = "an autopilot is flown with " + changed + "; --set says otherwise";
  }
  return scenario;
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
