// SPDX-License-Identifier: BSD-3-Clause

#include "cli/reproduce/experiment_flights.h"

#include "cli/sweep/sweep_flights.h"
#include <algorithm>
#include <map>

namespace flyball {
namespace {

/// The same settings in the same order, whichever of them were axes.
std::string sorted_settings(const ExperimentSweep& sweep, const SweepPoint& point) {
  std::vector<std::string> settings = sweep.settings;
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    settings.push_back(sweep.axes[i].key + "=" + point.values[i]);
  }
  std::sort(settings.begin(), settings.end());
  std::string text;
  for (const std::string& setting : settings) {
    text += (text.empty() ? "" : " ") + setting;
  }
  return text;
}

std::vector<std::uint64_t> seeds_of(const ExperimentSweep& sweep, std::size_t asked) {
  const std::size_t share = std::max<std::size_t>(asked / sweep.one_seed_in, 1);
  const std::size_t count = sweep.most_seeds == 0 ? share : std::min(share, sweep.most_seeds);
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = sweep.first_seed; seeds.size() < count; ++seed) {
    seeds.push_back(seed);
  }
  return seeds;
}

/// The scenario's name and, where the sweep names no policy, its policy.
std::variant<SweepRequest, std::vector<Error>> request_of(const ReproduceRequest& request,
                                                          const NamedExperiment& named,
                                                          const ExperimentSweep& sweep) {
  std::vector<std::string> settings = sweep.settings;
  for (const SweepAxis& axis : sweep.axes) {  // Without an axis a scenario may be incomplete.
    settings.push_back(axis.key + "=" + axis.values.front());
  }
  auto loaded = load_scenario(sweep.scenario, settings);
  if (auto* errors = std::get_if<std::vector<Error>>(&loaded)) {
    return std::move(*errors);
  }
  const Scenario& scenario = std::get<LoadedScenario>(loaded).scenario;
  SweepRequest wanted;
  wanted.flight.scenario = sweep.scenario;
  wanted.flight.settings = sweep.settings;
  wanted.plan = {scenario.name, sweep.axes, sweep.policies, seeds_of(sweep, request.seeds)};
  if (wanted.plan.policies.empty()) {
    wanted.plan.policies.push_back(scenario.governor.policy);
  }
  wanted.batch = request.batch;
  wanted.batch.folder += "/" + named.name + "/" + sweep.name;
  return wanted;
}

/// Gathers flights, each once.
class Gathering {
 public:
  explicit Gathering(const ReproduceRequest& request) : request_{request} {}

  void add(std::size_t experiment, const ExperimentSweep& sweep) {
    auto read = request_of(request_, request_.experiments[experiment], sweep);
    if (const auto* errors = std::get_if<std::vector<Error>>(&read)) {
      return refuse(*errors);
    }
    const SweepRequest& wanted = std::get<SweepRequest>(read);
    auto planned = plan_sweep(wanted);
    if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
      return refuse(*errors);
    }
    const std::vector<SweepPoint> points = points_of(sweep.axes, wanted.plan.policies);
    PlannedSweep result{experiment, sweep.name, wanted.plan, command_of_sweep(wanted),
                        point_commands(wanted)};
    auto& flights = std::get<std::vector<StoredFlight>>(planned);
    for (std::size_t i = 0; i < flights.size(); ++i) {
      flights[i].settings = sorted_settings(sweep, points[i / wanted.plan.seeds.size()]);
      result.flights.push_back(number_of(std::move(flights[i])));
    }
    gathered_.sweeps.push_back(std::move(result));
  }

  [[nodiscard]] std::variant<ExperimentFlights, std::vector<Error>> take() {
    if (!errors_.empty()) {
      return errors_;
    }
    return std::move(gathered_);
  }

 private:
  static std::string command_of_sweep(const SweepRequest& wanted) {
    return wanted.plan.axes.empty() && wanted.plan.policies.size() == 1
               ? point_commands(wanted).front()
               : shell_text(sweep_words(wanted));
  }

  std::size_t number_of(StoredFlight flight) {
    const std::string key = flight.scenario.name + "\n" + name_of(flight) + "\n" + flight.settings;
    const auto [known, is_new] = numbers_.emplace(key, gathered_.flights.size());
    if (is_new) {
      gathered_.flights.push_back(std::move(flight));
    }
    return known->second;
  }

  void refuse(const std::vector<Error>& errors) {
    for (const Error& error : errors) {
      const bool is_known = std::any_of(errors_.begin(), errors_.end(), [&](const Error& other) {
        return other.message == error.message;
      });
      if (!is_known) {
        errors_.push_back(error);
      }
    }
  }

  const ReproduceRequest& request_;
  ExperimentFlights gathered_{};
  std::map<std::string, std::size_t> numbers_{};
  std::vector<Error> errors_{};
};

Sweep flown_sweep(const PlannedSweep& planned, const std::vector<StoredFlight>& flights) {
  std::vector<SweepFlight> flown;
  for (std::size_t i = 0; i < planned.flights.size(); ++i) {
    const StoredFlight& flight = flights[planned.flights[i]];
    flown.push_back({i / planned.plan.seeds.size(), command_of(flight), *flight.summary});
  }
  return sweep_of(planned.plan, planned.point_commands, std::move(flown));
}

}  // namespace

std::variant<ExperimentFlights, std::vector<Error>> plan_experiments(
    const ReproduceRequest& request) {
  Gathering gathering{request};
  for (std::size_t i = 0; i < request.experiments.size(); ++i) {
    for (const ExperimentSweep& sweep : request.experiments[i].experiment.sweeps) {
      gathering.add(i, sweep);
    }
  }
  return gathering.take();
}

std::vector<ExperimentResult> results_of(const ReproduceRequest& request,
                                         const ExperimentFlights& flown) {
  std::vector<ExperimentResult> results;
  for (std::size_t i = 0; i < request.experiments.size(); ++i) {
    ExperimentResult result;
    result.named = request.experiments[i];
    for (const PlannedSweep& planned : flown.sweeps) {
      if (planned.experiment == i) {
        result.sweeps[planned.name] = flown_sweep(planned, flown.flights);
        result.commands[planned.name] = planned.command;
      }
    }
    evaluate(result);
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace flyball
