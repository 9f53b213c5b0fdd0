// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A computer that is not, or no longer, what its file says.

#include "flyball/runtime/platform.h"

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace flyball {

/// What keeps a computer from being what its file says. By default nothing does.
struct Strain {
  double cost{1.0};  ///< Every kernel takes so many times what the file says.
  std::map<std::string, double, std::less<>> kernel_cost{};  ///< Times this, of single ones.
  double memory_cost{1.0};  ///< Of the share of each kernel that waits for memory; b of KernelCost.
  double taken_cores{};     ///< Busy with somebody else's work.
  std::optional<Hertz> clock_cap{};  ///< Higher clocks are not granted.
};

/// A model under strain, which may change in flight. Whoever changes it tells the executor
/// (`platform_changed`). What work costs may be asked by any thread meanwhile; `strain`, `granted`
/// and `taken_cores` are for the thread that changes it.
class DriftingPlatform final : public Platform {
 public:
  explicit DriftingPlatform(const PlatformModel& nominal);

  /// @pre All costs are positive, `taken_cores` is not negative.
  void set(const Strain& strain);
  [[nodiscard]] const Strain& strain() const { return strain_; }
  [[nodiscard]] const PlatformModel& nominal() const { return nominal_; }

  [[nodiscard]] const std::string& name() const override { return nominal_.name; }
  [[nodiscard]] const std::vector<Hertz>& frequencies() const override {
    return nominal_.frequencies;
  }
  [[nodiscard]] int max_cores() const override { return nominal_.max_cores; }
  [[nodiscard]] Duration job_time(std::string_view kernel,
                                  const Work& work,
                                  Hertz frequency) const override {
    return now()->job_time(kernel, work, frequency);
  }
  [[nodiscard]] double speedup(std::string_view kernel, double cores) const override {
    return now()->speedup(kernel, cores);
  }
  [[nodiscard]] bool knows(std::string_view kernel) const override { return now()->knows(kernel); }
  [[nodiscard]] Watts power(const OperatingPoint& point, double busy_cores) const override {
    return now()->power(point, busy_cores);
  }
  [[nodiscard]] bool runs_on_gpu(std::string_view kernel) const override {
    return now()->runs_on_gpu(kernel);
  }
  [[nodiscard]] Watts gpu_power() const override { return now()->gpu_power(); }
  [[nodiscard]] double slowdown(std::string_view kernel,
                                Hertz clock,
                                double other_cores) const override {
    return now()->slowdown(kernel, clock, other_cores);
  }
  [[nodiscard]] Duration switching_time() const override { return nominal_.switching_time; }
  [[nodiscard]] OperatingPoint granted(const OperatingPoint& wanted) const override;
  [[nodiscard]] double taken_cores() const override { return strain_.taken_cores; }

 private:
  [[nodiscard]] std::shared_ptr<const ModeledPlatform> now() const;

  PlatformModel nominal_;
  Strain strain_{};
  mutable std::mutex mutex_{};  ///< Of the pointer `now_`.
  /// The nominal model with the strain worked in. Owners: this, and who is asking it.
  std::shared_ptr<const ModeledPlatform> now_;
};

}  // namespace flyball
