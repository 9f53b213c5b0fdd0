// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// An upper bound on latency that is right as often as it was asked to be.

#include "flyball/runtime/time.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace flyball {

/// Tracks the (1 - alpha) quantile q of e = log(measured / predicted) and bounds the next latency
/// by predicted * exp(q). For each decision one indicator m_t = 1[e_t > q_t], and
///
///     q_{t+1} = q_t + eta (m_t - alpha)                                              (1)
///
/// Summed over T decisions (1) telescopes, whatever made the e_t (feedback through the vehicle's
/// speed, drift, an adversary):
///
///     mean miss = alpha + (q_{T+1} - q_1) / (eta T)                                  (2)
///
/// That is an identity. If e <= B then q cannot run away: a decision issued with q >= B cannot
/// miss, so q passes B by at most eta (1 - alpha), and from there on it falls until it is below B
/// again. Hence q_{T+1} <= B + eta and
///
///     mean miss <= alpha + (B + eta - q_1) / (eta T)                                 (3)
///
/// pathwise, for fixed eta and alpha, while one decision is open at a time: the bound of Gibbs and
/// Candes (Adaptive conformal inference, NeurIPS 2021, prop. 4.1) for this update. It is a mean
/// over time, not a guarantee for the next decision. A job that is killed has no e <= B: then (2)
/// still holds, (3) does not.
class QuantileTracker {
 public:
  struct Settings {
    double alpha{0.05};  ///< Share of misses asked for, in (0, 1).
    double eta{0.05};   ///< Step in log latency; 0: q stays, a constant margin without (2) and (3).
    double first{0.2};  ///< q_1: a margin of 22 % until something is known.
  };

  explicit QuantileTracker(const Settings& settings);
  [[nodiscard]] double q() const { return q_; }
  [[nodiscard]] double factor() const;
  /// Eq. (1).
  void count(bool missed);
  [[nodiscard]] std::uint64_t decisions() const { return decisions_; }
  [[nodiscard]] std::uint64_t misses() const { return misses_; }
  /// What eq. (3) allows by now, if no latency is more than `worst` times the predicted one; empty
  /// where q stays. @pre `worst > 0`.
  [[nodiscard]] std::optional<double> most_misses(double worst) const;

 private:
  Settings settings_;
  double q_;
  std::uint64_t decisions_{};
  std::uint64_t misses_{};
};

/// One tracker for each level (of map resolution), and the decision whose job is still out. Exactly
/// one indicator for each issued decision, declared when the bound expires: a job that comes late,
/// is killed or superseded is a miss at that moment, and its end changes nothing more. (Counting
/// ended jobs only would drop the worst ones: the bound would look right and be wrong.) Nothing
/// allocates after construction.
class LatencyBound {
 public:
  /// @param levels  Trackers, at least 1.
  LatencyBound(std::size_t levels, const QuantileTracker::Settings& settings);

  /// predicted * exp(q of the level). @pre `level < levels()`, `predicted > 0`.
  [[nodiscard]] Duration bound(std::size_t level, Duration predicted) const;
  /// A decision whose latency was predicted, at the clock and cores it asked for. The one before
  /// it, if still open, is superseded.
  void issue(std::size_t level, MissionTime now, Duration predicted);
  // The calls below are about the open decision, and do nothing when there is none.
  /// The platform granted something else: the prediction becomes `factor` times the one issued, and
  /// the bound moves with it. @pre `factor > 0`.
  void regrant(double factor);
  /// The setting has changed while the job is out, and the job may have begun under either one: the
  /// longer of the two bounds counts, at its own level. @pre As of `issue`.
  void widen(std::size_t level, Duration predicted);
  /// The job ended; a hit if it did so before its bound expired. A job that was killed is not
  /// settled: it expires.
  void settle(MissionTime ended);
  /// Declares the miss if the bound has expired by `now`. Call before each decision.
  void expire(MissionTime now);

  [[nodiscard]] std::size_t levels() const { return trackers_.size(); }
  [[nodiscard]] const QuantileTracker& tracker(std::size_t level) const { return trackers_[level]; }

 private:
  struct Open {
    std::size_t level{};
    MissionTime issued{};
    double bound_s{};
    double factor{1.0};
    [[nodiscard]] MissionTime expires() const;
  };
  void close(bool missed);

  std::vector<QuantileTracker> trackers_;
  std::optional<Open> open_{};
};

}  // namespace flyball
