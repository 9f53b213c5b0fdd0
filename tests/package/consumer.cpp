// SPDX-License-Identifier: BSD-3-Clause
//
// Governs one decision with nothing but the public headers of runtime, governors and policies.

#include <chrono>
#include <cstdio>

#include <flyball/governors/policy_governor.h>
#include <flyball/policies/policies.h>
#include <flyball/runtime/registry.h>

int main() {
  flyball::Registry registry;
  flyball::register_policies(registry);
  auto policy = registry.make<flyball::Policy>("density");
  if (policy == nullptr) {
    return 1;
  }
  const flyball::KnobSettings knobs{
      {{"map.resolution_m", "m", "mine", {0.15, 0.80}, 0.0, 0.0, 0.15, ""}}};
  const auto parameters = flyball::Parameters::resolve("density", policy->parameters(), {});
  if (!policy->start(std::get<flyball::Parameters>(parameters), knobs, {}).ok()) {
    return 1;
  }
  flyball::PolicyGovernor governor{std::move(policy), knobs, {}, std::chrono::steady_clock::now};
  flyball::Observation seen;
  seen.phase = flyball::MissionPhase::cruise;
  seen.obstacle_density = 0.0;
  const auto decision = governor.decide(seen);
  std::printf("%.2f\n", decision.begin()->value);
  return decision.size() == 1 && decision.begin()->value == 0.80 ? 0 : 1;
}
