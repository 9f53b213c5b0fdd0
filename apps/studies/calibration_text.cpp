// SPDX-License-Identifier: BSD-3-Clause
// tested-in: calibration
#include "flyball/records/text_table.h"
#include "flyball/studies/calibration.h"

#include <cmath>
#include <sstream>

#include <toml++/toml.h>

namespace flyball {
namespace {

/// More digits than four would claim what no measurement knows.
double four_digits(double value) {
  if (value == 0.0) {
    return 0.0;
  }
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 3.0);
  std::ostringstream text;
  text.precision(4);
  text << std::round(value / unit) * unit;
  return std::stod(text.str());
}

toml::table power_table(const PowerCost& power) {
  toml::table table{{"board_w", power.board_w},
                    {"converter", power.converter},
                    {"soc_w", power.soc_w},
                    {"memory_w", power.memory_w},
                    {"memory_linear_w", power.memory_linear_w},
                    {"cpu_constant_w", four_digits(power.cpu_constant_w)},
                    {"cpu_linear_w", four_digits(power.cpu_linear_w)},
                    {"core_linear_w", four_digits(power.core_linear_w)},
                    {"core_cubic_w", four_digits(power.core_cubic_w)}};
  if (power.idle_core_w > 0.0) {
    table.insert("idle_core_w", power.idle_core_w);
  }
  toml::array clocks;
  for (const MemoryClock& step : power.memory_clocks) {
    clocks.push_back(
        toml::table{{"from_hz", step.from.value()}, {"memory_hz", step.memory.value()}});
  }
  if (!clocks.empty()) {
    table.insert("memory_clocks", clocks);
  }
  return table;
}

toml::table thermal_table(const ThermalModel& thermal) {
  toml::array trips;
  for (const ThermalTrip& trip : thermal.trips) {
    trips.push_back(toml::table{
        {"at_c", trip.at_c}, {"hysteresis_k", trip.hysteresis_k}, {"cap_hz", trip.cap.value()}});
  }
  toml::table table{{"ambient_c", thermal.ambient_c},
                    {"resistance_k_w", thermal.resistance_k_w},
                    {"time_constant_s", thermal.time_constant_s}};
  if (!trips.empty()) {  // A list without tables is none of tables.
    table.insert("trips", trips);
  }
  return table;
}

toml::table kernel_table(const KernelCost& cost) {
  toml::table prices;
  for (const auto& [name, price_s] : cost.seconds_per) {
    prices.insert(name, four_digits(price_s));
  }
  toml::table table{{"scale", four_digits(cost.scale)},
                    {"a", four_digits(cost.a)},
                    {"b", four_digits(cost.b)},
                    {"parallel_fraction", cost.parallel_fraction},
                    {"seconds_per", prices}};
  if (cost.on_gpu) {
    table.insert("on", "gpu");
  }
  return table;
}

std::string percent(double share) {
  return rounded(100.0 * share, 0) + " %";
}

}  // namespace

std::string to_text(const Calibration& calibration) {
  std::vector<std::vector<std::string>> lines{
      {"KERNEL", "FITTED ON", "MEAN", "CHECKED ON", "MEASURED", "PREDICTED", "OFF BY", "PER JOB"}};
  for (const KernelCheck& kernel : calibration.kernels) {
    if (kernel.fitted_jobs == 0) {
      lines.push_back({kernel.kernel, "not called", "-", "-", "-", "-", "-", "-"});
      continue;
    }
    const bool is_checked = kernel.checked_jobs > 0;
    lines.push_back({kernel.kernel, std::to_string(kernel.fitted_jobs) + " jobs",
                     rounded(kernel.fitted_ms, 3) + " ms",
                     is_checked ? std::to_string(kernel.checked_jobs) + " jobs" : "-",
                     is_checked ? rounded(kernel.checked_ms, 3) + " ms" : "-",
                     is_checked ? rounded(kernel.predicted_ms, 3) + " ms" : "-",
                     is_checked ? percent(kernel.predicted_ms / kernel.checked_ms - 1.0) : "-",
                     is_checked ? percent(kernel.checked_error) : "-"});
  }
  return aligned(lines) +
         "\nOFF BY: sum of the predicted times over the sum of the measured ones. PER JOB: median "
         "error of\nsingle jobs. What was not called has its old prices, scaled like the others. "
         "Other threads took\n" +
         percent(calibration.other_threads) + " of the CPU time of the one that ran the kernels.\n";
}

std::string to_toml(const PlatformModel& model, const std::vector<std::string>& remarks) {
  toml::array clocks;
  for (const Hertz clock : model.frequencies) {
    clocks.push_back(clock.value());
  }
  toml::table kernels;
  for (const auto& [name, cost] : model.kernels) {
    kernels.insert(name, kernel_table(cost));
  }
  toml::table file{{"name", model.name},
                   {"max_cores", model.max_cores},
                   {"frequencies_hz", clocks},
                   {"switching_time_s", to_seconds(model.switching_time)},
                   {"power", power_table(model.power)},
                   {"kernels", kernels}};
  if (model.memory_contention > 0.0) {
    file.insert("memory_contention", model.memory_contention);
  }
  if (model.gpu) {
    file.insert("gpu",
                toml::table{{"clock_hz", model.gpu->clock.value()}, {"busy_w", model.gpu->busy_w}});
  }
  if (model.thermal) {
    file.insert("thermal", thermal_table(*model.thermal));
  }
  std::ostringstream text;
  for (const std::string& remark : remarks) {
    text << "# " << remark << '\n';
  }
  text << file << '\n';
  return text.str();
}

}  // namespace flyball
