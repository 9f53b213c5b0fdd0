// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/mcap/onboard_record.h"
#include "flyball/records/mission_files.h"
#include "flyball/records/report.h"
#include "flyball/records/text_table.h"
#include "flyball/records/version.h"
#include "flyball/scenario/override.h"
#include "flyball/scenario/shipped_platform.h"
#include "flyball/simulation/mission.h"
#include "flyball/simulation/tracking_remarks.h"

#include "claimed_folder.h"
#include "cli/computer/autopilot_option.h"
#include "cli/computer/depth_camera_option.h"
#include "cli/computer/real_computer.h"
#include "cli/computer/service_notice.h"
#include "commands.h"
#include "console.h"
#include "flight_batch.h"
#include "record_place.h"
#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

namespace fs = std::filesystem;

struct RunOptions {
  FlightOptions flight{};
  std::string policy{};
  std::string seed{};
  std::string start_map{};
  std::string final_map{};
  std::string timeline{};
  std::string mcap{};
  ExecutorOptions executor{};
  AutopilotOption autopilot{};
  std::string depth_camera{};
};

std::string with_unit(double value, int digits, const std::string& unit) {
  return rounded(value, digits) + " " + unit;
}

std::vector<std::vector<std::string>> flight_lines(const Summary& s) {
  std::vector<std::vector<std::string>> lines{
      {"  mission time", with_unit(s.mission_time_s, 1, "s")},
      {"  energy", with_unit(s.energy_total_j() * 1e-3, 1, "kJ") + " (computer " +
                       with_unit(s.energy_computer_j * 1e-3, 1, "kJ") + ")"},
      {"  battery used", with_unit(s.battery_used_percent(), 1, "%")},
      {"  distance", with_unit(s.distance_m, 1, "m") + ", mean " +
                         with_unit(s.mean_speed_m_s, 2, "m/s") + ", max " +
                         with_unit(s.max_speed_m_s, 2, "m/s")},
      {"  latency", s.maps == 0
                        ? "-, it made no map"
                        : with_unit(s.latency_p50_s * 1e3, 0, "ms") + " median, 95 % within " +
                              with_unit(s.latency_p95_s * 1e3, 0, "ms")},
      {"  nearest obstacle", clearance_text(s, " m")}};
  if (const std::string trouble = trouble_text(s.policy_faults, s.decisions, s.policy_trouble);
      !trouble.empty()) {
    lines.push_back({"  policy", trouble});
  }
  if (s.hottest_c) {
    lines.push_back({"  computer's heat", with_unit(*s.hottest_c, 1, "degrees Celsius at most") +
                                              ", throttled " + std::to_string(s.throttle_events) +
                                              (s.throttle_events == 1 ? " time" : " times")});
  }
  for (const auto& [name, value] : s.quality) {
    lines.push_back({"  " + name, rounded(value, 3)});
  }
  return lines;
}

/// @param folder  Of the record; empty: there is none.
std::string result_text(const Summary& s, const std::string& folder) {
  const std::string end = s.failure == MissionFailure::none
                              ? to_string(s.status)
                              : std::string{"failed: "} + to_string(s.failure);
  std::vector<std::vector<std::string>> lines = flight_lines(s);
  lines.push_back({"  host time", with_unit(s.host_s, 1, "s") + ", " +
                                      with_unit(s.real_time_factor, 1, "times real time")});
  lines.push_back({"  trace hash", s.trace_hash + " (numerics " + s.numeric_fingerprint + ")"});
  if (!folder.empty()) {
    lines.push_back({"  record", folder});
  }
  return s.scenario + ", " + s.policy + ", seed " + std::to_string(s.seed) + ": " + end + "\n" +
         aligned(lines);
}

std::vector<Override> overrides_of(const RunOptions& options) {
  std::vector<Override> overrides = of_set(options.flight.settings);
  if (!options.policy.empty()) {
    overrides.push_back({"governor.policy=" + options.policy, "--policy"});
  }
  if (!options.seed.empty()) {
    overrides.push_back({"seed=" + options.seed, "--seed"});
  }
  return overrides;
}

/// @param notice  Told of each step; outlives the flight.
MissionHooks hooks_of(const Scenario& scenario, ServiceNotice& notice) {
  MissionHooks hooks;
  hooks.stop = [&notice] {
    notice.step();
    return was_interrupted();
  };
  hooks.over = [&notice] { notice.end(); };
  if (has_watcher()) {
    const std::string who = scenario.governor.policy + " seed " + std::to_string(scenario.seed);
    hooks.progress = [who](double mission_s, const std::string& what) {
      note(who + ": " + with_unit(mission_s, 0, "s") + ", " + what);
    };
  }
  return hooks;
}

