// SPDX-License-Identifier: BSD-3-Clause
// tested-in: calibration
#include "flyball/studies/calibration.h"
#include "flyball/studies/cost_fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace flyball {
namespace {

using Jobs = std::vector<const MeasuredJob*>;
using JobsOfKernels = std::map<std::string, Jobs>;

/// Without those that were too short to be measured or did nothing that has a price.
JobsOfKernels by_kernel(const PlatformModel& like, const std::vector<MeasuredJob>& jobs) {
  JobsOfKernels all;
  for (const MeasuredJob& job : jobs) {
    const auto cost = like.kernels.find(job.kernel);
    const auto is_priced = [&](const auto& price) { return job.work.count(price.first) > 0.0; };
    if (cost != like.kernels.end() && job.cpu_s > 0.0 &&
        std::any_of(cost->second.seconds_per.begin(), cost->second.seconds_per.end(), is_priced)) {
      all[job.kernel].push_back(&job);
    }
  }
  return all;
}

Hertz highest_clock(const Jobs& jobs) {
  return (*std::max_element(jobs.begin(), jobs.end(),
                            [](const auto* a, const auto* b) { return a->clock < b->clock; }))
      ->clock;
}

Jobs at_clock(const Jobs& jobs, Hertz clock) {
  Jobs some;
  std::copy_if(jobs.begin(), jobs.end(), std::back_inserter(some),
               [clock](const MeasuredJob* job) { return job->clock == clock; });
  return some;
}

double measured_s(const Jobs& jobs) {
  return std::accumulate(jobs.begin(), jobs.end(), 0.0,
                         [](double sum_s, const MeasuredJob* job) { return sum_s + job->cpu_s; });
}

double priced_s(const KernelCost& cost, const Work& work) {
  double sum_s = 0.0;
  for (const auto& [name, price_s] : cost.seconds_per) {
    sum_s += price_s * work.count(name);
  }
  return sum_s;
}

double priced_s(const KernelCost& cost, const Jobs& jobs) {
  return std::accumulate(jobs.begin(), jobs.end(), 0.0, [&](double sum_s, const MeasuredJob* job) {
    return sum_s + priced_s(cost, job->work);
  });
}

/// c_i in seconds at the clock of these jobs. A fit of relative errors leaves a bias, so that all
/// are scaled to the sum of the measured times.
std::map<std::string, double, std::less<>> operation_times(const KernelCost& like,
                                                           const Jobs& jobs) {
  std::vector<CostSample> samples;
  for (const MeasuredJob* job : jobs) {
    CostSample sample{{}, job->cpu_s};
    for (const auto& [name, price_s] : like.seconds_per) {
      sample.counts.push_back(job->work.count(name));
    }
    samples.push_back(std::move(sample));
  }
  const CostFit fit = non_negative_fit(samples);
  KernelCost fitted;
  std::size_t at = 0;
  for (const auto& [name, price_s] : like.seconds_per) {
    fitted.seconds_per[name] = fit.seconds_per[at++];
  }
  const double scale = measured_s(jobs) / priced_s(fitted, jobs);
  for (auto& [name, price_s] : fitted.seconds_per) {
    price_s *= scale;
  }
  return fitted.seconds_per;
}

/// a and b with a + b = 1, from how much longer the same work takes at lower clocks.
std::pair<double, double> clock_shares(const KernelCost& at_highest, const Jobs& jobs) {
  std::map<double, Jobs> clocks;
  for (const MeasuredJob* job : jobs) {
    clocks[job->clock.value()].push_back(job);
  }
  std::vector<CostSample> samples;
  samples.reserve(clocks.size());
  for (const auto& [hz, some] : clocks) {
    samples.push_back({{1e9 / hz, 1.0}, measured_s(some) / priced_s(at_highest, some)});
  }
  const CostFit fit = non_negative_fit(samples);
  const double sum = fit.seconds_per[0] + fit.seconds_per[1];
  return {fit.seconds_per[0] / sum, fit.seconds_per[1] / sum};
}

KernelCost fitted_cost(const KernelCost& like, const Jobs& jobs) {
  const Hertz highest = highest_clock(jobs);
  KernelCost cost = like;
  cost.seconds_per = operation_times(like, at_clock(jobs, highest));
  cost.scale = 1.0;
  cost.parallel_fraction = 0.0;  // Times are CPU times of one thread.
  const bool has_clocks = at_clock(jobs, highest).size() < jobs.size();
  std::tie(cost.a, cost.b) =
      has_clocks ? clock_shares(cost, jobs)
                 : std::pair{like.a / (like.a + like.b), like.b / (like.a + like.b)};
  for (auto& [name, price_s] : cost.seconds_per) {
    price_s /= cost.a * 1e9 / highest.value() + cost.b;
  }
  return cost;
}

double model_s(const Platform& platform, const MeasuredJob& job) {
  return to_seconds(platform.job_time(job.kernel, job.work, job.clock));
}

double model_s(const Platform& platform, const Jobs& jobs) {
  return std::accumulate(jobs.begin(), jobs.end(), 0.0, [&](double sum_s, const MeasuredJob* job) {
    return sum_s + model_s(platform, *job);
  });
}

double mean_ms(double sum_s, const Jobs& jobs) {
  return jobs.empty() ? 0.0 : 1e3 * sum_s / static_cast<double>(jobs.size());
}

double median_error(const Platform& platform, const Jobs& jobs) {
  std::vector<double> errors;
  errors.reserve(jobs.size());
  for (const MeasuredJob* job : jobs) {
    errors.push_back(std::abs(model_s(platform, *job) / job->cpu_s - 1.0));
  }
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return errors.empty() ? 0.0 : *middle;
}

}  // namespace

