// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The contract of every kernel (runtime/kernel.h) as checks, for any kernel and any test
/// framework. Each family adds its own checks in a header of its own beside this one. An empty list
/// of breaches means that the kernel may fly.

#include "flyball/runtime/kernel.h"
#include "flyball/runtime/work.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace flyball {

/// A kernel on trial.
template <class Family>
struct KernelCandidate {
  std::function<std::unique_ptr<Family>()> make;
  std::map<std::string, ParameterValue> parameters{};  ///< As a scenario would give them.
  FindModel find_model{no_models};
};

/// Whether the counts are numbers that a price can be put on.
[[nodiscard]] inline bool is_countable(const Work& work) {
  return std::all_of(work.items().begin(), work.items().end(), [](const WorkItem& item) {
    return std::isfinite(item.count) && item.count >= 0.0 && !item.name.empty();
  });
}

/// Whether the work on the larger input is no less in any count.
[[nodiscard]] inline bool is_at_least(const Work& larger, const Work& smaller) {
  return std::all_of(smaller.items().begin(), smaller.items().end(),
                     [&](const WorkItem& item) { return larger.count(item.name) >= item.count; });
}

[[nodiscard]] inline bool is_same(const Work& one, const Work& other) {
  return is_at_least(one, other) && is_at_least(other, one);
}

/// Collects one sentence for each rule that a kernel breaks.
template <class Family>
class KernelConformance {
 public:
  explicit KernelConformance(KernelCandidate<Family> candidate)
      : candidate_{std::move(candidate)} {}

 protected:
  /// Checks what all kernels declare; then the family's own rules, unless the kernel cannot even
  /// be made.
  ///
  /// @param knobs  That every kernel of the family has.
  /// @param check  Those of the family.
  std::vector<std::string> checked(const std::vector<std::string>& knobs,
                                   const std::function<void()>& check) {
    breaches_.clear();
    if (made() != nullptr) {
      check_parameters();
      check_knobs(knobs);
      check();
    }
    return breaches_;
  }

  void require(bool holds, const std::string& breach) {
    if (!holds && std::find(breaches_.begin(), breaches_.end(), breach) == breaches_.end()) {
      breaches_.push_back(breach);
    }
  }
  /// @param of  What the counts must not be less than.
  void require_work(const Work& larger, const Work& of) {
    require(is_countable(larger) && is_countable(of),
            "counts work that is negative, not finite or without a name");
    require(is_at_least(larger, of), "counts less work for a larger input");
  }

  /// A new kernel, configured; null, with the reason among the breaches, where there is none.
  std::unique_ptr<Family> made() {
    auto kernel = candidate_.make();
    if (kernel == nullptr) {
      require(false, "the factory makes nothing");
      return nullptr;
    }
    const auto chosen =
        Parameters::resolve("the kernel", kernel->parameters(), candidate_.parameters);
    if (const auto* errors = std::get_if<std::vector<Error>>(&chosen)) {
      require(false, "does not take the given parameters: " + errors->front().message);
      return nullptr;
    }
    const Status configured =
        kernel->configure(std::get<Parameters>(chosen), candidate_.find_model);
    if (!configured) {
      require(false, "cannot be configured: " + configured.error().message);
      return nullptr;
    }
    return kernel;
  }

 private:
  void check_parameters() {
    const auto declared = candidate_.make()->parameters();
    for (const ParameterSpec& spec : declared) {
      require(!spec.name.empty() && !spec.description.empty(),
              "parameter \"" + spec.name + "\" lacks a name or a description");
      if (const double* value = std::get_if<double>(&spec.fallback)) {
        require(*value >= spec.min && *value <= spec.max,
                "the default of \"" + spec.name + "\" is out of its own bounds");
      }
    }
    const auto later = made()->parameters();
    const auto is_equal = [](const ParameterSpec& a, const ParameterSpec& b) {
      return a.name == b.name && a.fallback == b.fallback;
    };
    require(std::equal(declared.begin(), declared.end(), later.begin(), later.end(), is_equal),
            "declares other parameters once it is configured");
  }

  void check_knobs(const std::vector<std::string>& of_family) {
    const auto kernel = made();
    const std::vector<KnobSpec> knobs = kernel->knobs();
    std::vector<std::string> names;
    bool sound = true;
    for (const KnobSpec& spec : knobs) {
      const Status declared = check_declaration(spec);
      require(declared.ok(),
              declared ? "" : "declares a knob wrongly: " + declared.error().message);
      const bool is_new = std::find(names.begin(), names.end(), spec.name) == names.end();
      require(is_new, "declares knob \"" + spec.name + "\" twice");
      sound = sound && declared.ok() && is_new;
      names.push_back(spec.name);
    }
    for (const std::string& name : of_family) {
      require(std::find(names.begin(), names.end(), name) != names.end(),
              "lacks the family's knob \"" + name + "\"");
    }
    if (sound) {
      turn(*kernel, knobs);
    }
  }

  /// To each end and back: nothing but a crash could be seen here.
  static void turn(Family& kernel, const std::vector<KnobSpec>& specs) {
    KnobSettings knobs{specs};
    for (const KnobSpec& spec : specs) {
      for (const double value : {spec.nearest(spec.min), spec.nearest(spec.max), spec.fallback}) {
        static_cast<void>(knobs.set(spec.name, value));
        kernel.apply(knobs);
      }
    }
  }

  KernelCandidate<Family> candidate_;
  std::vector<std::string> breaches_{};
};

}  // namespace flyball
