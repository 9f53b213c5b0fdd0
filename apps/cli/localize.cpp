// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/kernels/localizer.h"
#include "flyball/recordings/localization_run.h"
#include "flyball/records/report.h"
#include "flyball/records/text_table.h"

#include "commands.h"
#include "console.h"
#include "flight_options.h"
#include "recording_options.h"
#include <algorithm>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace flyball {
namespace {

struct LocalizeOptions {
  RecordingOptions recording;
  std::string localizer{"visual_slam"};
  std::string out;
  double uncertain_above_m{0.1};
  Plugins plugins{};
  bool as_json{};
};

std::string to_json(const LocalizationRun& run, const LocalizeOptions& options) {
  nlohmann::ordered_json json{
      {"localizer", options.localizer},
      {"frames", run.frames},
      {"lost", run.lost},
      {"uncertain", run.uncertain},
      {"uncertain_above_m", options.uncertain_above_m},
      {"sigma_m_last", run.sigma_m_last},
      {"keyframes", run.keyframes},
      {"loops_closed", run.loops_closed},
      {"frame_ms", {{"mean", run.frame_ms_mean}, {"max", run.frame_ms_max}}}};
  if (run.error) {
    json["absolute_trajectory_error_m"] = {{"rmse", run.error->rmse_m},
                                           {"mean", run.error->mean_m},
                                           {"median", run.error->median_m},
                                           {"max", run.error->max_m},
                                           {"pairs", run.error->pairs}};
    json["path_m"] = run.error->path_m;
  }
  return json.dump(2) + "\n";
}

std::string to_text(const LocalizationRun& run, double uncertain_above_m) {
  std::vector<std::vector<std::string>> lines{
      {"frames", std::to_string(run.frames)},
      {"lost", std::to_string(run.lost)},
      {"uncertain", std::to_string(run.uncertain) + ", by its own reckoning more than " +
                        rounded(uncertain_above_m, 3) + " m off"},
      {"expected error", rounded(run.sigma_m_last, 3) + " m at the end"},
      {"keyframes", std::to_string(run.keyframes)},
      {"loops closed", std::to_string(run.loops_closed)},
      {"ms per frame",
       rounded(run.frame_ms_mean, 2) + " mean, " + rounded(run.frame_ms_max, 2) + " max"}};
  if (run.error) {
    const TrajectoryError& error = *run.error;
    lines.push_back({"absolute trajectory error", rounded(error.rmse_m, 4) + " m rmse, " +
                                                      rounded(error.median_m, 4) + " m median, " +
                                                      rounded(error.max_m, 4) + " m max"});
    lines.push_back({"true path", rounded(error.path_m, 2) + " m, " + std::to_string(error.pairs) +
                                      " poses compared"});
  } else {
    lines.push_back({"absolute trajectory error", "-"});
  }
  return aligned(lines);
}

/// The path must not take the place of what it was found from.
Status check_out(const Recording& recording, const std::string& out) {
  std::vector<std::string> own = recording.text_files;
  for (const RecordedFrame& frame : recording.frames) {
    own.insert(own.end(), {frame.grey_file, frame.depth_file});
  }
  const auto is_out = [&out](const std::string& file) {
    std::error_code failed;
    return std::filesystem::equivalent(file, out, failed);
  };
  if (std::any_of(own.begin(), own.end(), is_out)) {
    return Error{ErrorCode::invalid_input, "--out " + out +
                                               " is a file of the recording itself; give another "
                                               "name"};
  }
  return check_place(out);
}

int localize(const LocalizeOptions& options) {
  auto localizer = make_seeing_localizer(options.localizer, options.plugins);
  if (!localizer) {
    return refuse({localizer.error()});
  }
  const auto recording = read_recording(options.recording);
  if (!recording) {
    return refuse({recording.error()});
  }
  if (!options.out.empty()) {  // Checked first, because a wrong folder would waste the work.
    const Status place = check_out(*recording, options.out);
    if (!place) {
      return refuse({place.error()});
    }
  }
  catch_interrupt();
  const auto run = localize(*recording, **localizer, was_interrupted, options.uncertain_above_m);
  if (!run) {
    return refuse({run.error()});
  }
  if (!options.out.empty()) {
    if (const Status written = write_tum_trajectory(options.out, run->path); !written) {
      return refuse({written.error()});
    }
  }
  print(options.as_json ? to_json(*run, options) : to_text(*run, options.uncertain_above_m));
  if (was_interrupted()) {
    return interrupted_exit_code();
  }
  return run->path.empty() ? exit_mission_failed : exit_success;
}

}  // namespace

void add_localize(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "localize", "finds the path of a recorded flight (TUM RGB-D or EuRoC layout)");
  const auto options = std::make_shared<LocalizeOptions>();  // Owners: the parser's callbacks.
  add_recording_options(*command, options->recording);
  refuse_empty(
      *command->add_option("--localizer", options->localizer, "visual_slam or visual_inertial")
           ->type_name("NAME"));
  refuse_nan(*command
                  ->add_option("--uncertain-above", options->uncertain_above_m,
                               "counts poses whose expected error is larger; 0.1 by default")
                  ->type_name("M")
                  ->check(CLI::Range(1e-4, 1000.0)));
  refuse_empty(
      *command->add_option("--out", options->out, "writes the path there, as TUM's tools read it")
           ->type_name("FILE"));
  command->add_flag("--json", options->as_json, "prints JSON");
  add_kernels(*command, options->plugins);
  command->callback([options, &exit_code] { exit_code = localize(*options); });
}

}  // namespace flyball
