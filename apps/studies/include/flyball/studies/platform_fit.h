// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Brings a platform file's kernel times to those that the MAVBench paper measured on a Jetson TX2:
/// one scale per kernel, fitted on a recorded delivery.

#include "flyball/runtime/platform.h"

#include <string>
#include <vector>

namespace flyball {

/// One kernel with a figure in the paper.
struct KernelFit {
  std::string kernel{};
  int calls{};
  Work mean_work{};   ///< Per call.
  double model_ms{};  ///< Of the mean work, with the file's scale, at the paper's clock.
  double paper_ms{};
  double scale{};         ///< In the file.
  double fitted_scale{};  ///< With which `model_ms` would be `paper_ms`.
};

/// A prediction for a kernel on other work than it was fitted on.
struct KernelPrediction {
  std::string kernel{};
  std::string scene{};
  double model_ms{};
  double paper_ms{};
};

struct PlatformFit {
  std::string platform{};
  std::vector<KernelFit> kernels{};
  std::vector<KernelPrediction> predictions{};
  /// Modeled time of one frame in the mapper at .15 m over that at .98 m, without and with
  /// MAVBench's fixed cost per frame.
  double resolution_ratio{};
  double resolution_ratio_with_fixed_cost{};

  /// Whether every scale is within 2 % of its fit.
  [[nodiscard]] bool is_in_step() const;
};

/// Runs the kernels on the four scenes and compares with the paper. Takes some seconds.
///
/// @param name_or_path  `jetson_tx2`, or a platform file.
/// @error `not_found`, `invalid_input` (the file, or a kernel without a price in it), `failed`.
[[nodiscard]] Result<PlatformFit> fit_platform(const std::string& name_or_path);

/// Tables for a terminal, and the lines to paste into the platform file.
[[nodiscard]] std::string to_text(const PlatformFit& fit);

}  // namespace flyball
