// SPDX-License-Identifier: BSD-3-Clause
//
// A map of a recording. Its poses are the recording's own true path, those of a file, or those of a
// localizer.

#include "flyball/kernels/localizer.h"
#include "flyball/recordings/localization_run.h"
#include "flyball/recordings/recorded_map.h"
#include "flyball/records/report.h"
#include "flyball/records/text_table.h"

#include "commands.h"
#include "console.h"
#include "flight_options.h"
#include "recording_options.h"
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace flyball {
namespace {

namespace fs = std::filesystem;

struct MapFromOptions {
  RecordingOptions recording;
  std::string out;
  std::string mapper{"flyball"};
  std::string poses;
  std::string localizer;
  MappingSettings settings;
  Plugins plugins{};
  bool as_json{};
};

Status check(const MapFromOptions& options) {
  const fs::path out{options.out};
  if (out.extension() != ".bt" && out.extension() != ".ot") {
    return Error{ErrorCode::invalid_input,
                 "--out \"" + options.out + "\" must end in .bt or .ot, as OctoMap's files do"};
  }
  if (Status place = check_place(options.out); !place) {
    return place;
  }
  if (!options.poses.empty() && !options.localizer.empty()) {
    return Error{ErrorCode::invalid_input,
                 "--poses and --localizer exclude each other: choose where the poses come from"};
  }
  const MapperSettings& map = options.settings.map;
  if (!(map.resolution_m >= 0.01 && map.resolution_m <= 10.0)) {
    return Error{ErrorCode::invalid_input,
                 "--resolution " + rounded(map.resolution_m, 3) + " must be from 0.01 to 10 m"};
  }
  if (!(map.range_m > map.resolution_m && map.range_m <= 100.0)) {
    return Error{ErrorCode::invalid_input, "--range " + rounded(map.range_m, 3) +
                                               " must be above the resolution and at most 100 m"};
  }
  if (options.settings.every < 1) {
    return Error{ErrorCode::invalid_input,
                 "--every " + std::to_string(options.settings.every) + " must be at least 1"};
  }
  return Done{};
}

/// The pose at which a forward camera begins unless one is given: level, at the origin.
Pose level_camera() {
  Pose X_WC = Pose::Identity();
  X_WC.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return X_WC;
}

/// The localizer's path, moved to where the true one begins. Without one, a localizer that feels
/// gravity is upright already; another one begins as a level camera.
Result<std::vector<TimedPose>> localized(const Recording& recording,
                                         const std::string& name,
                                         const Plugins& plugins) {
  auto localizer = make_seeing_localizer(name, plugins);
  if (!localizer) {
    return localizer.error();
  }
  auto run = localize(recording, **localizer, was_interrupted);
  if (!run) {
    return run.error();
  }
  if (run->path.empty()) {
    return Error{ErrorCode::failed, "localizer \"" + name + "\" found no pose in any of " +
                                        std::to_string(run->frames) + " frames"};
  }
  const TimedPose first = run->path.front();
  constexpr auto widest_gap = std::chrono::milliseconds{100};
  Pose X_WL = (*localizer)->inputs().imu ? Pose::Identity() : level_camera();
  if (const auto truth = pose_between(recording.truth, first.stamp, widest_gap)) {
    X_WL = *truth * first.X_WB.inverse();
  }
  for (TimedPose& pose : run->path) {
    pose.X_WB = X_WL * pose.X_WB;
  }
  return std::move(run->path);
}

Result<std::vector<TimedPose>> poses_for(const Recording& recording,
                                         const MapFromOptions& options) {
  if (!options.localizer.empty()) {
    return localized(recording, options.localizer, options.plugins);
  }
  if (!options.poses.empty()) {
    return read_tum_trajectory(options.poses);
  }
  if (recording.truth.empty()) {
    return Error{ErrorCode::invalid_input,
                 "the recording has no true path; name poses with --poses FILE, or let "
                 "--localizer visual_slam find them"};
  }
  return recording.truth;
}

std::string to_json(const MappingRun& run, const MapContents& contents) {
  const MapLevel level = contents.levels.empty() ? MapLevel{} : contents.levels.front();
  return nlohmann::ordered_json{{"frames", run.frames},
                                {"without_pose", run.without_pose},
                                {"rays", run.rays},
                                {"updates", run.updates},
                                {"cell_m", level.cell_m},
                                {"known_cells", level.known_cells},
                                {"occupied_cells", level.occupied_cells},
                                {"bytes", contents.bytes}}
             .dump(2) +
         "\n";
}

std::string to_text(const MappingRun& run, const MapContents& contents) {
  const MapLevel level = contents.levels.empty() ? MapLevel{} : contents.levels.front();
  return aligned({{"frames", std::to_string(run.frames)},
                  {"without a pose", std::to_string(run.without_pose)},
                  {"rays", rounded(run.rays, 0)},
                  {"cells updated", rounded(run.updates, 0)},
                  {"cell", rounded(level.cell_m, 3) + " m"},
                  {"cells known", std::to_string(level.known_cells)},
                  {"cells occupied", std::to_string(level.occupied_cells)},
                  {"bytes", std::to_string(contents.bytes)}});
}

int map_from(MapFromOptions& options) {
  if (const Status usable = check(options); !usable) {
    return refuse({usable.error()});
  }
  // A mapper of several resolutions writes its finest cells, so those are what is asked for.
  auto mapper = make_mapper(options.mapper, options.plugins, options.settings.map.resolution_m);
  if (!mapper) {
    return refuse({mapper.error()});
  }
  const auto recording = read_recording(options.recording);
  if (!recording) {
    return refuse({recording.error()});
  }
  catch_interrupt();
  const auto poses = poses_for(*recording, options);
  if (!poses) {
    return refuse({poses.error()});
  }
  if (!options.localizer.empty()) {
    options.settings.widest_gap = {};  // A frame that gave no pose must not get one in between.
  }
  const auto run = map_recording(*recording, *poses, options.settings, **mapper, was_interrupted);
  if (!run) {
    return refuse({run.error()});
  }
  if (was_interrupted()) {
    remark("interrupted; no map is written");
    return interrupted_exit_code();
  }
  if (const Status written = (*mapper)->write(options.out, std::nullopt); !written) {
    return refuse({written.error()});
  }
  const MapContents contents = (*mapper)->contents();
  print(options.as_json ? to_json(*run, contents) : to_text(*run, contents));
  return exit_success;
}

}  // namespace

void add_map_from(CLI::App& map, int& exit_code) {
  CLI::App* command =
      map.add_subcommand("from", "makes a map of a recording's depth images and poses");
  const auto options = std::make_shared<MapFromOptions>();  // Owners: the parser's callbacks.
  add_recording_options(*command, options->recording);
  command->add_option("--out", options->out, "writes the map there: a file that ends in .bt or .ot")
      ->type_name("FILE")
      ->required();
  command->add_option("--mapper", options->mapper, "flyball or octomap")->type_name("NAME");
  command->add_option("--resolution", options->settings.map.resolution_m, "size of a cell")
      ->type_name("M");
  command
      ->add_option("--range", options->settings.map.range_m,
                   "depth beyond it frees space and marks nothing occupied")
      ->type_name("M");
  refuse_empty(
      *command
           ->add_option("--poses", options->poses,
                        "a file of lines `time tx ty tz qx qy qz qw`, in place of the true path")
           ->type_name("FILE"));
  refuse_empty(*command
                    ->add_option("--localizer", options->localizer,
                                 "finds the poses: visual_slam or visual_inertial")
                    ->type_name("NAME"));
  command->add_option("--every", options->settings.every, "uses every Nth frame")->type_name("N");
  command->add_flag("--json", options->as_json, "prints JSON");
  add_kernels(*command, options->plugins);
  command->callback([options, &exit_code] { exit_code = map_from(*options); });
}

}  // namespace flyball
