// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Whether an exploration has mapped what can be seen.

#include "flyball/kernels/mapper.h"
#include "flyball/sim/world.h"

#include "simulation/judging/exploration_judge.h"
#include "simulation/judging/judge.h"
#include "simulation/mission_link.h"
#include <optional>

namespace flyball {

class MapJudge final : public Judge {
 public:
  /// All arguments outlive the judge. @param mapper  Asked when the graph has stopped.
  /// @param least_percent  Less coverage is `incomplete`; 0: any
  /// will do.
  MapJudge(MissionLink& link, const Mapper& mapper, const World& world, double least_percent)
      : link_{link}, mapper_{mapper}, world_{world}, least_percent_{least_percent} {}

  void prepare() override;
  /// A row of channel `coverage`.
  void look(MissionTime now) override;
  [[nodiscard]] MissionFailure objection() const override;
  /// `coverage_percent`, `map_precision`, `map_recall`.
  [[nodiscard]] std::map<std::string, double> figures() const override;

 private:
  MissionLink& link_;
  const Mapper& mapper_;
  const World& world_;
  double least_percent_;
  std::optional<ExplorationJudge> judge_{};  ///< Once it is prepared.
  double coverage_percent_{};
};

}  // namespace flyball