PlatformModel with_prices(const PlatformModel& like, const std::vector<MeasuredJob>& jobs) {
  const JobsOfKernels measured = by_kernel(like, jobs);
  const ModeledPlatform before{like};
  PlatformModel model = like;
  double log_ratios = 0.0;
  for (const auto& [kernel, some] : measured) {
    log_ratios += std::log(measured_s(some) / model_s(before, some));
    model.kernels[kernel] = fitted_cost(like.kernels.find(kernel)->second, some);
  }
  const double ratio =
      measured.empty() ? 1.0 : std::exp(log_ratios / static_cast<double>(measured.size()));
  for (auto& [kernel, cost] : model.kernels) {
    if (measured.count(kernel) == 0) {
      cost.scale *= ratio;
    }
  }
  return model;
}

std::vector<KernelCheck> check_prices(const PlatformModel& model,
                                      const std::vector<MeasuredJob>& fitted,
                                      const std::vector<MeasuredJob>& others) {
  JobsOfKernels before = by_kernel(model, fitted);
  JobsOfKernels after = by_kernel(model, others);
  const ModeledPlatform platform{model};
  std::vector<KernelCheck> checks;
  for (const auto& [kernel, cost] : model.kernels) {
    const Jobs& known = before[kernel];
    const Jobs& unknown = after[kernel];
    checks.push_back({kernel, known.size(), mean_ms(measured_s(known), known), unknown.size(),
                      mean_ms(measured_s(unknown), unknown),
                      mean_ms(model_s(platform, unknown), unknown),
                      median_error(platform, unknown)});
  }
  return checks;
}

PowerCost fitted_power(const std::vector<MeasuredPower>& samples) {
  std::vector<CostSample> rows;
  for (const MeasuredPower& sample : samples) {
    const double ghz = 1e-9 * sample.clock.value();
    const double n = sample.busy_cores;
    rows.push_back({{1.0, ghz, n * ghz, n * ghz * ghz * ghz}, sample.power.value()});
  }
  const CostFit fit = non_negative_fit(rows);
  PowerCost power;
  power.cpu_constant_w = fit.seconds_per[0];
  power.cpu_linear_w = fit.seconds_per[1];
  power.core_linear_w = fit.seconds_per[2];
  power.core_cubic_w = fit.seconds_per[3];
  return power;
}

}  // namespace flyball
