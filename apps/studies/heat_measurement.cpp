// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/studies/heat_measurement.h"

#include "studies/busy_cores.h"
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <thread>

#include <Eigen/QR>

namespace flyball {
namespace {

constexpr double least_change_k = 3.0;  // Chosen: three steps of a sensor that tells whole degrees.
constexpr double fineness = 1.02;       // Chosen: a time constant is fitted to a hundredth.

/// The best fit with one time constant.
struct OneTimeConstant {
  double time_constant_s{};
  Eigen::Vector3d air_resistance_start{Eigen::Vector3d::Zero()};
  Eigen::VectorXd error_k{};
  [[nodiscard]] double square() const { return error_k.squaredNorm(); }
};

OneTimeConstant fit_with(double time_constant_s, const std::vector<HeatSample>& samples) {
  const auto n = static_cast<Eigen::Index>(samples.size());
  Eigen::MatrixX3d response{n, 3};
  Eigen::VectorXd temperature_c{n};
  double of_start = 1.0;  // What is left of the temperature at the beginning,
  double of_power = 0.0;  // and the power as the heat capacity smooths it [W].
  for (Eigen::Index i = 0; i < n; ++i) {
    const HeatSample& sample = samples[static_cast<std::size_t>(i)];
    const double before_s = i > 0 ? samples[static_cast<std::size_t>(i - 1)].t_s : sample.t_s;
    const double kept = std::exp(-(sample.t_s - before_s) / time_constant_s);
    of_start *= kept;
    of_power = kept * of_power + (1.0 - kept) * sample.power.value();
    response.row(i) << 1.0 - of_start, of_power, of_start;
    temperature_c(i) = sample.temperature_c;
  }
  OneTimeConstant fit;
  fit.time_constant_s = time_constant_s;
  fit.air_resistance_start = response.colPivHouseholderQr().solve(temperature_c);
  fit.error_k = response * fit.air_resistance_start - temperature_c;
  return fit;
}

Error unknown(const std::string& why) {
  return {ErrorCode::failed, "heat was watched, but " + why};
}

/// Watches for one phase.
Status watch(const HeatMeasurement& how, std::vector<HeatSample>& samples) {
  for (auto left = how.phase; left.count() > 0; left -= how.period) {
    if (how.stop && how.stop()) {
      return Error{ErrorCode::unavailable, "stopped while heat was measured"};
    }
    std::this_thread::sleep_for(how.period);
    samples.push_back(how.meter());
  }
  return Done{};
}

}  // namespace

Result<std::vector<HeatSample>> measure_heat(const HeatMeasurement& how) {
  std::vector<HeatSample> samples;
  std::optional<BusyCores> busy{std::in_place};
  for (const int cpu : how.cpus) {
    if (const Status taken = busy->take(cpu); !taken) {
      return taken.error();
    }
  }
  if (const Status watched = watch(how, samples); !watched) {
    return watched.error();
  }
  busy.reset();
  if (const Status watched = watch(how, samples); !watched) {
    return watched.error();
  }
  return samples;
}

Result<HeatFit> fitted_heat(const std::vector<HeatSample>& samples) {
  const auto [coolest, hottest] = std::minmax_element(
      samples.begin(), samples.end(),
      [](const HeatSample& a, const HeatSample& b) { return a.temperature_c < b.temperature_c; });
  if (samples.empty() || hottest->temperature_c - coolest->temperature_c < least_change_k) {
    return unknown("the temperature changed by less than 3 K");
  }
  const double watched_s = samples.back().t_s - samples.front().t_s;
  const double least_s = 2.0 * watched_s / static_cast<double>(samples.size());
  OneTimeConstant best = fit_with(least_s, samples);
  for (double tau_s = least_s; tau_s < watched_s; tau_s *= fineness) {
    OneTimeConstant other = fit_with(tau_s, samples);
    if (other.square() < best.square()) {
      best = std::move(other);
    }
  }
  const double resistance_k_w = best.air_resistance_start(1);
  const bool is_within =
      best.time_constant_s > least_s * fineness && best.time_constant_s < watched_s / fineness;
  if (!is_within || !(resistance_k_w > 0.0)) {
    return unknown("it does not follow the power as one body would");
  }
  HeatFit fit;
  fit.model.ambient_c = best.air_resistance_start(0);
  fit.model.resistance_k_w = resistance_k_w;
  fit.model.time_constant_s = best.time_constant_s;
  fit.worst_k = best.error_k.cwiseAbs().maxCoeff();
  return fit;
}

}  // namespace flyball
