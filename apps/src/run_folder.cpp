// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/apps/files.h"
#include "flyball/apps/report.h"
#include "flyball/apps/version.h"

#include "html.h"
#include "trace_file.h"
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace flyball {
namespace {

namespace fs = std::filesystem;

std::string content_of(const std::string& path) {
  std::ifstream file{path, std::ios::binary};
  return {std::istreambuf_iterator<char>{file}, {}};
}

Error cannot_write(const std::string& path, const std::string& why) {
  return {ErrorCode::unavailable,
          "cannot write \"" + path + "\": " + why + "; choose another place with --out"};
}

/// Of the files that the scenario names: their numbers are part of the mission.
std::string data_fingerprint(const Scenario& scenario) {
  TraceHash hash;
  const std::pair<const char*, std::string> files[] = {{"airframes", scenario.vehicle.airframe},
                                                       {"platforms", scenario.platform.name},
                                                       {"presets", scenario.governor.policy}};
  for (const auto& [kind, name] : files) {
    const Result<std::string> file = find_shipped(kind, name);
    hash.add(file ? content_of(*file) : std::string{});
  }
  return hash.hex();
}

std::string summary_table(const Summary& summary) {
  std::array<char, 400> rows{};
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): streams need a line for each number
  std::snprintf(rows.data(), rows.size(),
                "<tr><td>%s<td>%llu<td>%s<td>%.1f<td>%.1f<td>%.1f<td>%.2f<td>%.0f<td>%.2f</tr>",
                html_text(summary.policy).c_str(), static_cast<unsigned long long>(summary.seed),
                summary.status == MissionStatus::failed ? to_string(summary.failure)
                                                        : to_string(summary.status),
                summary.mission_time_s, summary.energy_total_j() * 1e-3,
                summary.battery_start_percent - summary.battery_end_percent, summary.mean_speed_m_s,
                summary.latency_p50_s * 1e3, summary.min_clearance_m);
  return std::string{
             "<table><tr><th>policy<th>seed<th>end<th>time s<th>energy kJ<th>battery %<th>speed m/s"
             "<th>latency ms<th>clearance m</tr>"} +
         rows.data() + "</table>";
}

std::string run_page(const Scenario& scenario, const RunPicture& picture) {
  const std::string details = "<details><summary>The whole scenario</summary><pre>" +
                              html_text(mission_file(scenario)) + "</pre></details>";
  return report_page(scenario.name, {picture}, summary_table(picture.summary) + details);
}

}  // namespace

Status prepare_folder(const std::string& folder) {
  std::error_code failed;
  const bool is_new = fs::create_directories(folder, failed);
  if (failed) {
    return cannot_write(folder, failed.message());
  }
  const std::string probe = (fs::path{folder} / ".writable").string();
  const Status written = write_file(probe, "");
  fs::remove(probe, failed);
  if (!written && is_new) {
    fs::remove(folder, failed);
  }
  return written;
}

Status write_file(const std::string& path, const std::string& content) {
  const std::string temporary = path + ".part";
  std::error_code failed;
  std::ofstream file{temporary, std::ios::binary | std::ios::trunc};
  file << content;
  file.close();
  if (file) {
    fs::rename(temporary, path, failed);
  }
  if (!file || failed) {
    const Error error =
        cannot_write(path, failed ? failed.message() : "the folder or disk refuses it");
    fs::remove(temporary, failed);
    return error;
  }
  return Done{};
}

std::string mission_file(const Scenario& scenario) {
  return "# Flyball " + version() + ", build " + build_fingerprint() + ", data " +
         data_fingerprint(scenario) + "\n" + to_toml(scenario);
}

Status write_run(const std::string& folder, const Scenario& scenario, const MissionRecord& record) {
  const fs::path in{folder};
  std::error_code failed;
  fs::create_directories(in, failed);
  fs::remove(in / "mission.toml", failed);  // Whatever stood here is incomplete from now on.
  const RunPicture picture = picture_of(record);
  const bool is_whole = record.summary.status != MissionStatus::interrupted;
  const std::pair<const char*, std::string> files[] = {
      {"trace.jsonl", trace_lines(scenario, *record.trace)},
      {"picture.json", picture.json},
      {"report.html", run_page(scenario, picture)},
      {"summary.json", to_json(record.summary) + "\n"},
      {"mission.toml",
       (is_whole ? "" : "# Interrupted: the record ends early.\n") + mission_file(scenario)}};
  for (const auto& [name, content] : files) {
    if (Status written = write_file((in / name).string(), content); !written) {
      return written;
    }
  }
  return Done{};
}

std::optional<RunPicture> finished_run(const std::string& folder, const Scenario& scenario) {
  const fs::path in{folder};
  RunPicture run;
  if (content_of((in / "mission.toml").string()) != mission_file(scenario) ||
      !from_json(content_of((in / "summary.json").string()), run.summary)) {
    return std::nullopt;
  }
  run.json = content_of((in / "picture.json").string());
  return run;
}

}  // namespace flyball
