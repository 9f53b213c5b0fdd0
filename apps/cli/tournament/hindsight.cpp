// SPDX-License-Identifier: BSD-3-Clause

#include "cli/tournament/hindsight.h"

#include "flyball/scenario/knobs.h"

#include <algorithm>
#include <utility>

namespace flyball {
namespace {

/// The candidates with all seeds stand in front, best first.
struct Search {
  Race& race;
  const std::vector<GridAxis>& grid;
  std::vector<Candidate> flown;
};

Candidate* find_in(std::vector<Candidate>& all, const Candidate& wanted) {
  const auto found = std::find_if(all.begin(), all.end(), [&wanted](const Candidate& one) {
    return one.parameters == wanted.parameters;
  });
  return found == all.end() ? nullptr : &*found;
}

/// Seed by seed, so that those that have lost fly no further.
std::optional<int> fly_until_lost(Search& search, std::vector<Candidate*> flying) {
  const Candidate& best = search.flown.front();
  const std::size_t seeds = best.flights.size();
  for (std::size_t k = 1; k <= seeds && !flying.empty(); ++k) {
    if (const std::optional<int> code = search.race.fly(flying, k)) {
      return code;
    }
    flying.erase(std::remove_if(flying.begin(), flying.end(),
                                [&best](const Candidate* one) { return has_lost(*one, best); }),
                 flying.end());
  }
  return std::nullopt;
}

/// @return Why it did not fly, or, empty, whether one of the neighbours is `better` now.
std::optional<int> step(Search& search, bool& is_better) {
  const Candidate before = search.flown.front();
  const std::vector<Candidate> wanted = neighbours_of(search.grid, before);
  for (const Candidate& one : wanted) {
    if (find_in(search.flown, one) == nullptr) {
      search.flown.push_back(one);
    }
  }
  std::vector<Candidate*> flying;
  for (const Candidate& one : wanted) {
    Candidate* const known = find_in(search.flown, one);
    if (known->flights.size() < before.flights.size() && !has_lost(*known, before)) {
      flying.push_back(known);
    }
  }
  if (const std::optional<int> code = fly_until_lost(search, std::move(flying))) {
    return code;
  }
  const auto whole = std::stable_partition(
      search.flown.begin(), search.flown.end(),
      [&before](const Candidate& one) { return one.flights.size() == before.flights.size(); });
  std::stable_sort(search.flown.begin(), whole, is_better_in_hindsight);
  is_better = search.flown.front().parameters != before.parameters;
  return std::nullopt;
}

std::optional<int> find_best(Search& search) {
  constexpr int most_steps = 8;  // Chosen: twice across the grid's longest axis.
  if (const std::optional<int> code = search.race.halve(search.flown, is_better_in_hindsight)) {
    return code;
  }
  bool is_better = true;
  for (int i = 0; i < most_steps && is_better; ++i) {
    if (const std::optional<int> code = step(search, is_better)) {
      return code;
    }
  }
  return std::nullopt;
}

Result<std::vector<GridAxis>> grid_of(const FlightOptions& flight) {
  auto loaded = load_scenario(flight.scenario, flight.settings, flight.plugins);
  if (const auto* errors = std::get_if<std::vector<Error>>(&loaded)) {
    return errors->front();
  }
  auto knobs = standard_knobs(std::get<LoadedScenario>(loaded).scenario);
  if (!knobs) {
    return knobs.error();
  }
  return hindsight_grid(KnobSettings{std::move(*knobs)});
}

}  // namespace

std::variant<BestSetting, int> find_best_setting(RaceSettings settings, FlightStore& store) {
  const auto grid = grid_of(settings.flight);
  if (!grid) {
    return refuse({grid.error()});
  }
  Race race{std::move(settings), store};
  Search search{race, *grid, settings_of(*grid)};
  if (const std::optional<int> code = find_best(search)) {
    return *code;
  }
  const Candidate& best = search.flown.front();
  BestSetting found{told_in_hindsight(*grid, best, search.flown), best.flights};
  found.told.preset = race.preset_file(best);
  for (Summary& flight : found.flights) {
    flight.policy = fixed_best;
  }
  return found;
}

}  // namespace flyball
