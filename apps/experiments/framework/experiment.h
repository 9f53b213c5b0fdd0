// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// One experiment: which flights it needs, what it makes of them, and what a paper says about it.

#include "flyball/runtime/result.h"

#include "experiments/framework/claim.h"
#include "experiments/framework/evidence.h"
#include "experiments/framework/figure.h"
#include <functional>
#include <string>
#include <vector>

namespace flyball {

/// Flights of one scenario: every policy with every combination of the axes' values, once for each
/// seed.
struct ExperimentSweep {
  std::string name{};  ///< Within its experiment; `Evidence::sweep` asks for it.
  std::string scenario{};
  std::vector<std::string> settings{};  ///< `KEY=VALUE`, of all its flights.
  std::vector<SweepAxis> axes{};        ///< May be empty: then a policy has one point.
  std::vector<std::string> policies{};  ///< Empty: that of the scenario.
  std::uint64_t first_seed{1};
  std::size_t most_seeds{};    ///< Where flights take the host long; 0: as many as were asked for.
  std::size_t one_seed_in{1};  ///< 3: a third of those that were asked for, but at least one.
};

/// What an experiment found.
struct Findings {
  std::vector<Claim> claims{};  ///< The first one stands for the experiment on the first page.
  std::vector<Figure> figures{};
  std::vector<std::string> notes{};  ///< Sentences, with the numbers that they need.
};

/// What an experiment is. It does not know how its flights are flown.
struct Experiment {
  std::string title{};   ///< A question.
  std::string source{};  ///< The paper; empty: the experiment is ours.
  std::string method{};  ///< What is swept and what is measured, in sentences.
  /// What was fitted to a figure that a claim below repeats, so that its agreement is no news.
  std::vector<std::string> fitted{};
  std::vector<ExperimentSweep> sweeps{};  ///< Empty where everything is computed.
  /// From the flights to the findings; also computes what needs no flight. It must not depend on
  /// anything but the evidence and shipped data, for a continued command writes the same tables.
  std::function<Result<Findings>(const Evidence&)> evaluate{};
};

}  // namespace flyball