int exit_code_of(const Summary& summary) {
  switch (summary.status) {
    case MissionStatus::succeeded:
      return exit_success;
    case MissionStatus::failed:
      return exit_mission_failed;
    case MissionStatus::interrupted:
      return interrupted_exit_code();
  }
  return exit_mission_failed;
}

/// Null when no record is asked for. A simulated flight waits for its record, a real one does not.
Result<std::unique_ptr<OnboardRecord>> open_record(const RunOptions& options,
                                                   const Scenario& scenario) {
  if (options.mcap.empty()) {
    return std::unique_ptr<OnboardRecord>{};
  }
  const bool is_simulated = options.executor.executor == "virtual";
  return OnboardRecord::open(options.mcap, is_simulated ? WhenFull::wait : WhenFull::drop,
                             {{"flyball.mission",
                               {{"scenario", mission_file(scenario)},
                                {"policy", scenario.governor.policy},
                                {"seed", std::to_string(scenario.seed)},
                                {"version", version()}}}});
}

/// One thing that is written may not be another one.
Status keep_outputs_apart(const RunOptions& options, const std::string& folder) {
  std::error_code ignored;
  const fs::path record =
      fs::weakly_canonical(fs::absolute(fs::path{folder} / "mission.toml"), ignored);
  std::vector<fs::path> written;
  for (const std::string& output : {options.mcap, options.timeline, options.final_map}) {
    const bool is_device = fs::exists(output, ignored) && !fs::is_regular_file(output, ignored);
    if (output.empty() || is_device) {
      continue;
    }
    const fs::path place = fs::weakly_canonical(fs::absolute(output), ignored);
    const bool is_in_record =
        place.parent_path() == record.parent_path() && is_of_record(place.filename().string());
    if (is_in_record || std::find(written.begin(), written.end(), place) != written.end()) {
      return Error{ErrorCode::invalid_input,
                   "\"" + output + "\" would be written twice; choose another place for it"};
    }
    written.push_back(place);
  }
  return Done{};
}

/// Of all that the flight reads and writes.
Status check_places(const RunOptions& options,
                    const Scenario& scenario,
                    const std::string& folder) {
  const Status inputs = keep_inputs(scenario, {options.flight.scenario, options.start_map},
                                    {options.mcap, options.timeline, options.final_map,
                                     (fs::path{folder} / "mission.toml").string()});
  for (const Status& kept : {inputs, keep_outputs_apart(options, folder)}) {
    if (!kept) {
      return kept;
    }
  }
  return options.timeline.empty() ? Done{} : check_place(options.timeline);
}

/// Ends the record, and says in the summary what is in it.
Status close_record(OnboardRecord* record, Summary& summary) {
  if (record == nullptr) {
    return Done{};
  }
  Status closed = record->close();
  const RecordCounts counts = record->counts();
  summary.quality["record_rows"] = static_cast<double>(counts.written);
  summary.quality["record_rows_dropped"] = static_cast<double>(counts.dropped);
  return closed;
}

/// What the flight leaves, to every place that was asked for.
Status write_all(const RunOptions& options,
                 const std::string& folder,
                 const Scenario& scenario,
                 const MissionRecord& record,
                 const Timeline& timeline) {
  if (Status written = write_run(folder, scenario, record); !written) {
    return written;
  }
  return options.timeline.empty() ? Done{} : write_file(options.timeline, timeline.bytes());
}

/// What of the flight is real.
struct Hardware {
  RealComputer& computer;
  AutopilotLink* autopilot{};   ///< Null: the vehicle is simulated.
  DepthSource* depth_camera{};  ///< Null: its images are drawn.
};

