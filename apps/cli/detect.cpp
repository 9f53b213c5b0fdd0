// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/recordings/detection_run.h"
#include "flyball/records/text_table.h"

#include "commands.h"
#include "console.h"
#include "flight_options.h"
#include <cstdlib>
#include <memory>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct DetectOptions {
  DetectionRun run{};
  std::vector<std::string> settings{};
  bool json{};
};

/// `threshold=0.5` or `model=yolo-fastest-1.1-xl`: the detector itself says what it has.
Status add_setting(DetectionRun& run, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == setting.size()) {
    return Error{ErrorCode::invalid_input,
                 "--set " + setting + " is not NAME=VALUE; for example: --set threshold=0.5"};
  }
  const std::string text = setting.substr(equals + 1);
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const bool is_number = *end == '\0';
  run.parameters[setting.substr(0, equals)] =
      is_number ? ParameterValue{number} : ParameterValue{text};
  return Done{};
}

std::string line_of(const DetectedFrame& frame) {
  std::string text = frame.file + (frame.frame > 0 ? " frame " + std::to_string(frame.frame) : "") +
                     ": " + std::to_string(frame.people.size()) +
                     (frame.people.size() == 1 ? " person, " : " people, ") +
                     rounded(frame.host_ms, 0) + " ms\n";
  for (const Detection& person : frame.people) {
    text += "  at " + rounded(person.box.x_px, 0) + ", " + rounded(person.box.y_px, 0) + ", " +
            rounded(person.box.width_px, 0) + " x " + rounded(person.box.height_px, 0) +
            " px, score " + rounded(person.score, 2) + "\n";
  }
  return text;
}

std::string counted(std::uint64_t count, const std::string& one, const std::string& more) {
  return std::to_string(count) + " " + (count == 1 ? one : more);
}

std::string line_of(const DetectionTotals& totals) {
  return counted(totals.frames, "picture", "pictures") + ", " + std::to_string(totals.with_people) +
         " with people, " + counted(totals.people, "person", "people") + " in all; " +
         std::to_string(totals.unreadable) + " could not be read\n";
}

/// What cannot be read is told on standard error too, where it is seen beside many results.
void show(const DetectedFrame& frame, bool json) {
  if (!frame.trouble.empty()) {
    remark(frame.trouble);
  }
  if (json) {
    print(to_json(frame) + "\n");
  } else if (frame.trouble.empty()) {
    print(line_of(frame));
  }
}

int detect(DetectOptions& options) {
  for (const std::string& setting : options.settings) {
    if (const Status added = add_setting(options.run, setting); !added) {
      return refuse({added.error()});
    }
  }
  catch_interrupt();
  DetectionTotals totals;
  const Status done = run_detection(options.run, [&](const DetectedFrame& frame) {
    show(frame, options.json);
    totals.add(frame);
    return !was_interrupted();
  });
  if (!done) {
    return refuse({done.error()});
  }
  if (totals.frames + totals.unreadable > 1 || totals.unreadable > 0) {
    print(options.json ? to_json(totals) + "\n" : line_of(totals));
  }
  if (was_interrupted()) {
    return interrupted_exit_code();
  }
  return totals.unreadable > 0 ? exit_mission_failed : exit_success;
}

}  // namespace

void add_detect(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("detect", "looks for people in pictures or video from files");
  const auto options = std::make_shared<DetectOptions>();  // Owners: the parser's callbacks.
  DetectionRun& run = options->run;
  refuse_empty(
      *command->add_option("INPUT", run.input, "a picture, a video or a folder of pictures")
           ->required());
  refuse_empty(*command
                    ->add_option("--detector", run.detector,
                                 "one of the detectors that `flyball list kernels` names")
                    ->type_name("NAME"));
  command->add_option("--scale", run.scale, "size of the analysed picture over that of the file")
      ->check(CLI::Range(0.05, 8.0));
  refuse_empty(*command->add_option("--set", options->settings, "parameter of the detector")
                    ->type_name("NAME=VALUE")
                    ->expected(1)
                    ->take_all());
  refuse_empty(
      *command
           ->add_option("--models", run.models_folder, "folder that is searched first for weights")
           ->type_name("DIR"));
  command->add_option("--every", run.every, "analyses every Nth frame of a video")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1000000}));
  refuse_empty(
      *command->add_option("--out", run.out, "writes pictures with boxes there")->type_name("DIR"));
  command->add_flag("--json", options->json, "one JSON object a line");
  add_kernels(*command, run.plugins);
  command->callback([options, &exit_code] { exit_code = detect(*options); });
}

}  // namespace flyball
