// SPDX-License-Identifier: BSD-3-Clause
//
// Battery and rotors together: how long a Matrice 100 hovers, beside what its maker says, and what
// payload and wind do to it.

#include "flyball/scenario/files.h"
#include "flyball/sim/battery.h"
#include "flyball/sim/rotor_power.h"

#include "experiments/framework/papers.h"
#include "experiments/framework/plots_of.h"

namespace flyball::experiments {
namespace {

constexpr const char* maker = "maker's data sheet, hover without a companion computer";
constexpr double large_pack_ah = 5.7;  // TB48D; the airframe's file has the TB47D.

double hover_minutes(const Airframe& airframe, double payload_kg) {
  constexpr double step_s = 0.1;
  RegressionPower power{airframe};
  Battery battery{airframe.battery_cells, airframe.battery_ah};
  VehicleState hovering;
  hovering.rotor_rev_s.fill(1.0);  // Eq. 1 only asks whether they turn.
  double time_s = 0.0;
  while (!battery.is_empty()) {
    battery.draw(power.update(hovering, payload_kg, Vec3::Zero(), step_s), step_s);
    time_s += step_s;
  }
  return time_s / 60.0;
}

struct Row {
  const char* pack;
  double payload_kg;
  double maker_min;
};

constexpr Row rows[] = {{"TB47D", 0.0, 22.0}, {"TB47D", 0.5, 17.0}, {"TB47D", 1.0, 13.0},
                        {"TB48D", 0.0, 28.0}, {"TB48D", 0.5, 20.0}, {"TB48D", 1.0, 16.0}};

/// How long the whole charge would last at the flight's mean use of it.
std::optional<double> minutes_of_charge(const Summary& flight) {
  const double used = flight.battery_used_percent();
  return used > 0.0 ? std::optional{100.0 / used * flight.mission_time_s / 60.0} : std::nullopt;
}

PlotOf over_wind(const std::string& sweep, const std::string& model) {
  PlotOf wanted{sweep, "minutes of hover, " + model, minutes_of_charge};
  wanted.x.title = "wind, m/s";
  wanted.y.values = {"0 kg", "0.5 kg", "1 kg"};
  return wanted;
}

Result<Findings> evaluate(const Evidence& evidence) {
  const auto file = find_shipped("airframes", "matrice_100");
  if (!file) {
    return file.error();
  }
  auto airframe = load_airframe(*file);
  if (!airframe) {
    return airframe.error();
  }
  const double small_pack_ah = airframe->battery_ah;
  Findings findings;
  for (const Row& row : rows) {
    airframe->battery_ah = row.pack == std::string{"TB48D"} ? large_pack_ah : small_pack_ah;
    Claim claim{std::string{row.pack} + ", " +
                    (row.payload_kg == 0.0   ? "no payload"
                     : row.payload_kg == 0.5 ? ".5 kg"
                                             : "1 kg"),
                "min"};
    claim.paper = PaperValue{row.maker_min, maker};
    claim.ours = computed(hover_minutes(*airframe, row.payload_kg));
    findings.claims.push_back(claim);
  }
  for (const auto& [sweep, model] :
       {std::pair{"regression", "eq. 1 (regression)"}, std::pair{"thrust", "rotor thrust"}}) {
    Claim computer{std::string{"in flight, no wind, no payload, with a computer, "} + model, "min"};
    computer.ours = median(evidence.at(sweep, {"0", "0"}), minutes_of_charge);
    findings.claims.push_back(computer);
    const PlotOf wanted = over_wind(sweep, model);
    findings.figures.push_back(
        {sweep, counts_text(evidence, wanted), line_plot_of(evidence, wanted)});
  }
  return findings;
}

}  // namespace

Experiment endurance() {
  Experiment experiment{
      "How long does the battery last?",
      "DJI's figures for the Matrice 100",
      "Hover until the battery is empty, computed from eq. 1 and the battery's model for two packs "
      "and "
      "three payloads, without a computer, as the maker has it. Then flown for a minute with the "
      "computer, in wind, with both models of rotor power, and extended at the mean use of charge.",
      {"The resistance of the battery's cells, by one factor, to the three figures of the TB47D."},
      {},
      evaluate};
  for (const char* model : {"regression", "thrust"}) {
    experiment.sweeps.push_back(
        {model,
         "watch_hovering",
         {"watch.time_s=60", std::string{"vehicle.rotor_power="} + model},
         {{"vehicle.payload_kg", {"0", "0.5", "1"}}, {"vehicle.wind_east_m_s", {"0", "5", "10"}}},
         {"fixed_fine"},
         1,
         1});
  }
  return experiment;
}

}  // namespace flyball::experiments