/// @param made  Folders that are of no use when nothing flies.
int fly_into(const std::string& folder,
             const std::vector<std::string>& made,
             const RunOptions& options,
             const Scenario& scenario,
             const Hardware& hardware) {
  RealComputer& computer = hardware.computer;
  RecordPlace place{options.mcap};
  auto onboard_record = open_record(options, scenario);
  if (!onboard_record) {
    computer.close();
    remove_empty(made);
    return refuse({onboard_record.error()});
  }
  ServiceNotice notice;
  MissionHooks hooks = hooks_of(scenario, notice);
  hooks.start_map = options.start_map;
  hooks.final_map = options.final_map;
  Timeline timeline;
  hooks.timeline = options.timeline.empty() ? nullptr : &timeline;
  hooks.onboard_record = onboard_record->get();
  hooks.autopilot = hardware.autopilot;
  hooks.depth_camera = hardware.depth_camera;
  computer.equip(hooks);
  Result<MissionRecord> record = fly(scenario, hooks);
  computer.close();
  if (!record) {
    onboard_record->reset();
    remove_empty(made);
    const int refused = refuse({record.error()});
    return was_interrupted() ? interrupted_exit_code() : refused;
  }
  place.keep();
  const Status recorded = close_record(onboard_record->get(), record->summary);
  const Status written = write_all(options, folder, scenario, *record, timeline);
  print(options.flight.json ? to_json(record->summary) + "\n"
                            : result_text(record->summary, written ? folder : ""));
  for (const std::string& sentence : tracking_remarks(record->summary, scenario)) {
    remark(sentence);
  }
  if (was_interrupted()) {
    note("interrupted; the record ends early: " + folder);
  }
  std::vector<Error> lost;
  for (const Status& one : {written, recorded, record->map_file}) {
    if (!one) {
      lost.push_back(one.error());
    }
  }
  return lost.empty() ? exit_code_of(record->summary) : refuse(lost);
}

int run(const RunOptions& options) {
  std::string told;
  const auto loaded = load_to_fly(options.flight.scenario, overrides_of(options),
                                  options.flight.plugins, options.autopilot, told);
  if (const auto* errors = std::get_if<std::vector<Error>>(&loaded)) {
    return refuse(*errors);
  }
  const auto& scenario = std::get<Scenario>(loaded);
  const std::string folder = options.flight.out.empty()
                                 ? run_folder(comparison_folder(options.flight, scenario),
                                              scenario.governor.policy, scenario.seed)
                                 : options.flight.out;
  if (const Status possible = check_places(options, scenario, folder); !possible) {
    return refuse({possible.error()});
  }
  PolicyRemarks{}.add(scenario, overrides_of(options));
  const auto platform = find_platform(scenario.platform.name);
  if (!platform) {
    return refuse({platform.error()});
  }
  auto autopilot = open_autopilot(options.autopilot, options.executor);
  if (!autopilot) {
    return refuse({autopilot.error()});
  }
  auto computer = RealComputer::open(options.executor, *platform);
  if (!computer) {
    return refuse({computer.error()});
  }
  auto depth_camera = open_depth_camera(options.depth_camera, scenario.camera);  // With a thread.
  if (!depth_camera) {
    (*computer)->close();
    return refuse({depth_camera.error()});
  }
  if (!told.empty()) {
    remark(told);
  }
  catch_interrupt();  // A flight can be ended as soon as anything of it shows.
  const auto claimed = ClaimedFolder::claim(folder);
  if (!claimed) {
    const int refused = refuse({claimed.error()});
    return was_interrupted() ? interrupted_exit_code() : refused;
  }
  return fly_into(folder, claimed->made(), options, scenario,
                  {**computer, autopilot->get(), depth_camera->get()});
}

}  // namespace

void add_run(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("run", "flies one mission");
  const auto options = std::make_shared<RunOptions>();  // Owners: the parser's callbacks.
  add_scenario(*command, options->flight);
  refuse_empty(
      *command
           ->add_option(
               "--policy", options->policy,
               "changes knobs in flight: a name from `flyball list policies`, or a file (.toml, "
               ".lua, .so); default: the scenario's")
           ->type_name("NAME"));
  refuse_empty(*command
                    ->add_option("--seed", options->seed,
                                 "seed of world, sensors and planner; default: the scenario's")
                    ->type_name("N"));
  refuse_empty(*command
                    ->add_option("--start-map", options->start_map,
                                 "an OctoMap file, .bt or .ot, that is known at take-off")
                    ->type_name("FILE"));
  refuse_empty(*command
                    ->add_option("--map", options->final_map,
                                 "writes the map that the flight made, .bt or .ot")
                    ->type_name("FILE"));
  refuse_empty(*command
                    ->add_option("--timeline", options->timeline,
                                 "writes when each job ran, for ui.perfetto.dev")
                    ->type_name("FILE"));
  refuse_empty(*command
                    ->add_option("--mcap", options->mcap,
                                 "writes poses, map, path, knobs, decisions, jobs and power while "
                                 "it flies, for Foxglove")
                    ->type_name("FILE"));
  add_executor(*command, options->executor);
  add_autopilot(*command, options->autopilot);
  add_depth_camera(*command, options->depth_camera);
  add_output(*command, options->flight);
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace flyball
