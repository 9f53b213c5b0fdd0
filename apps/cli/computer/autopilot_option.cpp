// SPDX-License-Identifier: BSD-3-Clause
#include "cli/computer/autopilot_option.h"

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
