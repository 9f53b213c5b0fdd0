// SPDX-License-Identifier: BSD-3-Clause
#include "cli/computer/autopilot_option.h"

#include "flyball/records/text_table.h"

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

std::string tracking_remark(const Summary& summary, const Scenario& scenario) {
  const auto off_path_m = summary.quality.find("off_path_m_p95");
  if (off_path_m == summary.quality.end() ||
      off_path_m->second <= scenario.vehicle.tracking_error_m) {
    return "";
  }
  return "5 % of the time the autopilot was more than " + rounded(off_path_m->second, 2) +
         " m off its path, and vehicle.tracking_error_m says " +
         rounded(scenario.vehicle.tracking_error_m, 2) +
         " m: set it to so much, or have the autopilot hold its position better";
}

}  // namespace flyball
