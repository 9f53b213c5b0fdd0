// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/scenario/knobs.h"

namespace flyball {
namespace {

KnobSpec range(std::string name, std::string unit, std::string owner, double min, double max) {
  KnobSpec spec;
  spec.name = std::move(name);
  spec.unit = std::move(unit);
  spec.owner = std::move(owner);
  spec.min = min;
  spec.max = max;
  return spec;
}

KnobSpec described(KnobSpec spec, double fallback, std::string text) {
  spec.fallback = fallback;
  spec.description = std::move(text);
  return spec;
}

KnobSpec frequency_knob(const Platform& platform, double fallback) {
  KnobSpec spec = range("cpu.frequency_hz", "Hz", "platform", 0.0, 0.0);
  for (const Hertz f : platform.frequencies()) {
    spec.legal.push_back(f.value());
  }
  spec.min = spec.legal.front();
  spec.max = spec.legal.back();
  spec.switching_cost = platform.switching_time();
  spec.min_dwell = Duration::zero();  // a switch costs its time and nothing else
  return described(std::move(spec), fallback, "clock of all cores");
}

KnobSpec cores_knob(const Platform& platform, double fallback) {
  KnobSpec spec = range("cpu.cores", "cores", "platform", 1.0, platform.max_cores());
  for (int n = 1; n <= platform.max_cores(); ++n) {
    spec.legal.push_back(n);
  }
  return described(std::move(spec), fallback, "cores that may run jobs");
}

KnobSpec resolution_knob(const std::vector<double>& resolutions_m, double fallback) {
  KnobSpec spec = range("map.resolution_m", "m", "map", 0.05, 2.0);
  if (!resolutions_m.empty()) {
    spec.legal = resolutions_m;
    spec.min = resolutions_m.front();
    spec.max = resolutions_m.back();
  }
  return described(std::move(spec), fallback, "cell size at which depth is integrated");
}

}  // namespace

std::vector<KnobSpec> standard_knobs(const Scenario& scenario,
                                     const Platform& platform,
                                     const std::vector<double>& resolutions_m) {
  return {
      resolution_knob(resolutions_m, scenario.map.resolution_m),
      described(range("map.range_m", "m", "points", 2.0, 25.0), scenario.map.range_m,
                "how far depth is integrated"),
      described(range("map.rate_hz", "Hz", "points", 0.5, 60.0), scenario.map.rate_hz,
                "frames integrated a second, at most"),
      described(range("planner.budget", "iterations", "plan", 100.0, 1e6), scenario.planner.budget,
                "iterations that one plan may take"),
      described(range("mission.max_speed_m_s", "m/s", "follow", 0.5, 20.0),
                scenario.mission.max_speed_m_s, "upper limit; the safe speed below it is computed"),
      cores_knob(platform, scenario.platform.cores),
      frequency_knob(platform, scenario.platform.frequency_hz),
      described(range("detector.scale", "1", "detect", 0.25, 4.0), scenario.detector.scale,
                "size of the image in which people are looked for, over the camera's"),
  };
}

}  // namespace flyball
