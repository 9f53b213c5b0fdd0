// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Several kernels of one family behind one: a knob chooses between two jobs which of them works.

#include "flyball/kernels/detector.h"
#include "flyball/kernels/path_planner.h"
#include "flyball/runtime/assert.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace flyball {

/// A kernel that can be chosen.
template <class Family>
struct KernelKind {
  std::string name;  ///< Also that of its price list on the platform.
  std::unique_ptr<Family> kernel;
};

/// Holds all kinds, configured, so that nothing is loaded in flight. Which of them works is settled
/// when a job begins: the knob's value is the number of the kind. A job's work is charged by the
/// price list of the kind that did it, and the first job after a switch adds one `switches` to it.
template <class Family>
class SwitchedKernel : public Family {
 public:
  /// @param knob   Its name, unit, owner and description: `planner.kind`.
  /// @param kinds  Configured, at least one; the first one works until the knob is turned.
  SwitchedKernel(KnobSpec knob, std::vector<KernelKind<Family>> kinds)
      : kinds_{std::move(kinds)}, knob_{std::move(knob)} {
    FLYBALL_ASSERT(!kinds_.empty(), "knob %s has no kinds", knob_.name.c_str());
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      knob_.legal.push_back(static_cast<double>(i));
      knob_.labels.push_back(kinds_[i].name);
    }
    knob_.max = knob_.legal.back();
  }

  /// The knob that chooses, then those of all kinds. Kinds share the knobs of their family, so of
  /// two with the same name the first one counts.
  [[nodiscard]] std::vector<KnobSpec> knobs() const override {
    std::vector<KnobSpec> all{knob_};
    for (const auto& kind : kinds_) {
      for (KnobSpec& spec : kind.kernel->knobs()) {
        const auto is_same = [&spec](const KnobSpec& other) { return other.name == spec.name; };
        if (std::none_of(all.begin(), all.end(), is_same)) {
          all.push_back(std::move(spec));
        }
      }
    }
    return all;
  }
  void apply(const KnobSettings& knobs) override {
    const auto chosen = static_cast<std::size_t>(std::lround(knobs.value(knob_.name)));
    has_switched_ = has_switched_ || chosen != active_;
    active_ = chosen;
    kinds_[active_].kernel->apply(knobs);
  }

 protected:
  [[nodiscard]] Family& active() { return *kinds_[active_].kernel; }
  /// Says in a job's work who did it, and whether it was the first job after a switch.
  void charge(Work& work) {
    work.charge_as(kinds_[active_].name);
    if (has_switched_) {
      work.add("switches", 1.0);
      has_switched_ = false;
    }
  }

 private:
  std::vector<KernelKind<Family>> kinds_;
  KnobSpec knob_;
  std::size_t active_{};
  bool has_switched_{};
};

/// Knob `planner.kind`.
class SwitchedPlanner final : public SwitchedKernel<PathPlanner> {
 public:
  explicit SwitchedPlanner(std::vector<KernelKind<PathPlanner>> kinds)
      : SwitchedKernel{{"planner.kind", "kind", "plan", {}, 0.0, 0.0, 0.0, "which planner works"},
                       std::move(kinds)} {}

  Plan plan(const PlanRequest& request, const OccupancyView& map) override {
    Plan plan = active().plan(request, map);
    charge(plan.work);
    return plan;
  }
};

/// Knob `detector.kind`.
class SwitchedDetector final : public SwitchedKernel<Detector> {
 public:
  explicit SwitchedDetector(std::vector<KernelKind<Detector>> kinds)
      : SwitchedKernel{
            {"detector.kind", "kind", "detect", {}, 0.0, 0.0, 0.0, "which detector works"},
            std::move(kinds)} {}

  Result<std::vector<Detection>> detect(const ColourImage& image,
                                        double scale,
                                        Work& work) override {
    auto found = active().detect(image, scale, work);
    charge(work);
    return found;
  }
};

}  // namespace flyball
