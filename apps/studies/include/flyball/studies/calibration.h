// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Measures what kernels cost on the computer that runs this, so that a simulated flight takes the
/// time that the same flight takes there.

#include "flyball/runtime/platform.h"
#include "flyball/runtime/result.h"

#include <functional>
#include <string>
#include <vector>

namespace flyball {

/// One job of a kernel.
struct MeasuredJob {
  std::string kernel{};
  Work work{};
  double cpu_s{};  ///< CPU time of the thread that ran it.
  Hertz clock{};   ///< Of its core.
};

/// The whole computer, while it did nothing else.
struct MeasuredPower {
  Hertz clock{};
  double busy_cores{};
  Watts power{};
};

/// How well a price list fits one kernel.
struct KernelCheck {
  std::string kernel{};
  std::size_t fitted_jobs{};   ///< 0: never called. Its prices are the old ones, scaled.
  double fitted_ms{};          ///< Mean of these jobs.
  std::size_t checked_jobs{};  ///< Of flights that the prices were not fitted on.
  double checked_ms{};         ///< Mean of these jobs, measured ...
  double predicted_ms{};       ///< ... and predicted.
  double checked_error{};      ///< Median of the relative errors of single jobs.
};

/// At which clocks the flights are flown.
struct ClockChoice {
  Hertz current{};                     ///< Of the core that runs this.
  std::vector<Hertz> settable{};       ///< Ascending; none: the clock stays as it is.
  std::function<Status(Hertz)> set{};  ///< For one of these.
};

/// A scenario, and settings on top of it (`KEY=VALUE`).
struct CalibrationFlight {
  std::string scenario{};
  std::vector<std::string> settings{};
};

/// The five workloads, the other planners, localizers and detectors, and several cell sizes, which
/// tell the prices of a ray, a cell and an update apart.
[[nodiscard]] std::vector<CalibrationFlight> calibration_flights();

struct CalibrationOptions {
  std::string like{};   ///< Platform file that says which kernels there are, of what operations.
  std::string draft{};  ///< A file that may be written meanwhile and is gone afterwards.
  int cores{1};
  std::vector<CalibrationFlight> flights{calibration_flights()};
  double flight_s{20.0};  ///< Mission time of each flight.
  ClockChoice clock{};
  std::function<void(const std::string& what)> progress{};  ///< May be empty.
  std::function<bool()> stop{};                             ///< True: it ends as `unavailable`.
};

struct Calibration {
  PlatformModel model{};
  std::vector<KernelCheck> kernels{};
  /// CPU time of threads other than the one that ran the kernels, over its own: how far "a kernel
  /// runs on one core" is from the truth.
  double other_threads{};
  /// A sentence for each scenario that needs a file that is not here, such as people to look for.
  std::vector<std::string> left_out{};
};

/// Flies in simulated time, two rounds at each clock, so that the second has the work that this
/// computer would see, and then another seed to check.
/// @error `not_found` (the platform file; all scenarios need files that are not here),
///        `invalid_input` (the platform file, a scenario), `unavailable` (stopped),
///        those of `ClockChoice::set`.
[[nodiscard]] Result<Calibration> calibrate(const CalibrationOptions& options);

/// `like` with the prices of what was measured: c_i by `non_negative_fit` at the highest clock, a
/// and b by least squares over the clocks, where there is more than one. All other kernels are
/// scaled by the geometric mean of the ratios.
[[nodiscard]] PlatformModel with_prices(const PlatformModel& like,
                                        const std::vector<MeasuredJob>& jobs);

/// What `model` says of jobs that it was fitted on, and of others. By name.
[[nodiscard]] std::vector<KernelCheck> check_prices(const PlatformModel& model,
                                                    const std::vector<MeasuredJob>& fitted,
                                                    const std::vector<MeasuredJob>& others);

/// `cpu_constant_w + cpu_linear_w f + n (core_linear_w f + core_cubic_w f^3)`, of the whole
/// computer's input. What only several clocks could tell apart is one of the two.
/// @pre  There are samples with different numbers of busy cores.
[[nodiscard]] PowerCost fitted_power(const std::vector<MeasuredPower>& samples);

/// For a terminal.
[[nodiscard]] std::string to_text(const Calibration& calibration);

/// A platform file. @param remarks  Lines without `#` for its head.
[[nodiscard]] std::string to_toml(const PlatformModel& model,
                                  const std::vector<std::string>& remarks);

}  // namespace flyball
