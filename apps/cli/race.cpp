// SPDX-License-Identifier: BSD-3-Clause

#include "race.h"

#include "flyball/records/report.h"

#include <algorithm>
#include <utility>

namespace flyball {

/// One candidate with one seed.
struct Race::Heat : StoredFlight {
  Candidate* candidate{};
};

Race::Race(RaceSettings settings, FlightStore& store)
    : settings_{std::move(settings)}, store_{store} {}

/// Under a name that says its parameters: the same candidate has the same file.
std::string Race::preset_file(const Candidate& candidate) const {
  std::string name = settings_.policy;
  for (const auto& [parameter, value] : candidate.parameters) {
    std::string number = std::to_string(value);
    std::replace(number.begin(), number.end(), '.', '_');
    name += "-" + parameter + "-" + number;
  }
  return settings_.presets + "/" + name + ".toml";
}

Status Race::write_preset(const Candidate& candidate) const {
  const auto prepared = prepare_folder(settings_.presets);
  if (!prepared) {
    return prepared.error();
  }
  return write_file(preset_file(candidate),
                    preset_text(settings_.policy, "A candidate of a race", candidate));
}

std::variant<std::vector<Race::Heat>, std::vector<Error>> Race::plan(
    const std::vector<Candidate*>& candidates, std::size_t seeds) const {
  std::vector<Heat> heats;
  for (Candidate* candidate : candidates) {
    if (const Status written = write_preset(*candidate); !written) {
      return std::vector{written.error()};
    }
    const std::string file = preset_file(*candidate);
    for (std::size_t k = candidate->flights.size(); k < seeds; ++k) {
      auto planned = plan_flight(settings_.flight, file, settings_.seeds[k], settings_.flights);
      if (auto* errors = std::get_if<std::vector<Error>>(&planned)) {
        return std::move(*errors);
      }
      heats.push_back({{std::move(std::get<PlannedFlight>(planned)), "", std::nullopt}, candidate});
    }
  }
  return heats;
}

std::optional<int> Race::fly(const std::vector<Candidate*>& candidates, std::size_t seeds) {
  auto planned = plan(candidates, seeds);
  if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
    return refuse(*errors);
  }
  auto& heats = std::get<std::vector<Heat>>(planned);
  const Flown flown = fly_stored(settings_.batch, store_, pointers_to(heats));
  if (const std::optional<int> code = unfinished(flown)) {
    return code;
  }
  for (const Heat& heat : heats) {
    heat.candidate->flights.push_back(*heat.summary);
  }
  return std::nullopt;
}

std::optional<int> Race::halve(std::vector<Candidate>& candidates, RaceOrder is_better) {
  for (const TuningRound& round : tuning_rounds(candidates.size(), settings_.seeds.size())) {
    note("round: " + std::to_string(round.candidates) + " settings, " +
         std::to_string(round.seeds) + " seeds");
    std::vector<Candidate*> flying;
    for (std::size_t i = 0; i < round.candidates; ++i) {
      flying.push_back(&candidates[i]);
    }
    if (const std::optional<int> code = fly(flying, round.seeds)) {
      return code;
    }
    std::stable_sort(candidates.begin(),
                     candidates.begin() + static_cast<std::ptrdiff_t>(round.candidates), is_better);
  }
  return std::nullopt;
}

}  // namespace flyball
