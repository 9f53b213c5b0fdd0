// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The computer: its operating points, and what work costs on it in time and power.

#include "flyball/runtime/result.h"
#include "flyball/runtime/thermal.h"
#include "flyball/runtime/time.h"
#include "flyball/runtime/units.h"
#include "flyball/runtime/work.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flyball {

struct OperatingPoint {
  int cores{1};
  Hertz frequency{};
  friend bool operator==(const OperatingPoint& a, const OperatingPoint& b) {
    return a.cores == b.cores && a.frequency == b.frequency;
  }
  friend bool operator!=(const OperatingPoint& a, const OperatingPoint& b) { return !(a == b); }
};

class Platform {
 public:
  Platform() = default;
  Platform(const Platform&) = delete;
  Platform& operator=(const Platform&) = delete;
  virtual ~Platform() = default;

  [[nodiscard]] virtual const std::string& name() const = 0;
  /// Ascending.
  [[nodiscard]] virtual const std::vector<Hertz>& frequencies() const = 0;
  [[nodiscard]] virtual int max_cores() const = 0;
  /// How long `work` of `kernel` takes on one core. A kernel without a cost takes no time: ask
  /// `knows` at set-up.
  [[nodiscard]] virtual Duration job_time(std::string_view kernel,
                                          const Work& work,
                                          Hertz frequency) const = 0;
  /// Amdahl speed-up of `kernel` on `cores` (may be fractional); 1 for at most one core.
  [[nodiscard]] virtual double speedup(std::string_view kernel, double cores) const = 0;
  [[nodiscard]] virtual bool knows(std::string_view kernel) const = 0;
  /// Input power of the whole computer with `busy_cores` busy on average. Cores that the operating
  /// point leaves out are off unless somebody else works on them.
  [[nodiscard]] virtual Watts power(const OperatingPoint& point, double busy_cores) const = 0;
  /// Whether `kernel` runs on the GPU, which serves one job at a time and lets it end.
  [[nodiscard]] virtual bool runs_on_gpu(std::string_view /*kernel*/) const { return false; }
  /// What the GPU adds to the input power of the computer while it works.
  [[nodiscard]] virtual Watts gpu_power() const { return Watts{}; }
  /// How many times longer `kernel` takes while so many other cores work, with whom it shares the
  /// memory; at least 1.
  [[nodiscard]] virtual double slowdown(std::string_view /*kernel*/,
                                        Hertz /*clock*/,
                                        double /*other_cores*/) const {
    return 1.0;
  }
  /// How long a change of the clock takes; jobs stand still meanwhile.
  [[nodiscard]] virtual Duration switching_time() const = 0;
  /// What is granted when `wanted` is asked for: a board that is too hot grants less.
  [[nodiscard]] virtual OperatingPoint granted(const OperatingPoint& wanted) const {
    return wanted;
  }
  /// Cores that somebody else's work keeps busy now.
  [[nodiscard]] virtual double taken_cores() const { return 0.0; }
};

/// One kernel's price list: t = scale * sum_i n_i c_i (a / f_GHz + b) / S(cores). On the GPU b is
/// divided by its clock in GHz, and a follows the clock of the cores that feed it.
struct KernelCost {
  std::map<std::string, double, std::less<>> seconds_per{};  ///< c_i by work name, at 1 GHz.
  double scale{1.0};
  double a{1.0};               ///< Share that scales with the clock [GHz].
  double b{};                  ///< Share that does not (memory).
  double parallel_fraction{};  ///< 0: the kernel runs on one core only.
  bool on_gpu{};
};

struct GpuModel {
  Hertz clock{};    ///< It is never changed.
  double busy_w{};  ///< Added to the computer's input power while a job runs; idle, it is off.
};

/// From this clock of the cores on, the memory's clock is so much: boards raise both together.
struct MemoryClock {
  Hertz from{};
  Hertz memory{};
};

/// P_in = board + converter * (P_soc + memory + memory_linear f_m + const + linear f + sum_i u_i
/// (core_linear f + core_cubic f^3)), f and f_m in GHz (facts in the platform file).
struct PowerCost {
  double board_w{};
  double converter{1.0};
  double soc_w{};
  double memory_w{};
  double cpu_constant_w{};
  double cpu_linear_w{};
  double core_linear_w{};
  double core_cubic_w{};
  double memory_linear_w{};
  std::vector<MemoryClock> memory_clocks{};  ///< Ascending; none: f_m = 0.
  /// What a core that is on takes even if it idles, on its own rail; a part of `cpu_constant_w`,
  /// which is that of all cores.
  double idle_core_w{};

  [[nodiscard]] Watts power(Hertz clock, double busy_cores, double cores_off = 0.0) const;
  /// f_m at this clock of the cores.
  [[nodiscard]] Hertz memory_clock(Hertz clock) const;
  /// What the input power falls by for each core that is switched off.
  [[nodiscard]] Watts off_core_power() const { return Watts{converter * idle_core_w}; }
  /// What one busy core adds on its own rail, before the converter.
  [[nodiscard]] Watts core_power(Hertz clock) const;
};

struct PlatformModel {
  std::string name;
  int max_cores{1};
  std::vector<Hertz> frequencies{};  ///< Ascending.
  Duration switching_time{};
  PowerCost power{};
  std::map<std::string, KernelCost, std::less<>> kernels{};
  std::optional<ThermalModel> thermal{};  ///< Empty: it never gets too hot.
  std::optional<GpuModel> gpu{};          ///< Empty: there is none.
  /// By so much of itself the share of each kernel that waits for memory, b, grows for each other
  /// core that works.
  double memory_contention{};
};

/// A platform that is nothing but its numbers.
class ModeledPlatform final : public Platform {
 public:
  explicit ModeledPlatform(PlatformModel model);

  [[nodiscard]] const std::string& name() const override { return model_.name; }
  [[nodiscard]] const std::vector<Hertz>& frequencies() const override {
    return model_.frequencies;
  }
  [[nodiscard]] int max_cores() const override { return model_.max_cores; }
  [[nodiscard]] Duration job_time(std::string_view kernel,
                                  const Work& work,
                                  Hertz frequency) const override;
  [[nodiscard]] double speedup(std::string_view kernel, double cores) const override;
  [[nodiscard]] bool knows(std::string_view kernel) const override;
  [[nodiscard]] Watts power(const OperatingPoint& point, double busy_cores) const override;
  [[nodiscard]] bool runs_on_gpu(std::string_view kernel) const override;
  [[nodiscard]] Watts gpu_power() const override;
  [[nodiscard]] double slowdown(std::string_view kernel,
                                Hertz clock,
                                double other_cores) const override;
  [[nodiscard]] Duration switching_time() const override { return model_.switching_time; }
  [[nodiscard]] const PlatformModel& model() const { return model_; }

 private:
  /// The share of the time that waits for memory, at the clock that it depends on.
  [[nodiscard]] double waiting(const KernelCost& cost) const;

  PlatformModel model_;
};

}  // namespace flyball
