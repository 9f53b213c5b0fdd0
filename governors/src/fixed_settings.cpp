// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/governors/fixed_settings.h"

#include "flyball/governors/required_knobs.h"
#include "flyball/runtime/text/number_text.h"

#include <array>

namespace flyball {
namespace {

struct Setting {
  const char* parameter;
  const char* knob;
  double least;
  double most;
  const char* description;
};

constexpr Setting frequency{"frequency_hz", "cpu.frequency_hz", 1e8, 1e10, "Clock of those cores."};
constexpr std::array<Setting, 9> settings{{
    {"resolution_m", "map.resolution_m", 0.05, 2.0, "Edge of a map cell."},
    {"range_m", "map.range_m", 0.5, 100.0, "How far depth is integrated into the map."},
    {"rate_hz", "map.rate_hz", 0.1, 100.0, "How often depth is integrated into the map."},
    {"planner_budget", "planner.budget", 1.0, 1e7,
     "Iterations that one search for a path may take."},
    {"view_nodes", "explore.iterations", 1.0, 1e4, "Nodes in which a next view is looked for."},
    {"view_threads", "explore.threads", 1.0, 16.0, "Threads that look for it at once."},
    {"cores", "cpu.cores", 1.0, 64.0, "Cores that kernels may use."},
    {"max_speed_m_s", "mission.max_speed_m_s", 0.1, 50.0, "Upper limit of the speed."},
    frequency,
}};

ParameterSpec spec_of(const Setting& setting) {
  return {setting.parameter, 0.0, 0.0, setting.most,
          std::string{setting.description} + " 0: as the scenario says."};
}

/// 0: as the scenario says.
double value_of(const Setting& setting, const Parameters& given) {
  const auto declared = given.values().find(setting.parameter);
  return declared == given.values().end() ? 0.0 : given.number(setting.parameter);
}

std::vector<std::string> needed(const Parameters& given) {
  std::vector<std::string> names;
  for (const Setting& setting : settings) {
    if (value_of(setting, given) != 0.0) {
      names.emplace_back(setting.knob);
    }
  }
  return names;
}

bool reaches(const KnobSpec& spec, double value) {
  const double low = spec.legal.empty() ? spec.min : spec.legal.front();
  const double high = spec.legal.empty() ? spec.max : spec.legal.back();
  return value >= low && value <= high;
}

}  // namespace

std::vector<ParameterSpec> fixed_setting_parameters() {
  std::vector<ParameterSpec> specs;
  for (const Setting& setting : settings) {
    if (setting.knob != std::string_view{frequency.knob}) {
      specs.push_back(spec_of(setting));
    }
  }
  return specs;
}

ParameterSpec fixed_frequency_parameter() {
  return spec_of(frequency);
}

Result<Decision> fixed_settings(const std::string& owner,
                                const Parameters& given,
                                const KnobSettings& knobs) {
  Decision wish;
  if (Status status = require_knobs(owner, knobs, needed(given)); !status) {
    return status.error();
  }
  for (const Setting& setting : settings) {
    const double value = value_of(setting, given);
    if (value == 0.0) {
      continue;
    }
    const auto refused = [&](const std::string& why) {
      std::string text = owner;
      text.append(": ").append(setting.parameter).append(" = ").append(short_number_text(value));
      text.append(": ").append(why).append("; try: flyball list knobs");
      return Error{ErrorCode::invalid_input, text};
    };
    if (value < setting.least) {
      return refused("must be at least " + short_number_text(setting.least));
    }
    if (!reaches(*knobs.spec(setting.knob), value)) {
      return refused(std::string{setting.knob} + " cannot take this value here");
    }
    wish.set(setting.knob, value);
  }
  return wish;
}

}  // namespace flyball
