// SPDX-License-Identifier: BSD-3-Clause
//
// Add a policy in one file. Put the class and the FLYBALL_PLUGIN below into policies/<name>.cpp and
// `flyball compare` flies it: nothing else is edited. This program holds it to the contract of
// every policy and checks that it does what its first line says.

#include "flyball/governors/policy.h"
#include "flyball/governors/policy_conformance.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace {

/// A cell is a tenth of the distance to the nearest obstacle: near things are seen sharply, far
/// ones need not be.
class NearSharp final : public flyball::Policy {
 public:
  [[nodiscard]] std::vector<flyball::ParameterSpec> parameters() const override {
    return {{"cells_to_obstacle", 10.0, 1.0, 100.0, "Cells between the body and what is nearest."}};
  }

  flyball::Status start(const flyball::Parameters& given,
                        const flyball::KnobSettings& knobs,
                        const flyball::BoardModel& /*board*/) override {
    if (knobs.spec(knob) == nullptr) {
      return flyball::Error{flyball::ErrorCode::invalid_input,
                            "policy \"near_sharp\" needs the knob map.resolution_m"};
    }
    cells_ = given.number("cells_to_obstacle");
    return flyball::Done{};
  }

  [[nodiscard]] flyball::Decision decide(const flyball::Observation& seen) noexcept override {
    flyball::Decision wish;
    wish.reason = flyball::Reason::density;
    wish.set(knob, seen.nearest_obstacle_m / cells_);  // the governor finds the nearest legal value
    return wish;
  }

 private:
  static constexpr const char* knob = "map.resolution_m";
  double cells_{10.0};
};

}  // namespace

FLYBALL_PLUGIN(near_sharp) {
  registry.add<flyball::Policy>("near_sharp", [] { return std::make_unique<NearSharp>(); });
}

namespace {

double resolution_m(flyball::PolicyGovernor& governor, double t_s, double nearest_m) {
  flyball::Observation seen;
  seen.now = flyball::MissionTime{flyball::from_seconds(t_s)};
  seen.phase = flyball::MissionPhase::cruise;
  seen.nearest_obstacle_m = nearest_m;
  return governor.decide(seen).begin()->value;
}

}  // namespace

int main() {
  flyball::Registry registry;
  flyball_plugin_near_sharp(registry);
  const auto make = [&registry] { return registry.make<flyball::Policy>("near_sharp"); };

  const auto breaches = flyball::PolicyConformance{{make}}.breaches();
  for (const std::string& breach : breaches) {
    std::printf("near_sharp %s\n", breach.c_str());
  }

  auto policy = make();
  const auto knobs = flyball::conformance_knobs();
  const auto parameters = flyball::Parameters::resolve("near_sharp", policy->parameters(), {});
  const auto started = policy->start(std::get<flyball::Parameters>(parameters), knobs, {});
  if (!started) {
    std::printf("wrong: %s\n", started.error().message.c_str());
    return 1;
  }
  flyball::PolicyGovernor governor{std::move(policy), knobs, {}, std::chrono::steady_clock::now};
  const double near_m = resolution_m(governor, 0.0, 1.5);
  const double far_m = resolution_m(governor, 10.0, 12.0);
  std::printf("nearest obstacle at 1.5 m: %.2f m cells, at 12 m: %.2f m cells\n", near_m, far_m);

  const bool right = breaches.empty() && near_m == 0.15 && far_m == 1.20;
  std::puts(right ? "right" : "wrong");
  return right ? 0 : 1;
}
