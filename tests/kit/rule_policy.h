// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// A policy that is one function of what is seen, and two knobs for it to turn.

#include "flyball/governors/policy.h"

#include <functional>
#include <utility>
#include <vector>

namespace flyball::kit {

using Rule = std::function<Decision(const Observation&)>;

class RulePolicy final : public Policy {
 public:
  explicit RulePolicy(Rule rule) : rule_{std::move(rule)} {}
  [[nodiscard]] std::vector<ParameterSpec> parameters() const override { return {}; }
  Status start(const Parameters& /*given*/,
               const KnobSettings& /*knobs*/,
               const BoardModel& /*board*/) override {
    return Done{};
  }
  [[nodiscard]] Decision decide(const Observation& seen) noexcept override { return rule_(seen); }

 private:
  Rule rule_;
};

/// A map's resolution, .15, .30 or .80 m, and its range, 2 to 10 m. They stand at .15 and 7 m.
inline KnobSettings map_knobs() {
  return KnobSettings{{{"map.resolution_m", "m", "mapper", {0.15, 0.30, 0.80}, 0.0, 0.0, 0.15, ""},
                       {"map.range_m", "m", "mapper", {}, 2.0, 10.0, 7.0, ""}}};
}

}  // namespace flyball::kit
