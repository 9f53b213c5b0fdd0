// SPDX-License-Identifier: BSD-3-Clause
#include "flyball/flight/navigation/guidance.h"

#include <utility>

namespace flyball {

void Guidance::declare(NodeSpec& spec) const {
  spec.reads.push_back(topics_.state.index);
  spec.writes.push_back(topics_.command.index);
}

std::shared_ptr<const NavigatorState> Guidance::state(JobContext& job) const {
  auto newest = job.latest(topics_.state);
  return newest && newest->obeyed >= sent_ ? newest : nullptr;
}

void Guidance::send(JobContext& job, std::variant<HoverAt, GoTo, NoGoal> what) {
  job.publish(topics_.command, GuidanceCommand{++sent_, std::move(what)});
}

}  // namespace flyball
