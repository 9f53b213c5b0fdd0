// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a run leaves on disk, and the page that shows it.

#include "flyball/records/mission_record.h"
#include "flyball/scenario/scenario.h"

#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// Makes the folder, and finds out whether files can be written there: ask before flying.
/// @return The folders that it made, the outermost first.
/// @error `unavailable`; nothing is left behind.
Result<std::vector<std::string>> prepare_folder(const std::string& folder);
/// Undoes `prepare_folder`, except for folders that hold something by now.
void remove_empty(const std::vector<std::string>& folders);

/// Whether `write_file` would find a folder to write to, and no folder in the file's own place: ask
/// before flying.
/// @error `unavailable`.
Status check_place(const std::string& path);

/// Writes a file under a temporary name and renames it: it appears whole or not at all. What a link
/// names is written and the link stays; a device or a pipe is written to directly.
/// @error `unavailable`; an older file of this name is untouched.
Status write_file(const std::string& path, const std::string& content);

/// The scenario as it is kept beside a record, with version, build and a fingerprint of the data
/// files that it names. Equal text: the same mission, flown by the same program.
[[nodiscard]] std::string mission_file(const Scenario& scenario);
/// The same for a page, folded up.
[[nodiscard]] std::string scenario_html(const Scenario& scenario);

/// Whether `write_run` may write or remove a file of this name.
[[nodiscard]] bool is_of_record(const std::string& file);

/// Writes mission.toml, summary.json, trace.jsonl, picture.json and report.html into `folder` (made
/// if missing). mission.toml comes last: where it stands, the record is complete. That of an
/// interrupted mission says so.
/// @error `unavailable` when the folder cannot be written.
Status write_run(const std::string& folder, const Scenario& scenario, const MissionRecord& record);

/// What the page needs of one run; small enough to keep for many runs.
struct RunPicture {
  Summary summary{};
  std::string json{};  ///< World outline, path and time series at 2 Hz, each change of a
                       ///< knob, as a JSON object.
};
[[nodiscard]] RunPicture picture_of(const MissionRecord& record);
/// The picture of a run that `write_run` left in `folder`, when it is complete and of exactly this
/// mission. Empty otherwise.
[[nodiscard]] std::optional<RunPicture> finished_run(const std::string& folder,
                                                     const Scenario& scenario);

/// One self-contained page without network: table, plots over time (speed, each knob that was
/// turned, power, battery) and a top view of world and paths; one colour per policy.
[[nodiscard]] std::string report_page(const std::string& title,
                                      const std::vector<RunPicture>& runs,
                                      const std::string& table_html);

}  // namespace flyball
