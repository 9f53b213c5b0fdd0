// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Starts any policy with parameters of a test's choice.

#include "flyball/governors/policy_conformance.h"

namespace flyball::kit {

using GivenParameters = std::map<std::string, ParameterValue>;

/// @pre The parameters are within their own bounds.
[[nodiscard]] inline Status start(Policy& policy,
                                  const GivenParameters& given = {},
                                  const KnobSettings& knobs = conformance_knobs(),
                                  const BoardModel& board = conformance_board()) {
  const auto resolved = Parameters::resolve("policy", policy.parameters(), given);
  FLYBALL_ASSERT(std::holds_alternative<Parameters>(resolved), "parameters of a test's policy");
  return policy.start(std::get<Parameters>(resolved), knobs, board);
}

/// What its host says of a policy's code; empty for a policy that hosts none.
[[nodiscard]] inline std::string_view trouble(const Policy& policy) {
  const auto* host = dynamic_cast<const HostsCode*>(&policy);
  return host != nullptr ? host->trouble() : std::string_view{};
}
[[nodiscard]] inline std::string_view remark(const Policy& policy) {
  const auto* host = dynamic_cast<const HostsCode*>(&policy);
  return host != nullptr ? host->remark() : std::string_view{};
}

/// How often it wants to be asked; empty for a policy that does not say.
[[nodiscard]] inline std::optional<Duration> period(const Policy& policy) {
  const auto* chooses = dynamic_cast<const ChoosesPeriod*>(&policy);
  return chooses != nullptr ? chooses->period() : std::nullopt;
}

/// The wish for one knob; none when the policy does not name it.
[[nodiscard]] inline std::optional<double> wish_for(const Decision& decision,
                                                    std::string_view knob) {
  for (const auto& [name, value] : decision) {
    if (name == knob) {
      return value;
    }
  }
  return std::nullopt;
}

}  // namespace flyball::kit
