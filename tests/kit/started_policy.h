// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Starts a registered policy the way a mission does.

#include "flyball/governors/policy_conformance.h"
#include "flyball/policies/policies.h"
#include "flyball/runtime/registry.h"

namespace flyball {

struct StartedPolicy {
  std::unique_ptr<Policy> policy;
  Status status;
};

/// @pre The policy exists and the parameters are within their own bounds.
[[nodiscard]] inline StartedPolicy start_policy(const std::string& name,
                                                const std::map<std::string, ParameterValue>& given,
                                                const KnobSettings& knobs = conformance_knobs(),
                                                const BoardModel& board = conformance_board()) {
  Registry registry;
  register_policies(registry);
  auto policy = registry.make<Policy>(name);
  FLYBALL_ASSERT(policy != nullptr, "no policy %s", name.c_str());
  const auto resolved = Parameters::resolve(name, policy->parameters(), given);
  FLYBALL_ASSERT(std::holds_alternative<Parameters>(resolved), "parameters of %s", name.c_str());
  Status status = policy->start(std::get<Parameters>(resolved), knobs, board);
  return {std::move(policy), std::move(status)};
}

}  // namespace flyball
