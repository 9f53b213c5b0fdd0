// SPDX-License-Identifier: BSD-3-Clause
//
// Every knob stays where the preset put it: the static setting that other policies are measured
// against. A parameter of zero leaves its knob to the scenario.

#include "flyball/governors/fixed_settings.h"
#include "flyball/governors/policy.h"
#include "flyball/runtime/registry.h"

namespace {

class Fixed final : public flyball::Policy {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    auto specs = flyball::fixed_setting_parameters();
    specs.push_back(flyball::fixed_frequency_parameter());
    return specs;
  }

  flyball::Status start(const flyball::Parameters& given,
                        const flyball::KnobSettings& knobs,
                        const flyball::BoardModel& /*board*/) override {
    const auto wish = flyball::fixed_settings("policy \"fixed\"", given, knobs);
    if (!wish) {
      return wish.error();
    }
    wish_ = *wish;
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
