// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/mission_files.h"
#include "flyball/records/report.h"
#include "flyball/records/text_table.h"
#include "flyball/records/version.h"
#include "flyball/runtime/text/listed.h"

#include "records/frame_files.h"
#include "records/trace_file.h"
#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <system_error>
#include <utility>
#include <vector>

#include <unistd.h>

namespace flyball {
namespace {

namespace fs = std::filesystem;

std::string content_of(const std::string& path) {
  std::ifstream file{path, std::ios::binary};
  return {std::istreambuf_iterator<char>{file}, {}};
}

Error cannot_write(const std::string& path, const std::string& why) {
  return {ErrorCode::unavailable,
          "cannot write \"" + path + "\": " + why + "; choose another place"};
}

/// A figure by which a workload is judged: it stands before time and energy.
struct Foremost {
  const char* name;
  const char* title;
  double scale;
};
constexpr std::array<Foremost, 5> foremost_figures{
    {{"tracked_s", "tracked s", 1.0},
     {"coverage_percent", "coverage %", 1.0},
     {"map_recall", "map recall %", 100.0},
     {"map_precision", "map precision %", 100.0},
     {"area_covered_percent", "area covered %", 1.0}}};

constexpr const char* figures_note =
    "<p class=\"note\">Known, believed, views, looks, detections and frames are what the vehicle "
    "itself counts; coverage, errors, recall and precision are measured in the true world, "
    "unknown to it. Latency is the median time from sensor to command; it is 0 where no map is "
    "made. The page apps/records/README.md lists all figures.</p>";

using TitledCells = std::vector<std::pair<std::string, std::string>>;

void add_foremost(TitledCells& cells, std::map<std::string, double>& quality) {
  for (const Foremost& figure : foremost_figures) {
    if (const auto found = quality.find(figure.name); found != quality.end()) {
      cells.emplace_back(figure.title, rounded(found->second * figure.scale, 1));
      quality.erase(found);
    }
  }
}

/// The libraries whose kernels the mission may name. They are needed to fly it again.
std::string libraries_line(const Plugins& plugins) {
  const std::string names = listed(plugins.libraries(), [](const std::string& file) {
    return fs::path{file}.filename().string();
  });
  return names.empty() ? "" : "# Flown with --kernels: " + names + "\n";
}

/// `known_percent` as "known %", `localization_error_m_max` as "localization error max m".
std::string title_of(std::string name) {
  for (const auto& [end, title] : {std::pair{"_percent", " %"},
                                   {"_m_max", " max m"},
                                   {"_m_mean", " mean m"},
                                   {"_s_max", " max s"}}) {
    const std::string ending{end};
    if (name.size() > ending.size() &&
        name.compare(name.size() - ending.size(), std::string::npos, ending) == 0) {
      name.replace(name.size() - ending.size(), std::string::npos, title);
    }
  }
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string summary_table(const Summary& summary) {
  const bool failed = summary.status == MissionStatus::failed;
  std::map<std::string, double> quality = summary.quality;
  TitledCells cells{{"policy", html_text(summary.policy)},
                    {"seed", std::to_string(summary.seed)},
                    {"end", failed ? to_string(summary.failure) : to_string(summary.status)}};
  add_foremost(cells, quality);
  const TitledCells flight{{"time s", rounded(summary.mission_time_s, 1)},
                           {"energy kJ", rounded(summary.energy_total_j() * 1e-3, 1)},
                           {"battery %", rounded(summary.battery_used_percent(), 1)},
                           {"speed m/s", rounded(summary.mean_speed_m_s, 2)},
                           {"latency ms", rounded(summary.latency_p50_s * 1e3, 0)},
                           {"nearest obstacle m", clearance_text(summary)}};
  cells.insert(cells.end(), flight.begin(), flight.end());
  for (const auto& [name, value] : quality) {
    cells.emplace_back(html_text(title_of(name)), rounded(value, 1));
  }
  std::string titles;
  std::string values;
  for (const auto& [title, value] : cells) {
    titles += std::string{"<th>"}.append(title).append("</th>");
    values += "<td>" + value + "</td>";
  }
  return html_table("<tr>" + titles + "</tr><tr>" + values + "</tr>");
}

/// What was flown then is not the policy's.
std::string trouble_html(const Summary& summary) {
  const std::string trouble =
      trouble_text(summary.policy_faults, summary.decisions, summary.policy_trouble);
  return trouble.empty() ? ""
                         : "<p class=\"note\">" +
                               html_text("policy " + summary.policy + " " + trouble) + "</p>";
}

std::string run_page(const Scenario& scenario,
                     const RunPicture& picture,
                     const std::string& frames_html) {
  return report_page(scenario.name, {picture},
                     summary_table(picture.summary) + trouble_html(picture.summary) + figures_note +
                         frames_html + scenario_html(scenario));
}

/// One attempt at `prepare_folder`.
Result<std::vector<std::string>> try_to_prepare(const std::string& folder) {
  std::error_code failed;
  std::vector<std::string> made;
  for (fs::path at = fs::absolute(folder, failed).lexically_normal();
       !at.empty() && !fs::exists(at, failed); at = at.parent_path()) {
    made.insert(made.begin(), at.string());
  }
  fs::create_directories(folder, failed);
  if (failed) {
    remove_empty(made);
    return cannot_write(folder, failed.message());
  }
  const std::string probe = (fs::path{folder} / ".writable").string();
  if (Status written = write_file(probe, ""); !written) {
    remove_empty(made);
    return written.error();
  }
  fs::remove(probe, failed);
  return made;
}

}  // namespace

Result<std::vector<std::string>> prepare_folder(const std::string& folder) {
  // Another process that shares the folder may remove what is empty at any moment, between two
  // steps of ours too. So many times in a row it does not; then the place itself is at fault.
  constexpr int most_attempts = 1000;
  for (int attempt = 1;; ++attempt) {
    auto made = try_to_prepare(folder);
    if (made) {
      return made;
    }
    if (attempt == most_attempts) {
      return Error{made.error().code, made.error().message + " with --out"};
    }
  }
}

void remove_empty(const std::vector<std::string>& folders) {
  std::error_code ignored;  // Of one that is not empty.
  for (auto folder = folders.rbegin(); folder != folders.rend(); ++folder) {
    fs::remove(*folder, ignored);
  }
}

Status check_place(const std::string& path) {
  const fs::path folder = fs::path{path}.has_parent_path() ? fs::path{path}.parent_path() : ".";
  std::error_code failed;
  if (!fs::is_directory(folder, failed)) {
    return cannot_write(path, "there is no folder \"" + folder.string() + "\"");
  }
  if (fs::is_directory(path, failed)) {
    return cannot_write(path, "it is a folder");
  }
  if (access(folder.c_str(), W_OK) != 0) {
    return cannot_write(path, "folder \"" + folder.string() + "\" refuses it");
  }
  return Done{};
}

Status write_file(const std::string& path, const std::string& content) {
  std::error_code failed;
  // A link stays, and so does a device or a pipe, which a file with its name would replace.
  const fs::path followed = fs::canonical(path, failed);
  const std::string place = failed ? path : followed.string();
  const bool is_stream = fs::is_other(fs::status(place, failed));
  // Of this process: two that write one file must not take each other's half.
  const std::string temporary =
      is_stream ? place : place + "." + std::to_string(getpid()) + ".part";
  failed.clear();
  errno = 0;
  std::ofstream file{temporary, std::ios::binary | std::ios::trunc};
  file << content;
  file.close();
  const int reason = errno;  // Of the system's call that failed, if one did.
  if (file && !is_stream) {
    fs::rename(temporary, place, failed);
  }
  if (!file || failed) {
    const std::string why = failed        ? failed.message()
                            : reason != 0 ? std::generic_category().message(reason)
                                          : "the folder or disk refuses it";
    if (!is_stream) {
      std::error_code ignored;
      fs::remove(temporary, ignored);
    }
    return cannot_write(path, why);
  }
  return Done{};
}

std::string mission_file(const Scenario& scenario) {
  return "# Flyball " + version() + ", build " + build_fingerprint() + ", data " +
         data_fingerprint(scenario) + "\n" + libraries_line(scenario.plugins) + to_toml(scenario);
}

std::string scenario_html(const Scenario& scenario) {
  return "<details><summary>The scenario, every setting</summary><pre>" +
         html_text(mission_file(scenario)) + "</pre></details>\n";
}

bool is_of_record(const std::string& file) {
  constexpr std::array names{"mission.toml", "summary.json", "trace.jsonl", "picture.json",
                             "report.html"};
  return std::find(names.begin(), names.end(), file) != names.end() || file.rfind("frame_", 0) == 0;
}

Status write_run(const std::string& folder, const Scenario& scenario, const MissionRecord& record) {
  const fs::path in{folder};
  std::error_code failed;
  fs::create_directories(in, failed);
  // Whatever stood here is incomplete from now on, and its pictures are none of this flight's.
  bool had_record = fs::remove(in / "mission.toml", failed);
  for (int i = 1; had_record; ++i) {
    had_record = fs::remove(in / ("frame_" + std::to_string(i) + ".png"), failed);
  }
  const RunPicture picture = picture_of(record);
  const auto frames_html = write_frames(folder, record.frames);
  if (!frames_html) {
    return frames_html.error();
  }
  const bool is_whole = record.summary.status != MissionStatus::interrupted;
  const std::pair<const char*, std::string> files[] = {
      {"trace.jsonl", trace_lines(scenario, *record.trace)},
      {"picture.json", picture.json},
      {"report.html", run_page(scenario, picture, *frames_html)},
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
