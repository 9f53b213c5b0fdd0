// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/scenario/knobs.h"

#include "flyball/runtime/decision.h"

#include "scenario/kernel_choice.h"
#include "scenario/scenario_fields.h"
#include "scenario/scenario_parameters.h"
#include <algorithm>
#include <utility>

namespace flyball {
namespace {

/// The knob's initial value is the scenario's, where it has a setting of the same name.
KnobSpec started(KnobSpec spec, const Scenario& scenario) {
  spec.fallback = number_at(scenario, spec.name).value_or(spec.fallback);
  return spec;
}

KnobSpec frequency_knob(const Platform& platform, double fallback) {
  KnobSpec spec{"cpu.frequency_hz", "Hz", "platform", {}, 0.0, 0.0, fallback, "clock of all cores"};
  for (const Hertz f : platform.frequencies()) {
    spec.legal.push_back(f.value());
  }
  spec.min = spec.legal.front();
  spec.max = spec.legal.back();
  spec.min_dwell = Duration::zero();  // a switch costs its time and nothing else
  return spec;
}

KnobSpec cores_knob(const Platform& platform, double fallback) {
  KnobSpec spec{"cpu.cores", "cores",
                "platform",  {},
                1.0,         1.0 * platform.max_cores(),
                fallback,    "cores that may run jobs"};
  for (int n = 1; n <= platform.max_cores(); ++n) {
    spec.legal.push_back(n);
  }
  return spec;
}

KnobSpec speed_knob() {
  return {"mission.max_speed_m_s",
          "m/s",
          "follow",
          {},
          0.5,
          20.0,
          MissionSettings{}.max_speed_m_s,
          "upper limit; the safe speed below it is computed"};
}

/// What a kernel declares. Its knobs may follow from its parameters, but not from model files, so
/// none are looked for.
Result<std::vector<KnobSpec>> knobs_of(const FamilyChoice& family, const Scenario& scenario) {
  const KernelSettings& kernels = scenario.kernels;
  const auto kernel = family.make(kernels.*family.kernel);
  if (!kernel) {
    return unknown(family.name, kernels.*family.kernel, "kernels");
  }
  const auto chosen =
      resolved(family.owner(kernels), kernel->parameters(), kernels.*family.parameters);
  if (!chosen) {
    return chosen.error();
  }
  static_cast<void>(kernel->configure(*chosen, no_models));
  return kernel->knobs();
}

/// Adds knobs to `all` unless one of them is wrong.
Status add(std::vector<KnobSpec> declared,
           const std::string& owner,
           const Scenario& scenario,
           std::vector<KnobSpec>& all) {
  for (KnobSpec& spec : declared) {
    spec = started(std::move(spec), scenario);
    const auto is_same = [&spec](const KnobSpec& other) { return other.name == spec.name; };
    if (std::any_of(all.begin(), all.end(), is_same)) {
      return Error{ErrorCode::invalid_input,
                   owner + " declares knob \"" + spec.name + "\", which is there already"};
    }
    if (const Status sound = check_declaration(spec); !sound) {
      return Error{sound.error().code, owner + ": " + sound.error().message};
    }
    all.push_back(std::move(spec));
  }
  return Done{};
}

}  // namespace

Result<std::vector<KnobSpec>> standard_knobs(const Scenario& scenario, const Platform& platform) {
  std::vector<KnobSpec> all;
  for (const FamilyChoice& family : family_choices()) {
    auto declared = knobs_of(family, scenario);
    if (!declared) {
      return declared.error();
    }
    const Status added = add(std::move(*declared), family.owner(scenario.kernels), scenario, all);
    if (!added) {
      return added.error();
    }
  }
  const Status added = add({speed_knob(), cores_knob(platform, scenario.platform.cores),
                            frequency_knob(platform, scenario.platform.frequency_hz)},
                           "the mission", scenario, all);
  if (!added) {
    return added.error();
  }
  if (all.size() > Decision::capacity) {
    return Error{ErrorCode::invalid_input, "the kernels declare " + std::to_string(all.size()) +
                                               " knobs with those of mission and platform, and a " +
                                               "decision holds " +
                                               std::to_string(Decision::capacity)};
  }
  return all;
}

}  // namespace flyball
