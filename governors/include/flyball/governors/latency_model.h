// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// How long a kernel will take, learned in flight.

#include "flyball/governors/recursive_least_squares.h"
#include "flyball/runtime/time.h"
#include "flyball/runtime/units.h"

#include <cstddef>
#include <vector>

namespace flyball {

/// Time of one unit of work at a clock: a / f_GHz + b, where b is the part that waits for memory.
/// The defaults are chosen: at 1 GHz a twentieth of the time.
struct ClockScaling {
  double a{0.9};
  double b{0.05};
  /// @pre `clock > 0`.
  [[nodiscard]] double factor(Hertz clock) const { return a / (clock.value() * 1e-9) + b; }
};

/// What a job's duration depends on.
struct LatencyFeatures {
  double size{1.0};  ///< Of the input, in any unit: metres of range, points.
  Hertz clock{1e9};
};

/// What is known before the first sample: t = seconds * size^slope * (a / f + b). Wrong by `sigma`
/// (in log).
struct LatencyPrior {
  double seconds{0.1};  ///< At size 1 and a factor of the clock of 1.
  double slope{1.0};
  ClockScaling clock{};
  double sigma{1.0};
};

/// One kernel at one size of cells: recursive least squares on the logarithm,
///
///     log t = w0 + w1 log size + w2 log(a / f_GHz + b) + g
///
/// g is the slowdown that all kernels share (see `LatencyModels`). Nothing allocates after
/// construction.
class LatencyModel {
 public:
  explicit LatencyModel(const LatencyPrior& prior);

  /// Natural logarithm of the duration in seconds. @pre Every feature is above zero.
  [[nodiscard]] double predict_log_s(const LatencyFeatures& features) const;
  /// Learns from log seconds, maybe with something taken off (the slowdown that all share).
  /// @pre Every feature is above zero.
  void learn_log_s(const LatencyFeatures& features, double log_s);

 private:
  using Solver = RecursiveLeastSquares<3>;
  [[nodiscard]] Solver::Vector row(const LatencyFeatures& features) const;

  ClockScaling clock_;
  Solver solver_;
};

/// The kernels of a pipeline, and one slowdown factor for all of them: a hot computer, or a
/// neighbour that takes the memory, slows everything, and what one kernel shows the others need not
/// learn again. The factor follows the residual quickly, g <- g + gain (residual), the weights
/// slowly, with what g explains taken off. Two residuals in a row above `surprise` on the same side
/// are no chance: g takes at once what both of them show. A kernel moves g only after its first
/// samples, because until then its residual is the error of its own prior.
class LatencyModels {
 public:
  static constexpr double slowdown_gain = 0.1;
  static constexpr double surprise = 0.4;  ///< Chosen: nearly three times the noise of a sample.
  static constexpr int first_samples = 3;  ///< Chosen.

  /// The next kernel; the first one is number 0.
  void add(const LatencyPrior& prior) { kernels_.push_back({LatencyModel{prior}}); }
  [[nodiscard]] std::size_t size() const { return kernels_.size(); }
  /// @pre `kernel < size()`.
  [[nodiscard]] double predict_s(std::size_t kernel, const LatencyFeatures& features) const;
  void learn(std::size_t kernel, const LatencyFeatures& features, Duration measured);

 private:
  struct Kernel {
    LatencyModel model;
    int samples{};
  };
  [[nodiscard]] double slowdown_step(double residual);

  std::vector<Kernel> kernels_;
  double log_slowdown_{};
  double residual_{};  ///< Of the last sample, in log seconds.
};

}  // namespace flyball
