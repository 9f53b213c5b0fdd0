// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/recordings/detection_run.h"

#include "flyball/records/pictures.h"
#include "flyball/records/report.h"

#include "scenario/kernel_choice.h"
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <set>

#include <nlohmann/json.hpp>

namespace flyball {
namespace {

namespace fs = std::filesystem;

constexpr Rgb box_colour{255, 40, 40};

Result<std::unique_ptr<Detector>> detector_of(const DetectionRun& run) {
  Scenario scenario;
  scenario.plugins = run.plugins;
  scenario.kernels.detector = run.detector;
  scenario.kernels.detector_parameters = run.parameters;
  scenario.detector.models_folder = run.models_folder;
  return make_kernel<Detector>(scenario.plugins, scenario.kernels, model_finder(scenario));
}

/// `vtest_000040.png`: of a video each frame has its own file.
std::string picture_name(const Picture& picture) {
  char number[24];
  std::snprintf(number, sizeof number, "_%06llu.png",
                static_cast<unsigned long long>(picture.frame));
  const fs::path file{picture.file};
  return file.stem().string() + (picture.frame > 0 ? number : ".png");
}

/// Its name among those that are written already: a folder may hold `a.jpg` beside `a.png`.
std::string free_name(const Picture& picture, std::set<std::string>& written) {
  std::string name = picture_name(picture);
  const fs::path file{name};
  for (int number = 2; !written.insert(name).second; ++number) {
    name = file.stem().string() + "_" + std::to_string(number) + ".png";
  }
  return name;
}

/// Pictures with boxes have the names of those without.
Status keep_input(const DetectionRun& run) {
  const fs::path input{run.input};
  std::error_code ignored;
  const fs::path folder =
      fs::is_directory(input, ignored) ? input : fs::absolute(input).parent_path();
  if (fs::equivalent(folder, run.out, ignored)) {
    return Error{ErrorCode::invalid_input, "--out \"" + run.out + "\" is where the pictures of \"" +
                                               run.input +
                                               "\" are, which would be overwritten; choose another "
                                               "folder"};
  }
  return Done{};
}

Result<std::string> write_picture(const DetectionRun& run,
                                  Picture picture,
                                  const std::vector<Detection>& people,
                                  std::set<std::string>& written_names) {
  for (const Detection& person : people) {
    draw_box(picture.image, person.box, box_colour);
  }
  const auto content = png_of(picture.image);
  if (!content) {
    return content.error();
  }
  const std::string path = (fs::path{run.out} / free_name(picture, written_names)).string();
  const Status written = write_file(path, *content);
  return written ? Result<std::string>{path} : written.error();
}

Result<DetectedFrame> look(const DetectionRun& run,
                           Detector& detector,
                           Picture picture,
                           std::set<std::string>& written_names) {
  DetectedFrame frame{picture.file, picture.frame, {}, {}, 0.0, {}, std::move(picture.trouble)};
  if (!frame.trouble.empty()) {
    return frame;
  }
  const auto begun = std::chrono::steady_clock::now();
  auto people = detector.detect(picture.image, run.scale, frame.work);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begun;
  if (!people) {
    return people.error();
  }
  frame.host_ms = took.count();
  frame.people = std::move(*people);
  if (!run.out.empty()) {
    auto written = write_picture(run, std::move(picture), frame.people, written_names);
    if (!written) {
      return written.error();
    }
    frame.picture = std::move(*written);
  }
  return frame;
}

Status look_at_all(const DetectionRun& run,
                   Detector& detector,
                   PictureReader& pictures,
                   const std::function<bool(const DetectedFrame&)>& report) {
  std::error_code failed;
  const bool is_folder = fs::is_directory(run.input, failed);
  std::set<std::string> written_names;
  while (true) {
    auto picture = pictures.next();
    if (!picture) {
      return picture.error();
    }
    if (!picture->has_value()) {
      return Done{};
    }
    if ((*picture)->frame % run.every != 0) {
      continue;
    }
    const auto frame = look(run, detector, std::move(**picture), written_names);
    if (!frame) {
      return frame.error();
    }
    if (!frame->trouble.empty() && !is_folder) {
      return Error{ErrorCode::invalid_input, frame->trouble};
    }
    if (!report(*frame)) {
      return Done{};
    }
  }
}

}  // namespace

Status run_detection(const DetectionRun& run,
                     const std::function<bool(const DetectedFrame&)>& report) {
  auto detector = detector_of(run);
  if (!detector) {
    return detector.error();
  }
  auto pictures = open_pictures(run.input);
  if (!pictures) {
    return pictures.error();
  }
  if (!run.out.empty()) {
    if (Status kept = keep_input(run); !kept) {
      return kept;
    }
    if (const auto prepared = prepare_folder(run.out); !prepared) {
      return prepared.error();
    }
  }
  return look_at_all(run, **detector, **pictures, report);
}

void DetectionTotals::add(const DetectedFrame& frame) {
  if (!frame.trouble.empty()) {
    ++unreadable;
    return;
  }
  ++frames;
  with_people += frame.people.empty() ? 0 : 1;
  people += frame.people.size();
}

std::string to_json(const DetectionTotals& totals) {
  return nlohmann::ordered_json{{"totals",
                                 {{"frames", totals.frames},
                                  {"with_people", totals.with_people},
                                  {"people", totals.people},
                                  {"unreadable", totals.unreadable}}}}
      .dump();
}

std::string to_json(const DetectedFrame& frame) {
  nlohmann::ordered_json line{{"file", frame.file}, {"frame", frame.frame}};
  if (!frame.trouble.empty()) {
    line["trouble"] = frame.trouble;
    return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  }
  line["people"] = nlohmann::ordered_json::array();
  for (const Detection& person : frame.people) {
    line["people"].push_back({{"x_px", person.box.x_px},
                              {"y_px", person.box.y_px},
                              {"width_px", person.box.width_px},
                              {"height_px", person.box.height_px},
                              {"score", person.score}});
  }
  for (const WorkItem& item : frame.work.items()) {
    line["work"][std::string{item.name}] = item.count;
  }
  line["host_ms"] = frame.host_ms;
  if (!frame.picture.empty()) {
    line["picture"] = frame.picture;
  }
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace flyball
