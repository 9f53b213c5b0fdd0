// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/scenario/knobs.h"

#include "flyball/kernels/detector.h"
#include "flyball/kernels/localizer.h"
#include "flyball/runtime/decision.h"
#include "flyball/scenario/shipped_platform.h"

#include "scenario/kernel_choice.h"
#include "scenario/scenario_edge.h"
#include "scenario/scenario_fields.h"
#include "scenario/scenario_parameters.h"
#include <algorithm>
#include <limits>
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

constexpr int most_left_out = 8;  // One of so many frames is used at the least.

/// A rate that begins with every frame of the camera, and may be turned down to every n-th.
KnobSpec rate_knob(const char* name, const char* owner, double frames_hz, double longest_s) {
  KnobSpec spec{name, "Hz", owner, {}, frames_hz, frames_hz, frames_hz, {}};
  for (int n = most_left_out; n >= 1; --n) {
    if (n == 1 || n / frames_hz <= longest_s) {
      spec.legal.push_back(frames_hz / n);
    }
  }
  spec.min = spec.legal.front();
  return spec;
}

/// Whether the localizer takes images.
bool sees(const Scenario& scenario) {
  const auto kernel =
      family_choice(typeid(Localizer)).make(scenario.plugins, scenario.kernels.localizer);
  return kernel && static_cast<const Localizer&>(*kernel).inputs().images;
}

/// Two of its frames must fit in what a localizer that sees can bridge, since one may show nothing.
double longest_interval_s(bool has_seeing_localizer) {
  return has_seeing_localizer ? 0.5 * longest_reckoning_s : std::numeric_limits<double>::infinity();
}

/// Those that exist only where the scenario asks for them, beside those that choose among kernels.
Result<std::vector<KnobSpec>> rate_knobs(const Scenario& scenario) {
  const double frames_hz = scenario.camera.rate_hz;
  const bool has_seeing_localizer = sees(scenario);
  const double longest_s = longest_interval_s(has_seeing_localizer);
  std::vector<KnobSpec> all;
  if (scenario.knobs.camera_rate) {
    all.push_back(rate_knob("camera.rate_hz", "camera", frames_hz, longest_s));
    all.back().description = "frames of the depth camera that are used a second";
  }
  if (!scenario.knobs.localizer_rate) {
    return all;
  }
  if (!has_seeing_localizer && !scenario.kernels.slam_load) {
    return Error{ErrorCode::invalid_input,
                 "knobs.localizer_rate = true has no effect with localizer \"" +
                     scenario.kernels.localizer +
                     "\", which takes no frames; set it to false, or kernels.slam_load to true"};
  }
  all.push_back(rate_knob("localizer.rate_hz", has_seeing_localizer ? "see" : "slam_load",
                          frames_hz, longest_s));
  all.back().description = "frames that localization looks at a second, of those that are used";
  return all;
}

/// One price for all detectors would hide what a switch between them brings.
Status check_detector_prices(const Scenario& scenario) {
  const bool has_kinds = family_choice(typeid(Detector)).all_kinds(scenario).size() > 1;
  if (!has_kinds || scenario.detector.cost_of == "own") {
    return Done{};
  }
  return Error{ErrorCode::invalid_input,
               "detector.cost_of = \"" + scenario.detector.cost_of +
                   "\" would charge all detectors alike, and knobs.detector_kinds = \"" +
                   scenario.knobs.detector_kinds +
                   "\" lets detector.kind choose among several; set detector.cost_of to \"own\""};
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

/// What all kernels declare.
Status add_kernels(const Scenario& scenario, const Platform& platform, std::vector<KnobSpec>& all) {
  for (const FamilyChoice& family : family_choices()) {
    auto declared = knobs_of(family, scenario);
    if (!declared) {
      return declared.error();
    }
    if (Status priced = check_switch_prices(family, scenario, platform); !priced) {
      return priced;
    }
    Status added = add(std::move(*declared), family.owner(scenario.kernels), scenario, all);
    if (!added) {
      return added;
    }
  }
  return check_detector_prices(scenario);
}

}  // namespace

Result<std::vector<KnobSpec>> standard_knobs(const Scenario& scenario, const Platform& platform) {
  std::vector<KnobSpec> all;
  if (const Status added = add_kernels(scenario, platform, all); !added) {
    return added.error();
  }
  auto of_mission = rate_knobs(scenario);
  if (!of_mission) {
    return of_mission.error();
  }
  of_mission->insert(of_mission->begin(), speed_knob());
  of_mission->push_back(cores_knob(platform, scenario.platform.cores));
  of_mission->push_back(frequency_knob(platform, scenario.platform.frequency_hz));
  for (KnobSpec& knob : offload_knobs(scenario)) {
    of_mission->push_back(std::move(knob));
  }
  if (const Status added = add(std::move(*of_mission), "the mission", scenario, all); !added) {
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

Result<std::vector<KnobSpec>> standard_knobs(const Scenario& scenario) {
  Result<PlatformModel> model = find_platform(scenario.platform.name);
  if (!model) {
    return model.error();
  }
  return standard_knobs(scenario, ModeledPlatform{std::move(*model)});
}

}  // namespace flyball
