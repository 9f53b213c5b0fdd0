// SPDX-License-Identifier: BSD-3-Clause

#include "cli/tournament/tournament_flights.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

namespace flyball {

std::string out_folder(const TournamentOptions& options) {
  return options.flight.out.empty() ? "flights/tournament" : options.flight.out;
}

FlightOptions flight_in(const TournamentOptions& options, const std::string& world) {
  FlightOptions flight = options.flight;
  flight.scenario = world;
  return flight;
}

std::string folder_of(const TournamentOptions& options, const std::string& world) {
  const auto stem_of = [](const std::string& file) { return std::filesystem::path{file}.stem(); };
  std::filesystem::path folder = stem_of(world);
  const auto here = std::find(options.worlds.begin(), options.worlds.end(), world);
  const auto same = std::count_if(options.worlds.begin(), here, [&](const std::string& other) {
    return stem_of(other) == folder;
  });
  if (same > 0) {
    folder += "_" + std::to_string(same + 1);
  }
  return (std::filesystem::path{out_folder(options)} / "flights" / folder).string();
}

std::variant<TournamentFlights, std::vector<Error>> plan_flights(
    const TournamentOptions& options,
    const std::vector<Flier>& fliers,
    const std::vector<std::uint64_t>& seeds) {
  TournamentFlights entries;
  std::vector<Error> all;
  std::set<std::string> names;
  for (const std::string& world : options.worlds) {
    const FlightOptions flight = flight_in(options, world);
    const std::size_t before = entries.size();
    for (std::size_t i = 0; i < fliers.size() * seeds.size(); ++i) {
      const Flier& flier = fliers[i / seeds.size()];
      auto planned =
          plan_flight(flight, flier.policy, seeds[i % seeds.size()], folder_of(options, world));
      if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
        add_new(*errors, all);
      } else {
        entries.push_back({{std::move(std::get<PlannedFlight>(planned)), "", {}}, flier.row});
      }
    }
    if (entries.size() > before && !names.insert(entries.back().scenario.name).second) {
      add_new({{ErrorCode::invalid_input, "--worlds has two whose name is \"" +
                                              entries.back().scenario.name +
                                              "\"; give each scenario a name of its own"}},
              all);
    }
  }
  if (!all.empty()) {
    return all;
  }
  return entries;
}

StoredBatch batch_of(const TournamentOptions& options) {
  return {out_folder(options), options.jobs, options.keeps_records, true};
}

}  // namespace flyball
