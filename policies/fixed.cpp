// SPDX-License-Identifier: BSD-3-Clause
//
// Every knob stays where the preset put it: the static setting that other policies are measured
// against. A parameter of zero leaves its knob to the scenario.

#include "flyball/governors/policy.h"
#include "flyball/runtime/registry.h"

#include <array>

namespace {

using flyball::KnobSpec;

struct Setting {
  const char* parameter;
  const char* knob;
  double least;
  double most;
  const char* description;
};

constexpr std::array<Setting, 7> settings{{
    {"resolution_m", "map.resolution_m", 0.05, 2.0, "Edge of a map cell."},
    {"range_m", "map.range_m", 0.5, 100.0, "How far depth is integrated into the map."},
    {"rate_hz", "map.rate_hz", 0.1, 100.0, "How often depth is integrated into the map."},
    {"planner_budget", "planner.budget", 1.0, 1e7, "Iterations that one plan may take."},
    {"cores", "cpu.cores", 1.0, 64.0, "Cores that kernels may use."},
    {"frequency_hz", "cpu.frequency_hz", 1e8, 1e10, "Clock of those cores."},
    {"max_speed_m_s", "mission.max_speed_m_s", 0.1, 50.0, "Upper limit of the speed."},
}};

/// A static setting is not moved silently to another value.
bool reaches(const KnobSpec& spec, double value) {
  const double low = spec.legal.empty() ? spec.min : spec.legal.front();
  const double high = spec.legal.empty() ? spec.max : spec.legal.back();
  return value >= low && value <= high;
}

flyball::Error refused(const Setting& setting, double value, const std::string& why) {
  return {flyball::ErrorCode::invalid_input, "policy \"fixed\": " + std::string{setting.parameter} +
                                                 " = " + std::to_string(value) + ": " + why +
                                                 "; try: flyball list knobs"};
}

class Fixed final : public flyball::Policy {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    std::vector<flyball::ParameterSpec> specs;
    specs.reserve(settings.size());
    for (const Setting& setting : settings) {
      specs.push_back({setting.parameter, 0.0, 0.0, setting.most,
                       std::string{setting.description} + " 0: as the scenario says."});
    }
    return specs;
  }

  flyball::Status start(const flyball::Parameters& given,
                        const flyball::KnobSettings& knobs) override {
    wish_ = {};
    for (const Setting& setting : settings) {
      const double value = given.number(setting.parameter);
      if (value == 0.0) {
        continue;
      }
      if (value < setting.least) {
        return refused(setting, value, "must be at least " + std::to_string(setting.least));
      }
      const KnobSpec* spec = knobs.spec(setting.knob);
      if (spec == nullptr || !reaches(*spec, value)) {
        return refused(setting, value, std::string{setting.knob} + " cannot take this value here");
      }
      wish_.set(setting.knob, value);
    }
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Decision decide(const flyball::Observation& /*seen*/) noexcept override {
    return wish_;
  }

 private:
  flyball::Decision wish_;
};

}  // namespace

FLYBALL_PLUGIN(fixed) {
  registry.add<flyball::Policy>("fixed", [] { return std::make_unique<Fixed>(); });
}
