// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A detector on real pictures and video: what `flyball detect` does.

#include "flyball/kernels/detector.h"
#include "flyball/scenario/plugins.h"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace flyball {

struct DetectionRun {
  std::string input;  ///< A picture, a video, or a folder of pictures.
  Plugins plugins{};  ///< With the detector.
  std::string detector{"hog"};
  std::map<std::string, ParameterValue> parameters{};
  double scale{1.0};
  std::string models_folder{"shipped"};
  std::string out{};       ///< Folder for pictures with boxes; empty: none are written.
  std::uint64_t every{1};  ///< Of a video's frames.
};

struct DetectedFrame {
  std::string file;
  std::uint64_t frame{};
  std::vector<Detection> people{};
  Work work{};
  double host_ms{};
  std::string picture{};  ///< The file that was written, if one was.
  std::string trouble{};  ///< Why a picture of a folder cannot be read; empty: it was looked at.
};

/// What a run came to.
struct DetectionTotals {
  std::uint64_t frames{};  ///< Looked at.
  std::uint64_t with_people{};
  std::uint64_t people{};
  std::uint64_t unreadable{};

  void add(const DetectedFrame& frame);
};

/// Looks at each picture and hands the result to `report`, which returns false to stop. A picture
/// of a folder that cannot be read is reported as such, and the next one follows.
///
/// @error No such detector, parameter, model, file; a picture that cannot be written; a single one
///        that cannot be read. What was reported before stays.
[[nodiscard]] Status run_detection(const DetectionRun& run,
                                   const std::function<bool(const DetectedFrame&)>& report);

/// One object without line breaks.
[[nodiscard]] std::string to_json(const DetectedFrame& frame);
[[nodiscard]] std::string to_json(const DetectionTotals& totals);

}  // namespace flyball
