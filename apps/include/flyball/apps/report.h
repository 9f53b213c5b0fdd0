// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a run leaves on disk, and the page that shows it.

#include "flyball/apps/mission.h"

#include <string>
#include <vector>

namespace flyball {

/// Writes mission.toml, summary.json, trace.jsonl and report.html into `folder` (made if missing).
/// Each file appears whole or not at all.
/// @error `unavailable` when the folder cannot be written.
Status write_run(const std::string& folder, const Scenario& scenario, const MissionRecord& record);

/// What the page needs of one run; small enough to keep for many runs.
struct RunPicture {
  Summary summary{};
  std::string json{};  ///< World outline, path and time series at 2 Hz, as a JSON object.
};
[[nodiscard]] RunPicture picture_of(const MissionRecord& record);

/// One self-contained page without network: table, plots over time (resolution, speed, power,
/// battery) and a top view of world and paths; one colour per policy.
[[nodiscard]] std::string report_page(const std::string& title, const std::vector<RunPicture>& runs,
                                      const std::string& table_html);

}  // namespace flyball
