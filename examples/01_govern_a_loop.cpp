// SPDX-License-Identifier: BSD-3-Clause
//
// Govern a loop of your own: your sensor, your kernel, your knob; a policy that Flyball has.
// A vehicle flies 60 m over open ground with sparse pillars, then 60 m through a thicket. Its
// kernel maps what lies around it, the finer the dearer. The program checks that the governor kept
// the map coarse in the open and fine in the thicket, and that this saved a third of the work.

#include "flyball/governors/policy_governor.h"
#include "flyball/policies/policies.h"
#include "flyball/runtime/random.h"
#include "flyball/runtime/registry.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

namespace {

using Point = std::pair<double, double>;  // x, y in the world [m]

constexpr double range_m = 7.0;

/// Pillars of .4 m: one in 100 square metres in the open, one in 6 in the thicket (x > 60 m).
std::vector<Point> surfaces() {
  flyball::RandomStream draw{1, "pillars"};
  std::vector<Point> points;
  const auto add_pillar = [&points](double x_m, double y_m) {
    for (int i = 0; i < 36; ++i) {
      const double angle_rad = 0.1745 * i;
      points.emplace_back(x_m + 0.2 * std::cos(angle_rad), y_m + 0.2 * std::sin(angle_rad));
    }
  };
  for (int i = 0; i < 12; ++i) {
    add_pillar(draw.uniform(0.0, 60.0), draw.uniform(-10.0, 10.0));
  }
  for (int i = 0; i < 200; ++i) {
    add_pillar(draw.uniform(60.0, 120.0), draw.uniform(-10.0, 10.0));
  }
  return points;
}

struct LocalMap {
  std::size_t cells{};     ///< That were updated: what the kernel costs.
  std::size_t occupied{};  ///< Among them.
};

/// The kernel: a square grid around the vehicle; a cell is occupied when it holds a surface point.
LocalMap map_around(const std::vector<Point>& points, double x_m, double cell_m) {
  const auto side = static_cast<std::size_t>(std::ceil(2.0 * range_m / cell_m));
  std::vector<bool> grid(side * side);
  for (const auto& [px_m, py_m] : points) {
    const double column = (px_m - x_m + range_m) / cell_m;
    const double row = (py_m + range_m) / cell_m;
    const auto is_inside = [side](double i) { return i >= 0.0 && i < static_cast<double>(side); };
    if (is_inside(column) && is_inside(row)) {
      grid[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)] = true;
    }
  }
  return {grid.size(), static_cast<std::size_t>(std::count(grid.begin(), grid.end(), true))};
}

flyball::Observation observe(const std::vector<Point>& points, double x_m, double t_s) {
  const LocalMap columns = map_around(points, x_m, 0.8);
  flyball::Observation seen;
  seen.now = flyball::MissionTime{flyball::from_seconds(t_s)};
  seen.phase = flyball::MissionPhase::cruise;  // A governor refuses to guess it.
  seen.obstacle_density =
      static_cast<double>(columns.occupied) / static_cast<double>(columns.cells);
  return seen;
}

/// A governor for the knob, with the policy `density` at its default parameters.
std::unique_ptr<flyball::PolicyGovernor> make_governor(const flyball::KnobSettings& knobs) {
  flyball::Registry registry;
  flyball::register_policies(registry);
  auto policy = registry.make<flyball::Policy>("density");
  if (policy == nullptr) {
    return nullptr;
  }
  const auto parameters = flyball::Parameters::resolve("density", policy->parameters(), {});
  // Of the computer nothing is known: `{}` does for a policy that does not reckon with its power.
  const auto started = policy->start(std::get<flyball::Parameters>(parameters), knobs, {});
  if (!started) {
    std::printf("wrong: %s\n", started.error().message.c_str());
    return nullptr;
  }
  // The clock is the watchdog's: an answer that comes too late is not followed.
  return std::make_unique<flyball::PolicyGovernor>(
      std::move(policy), knobs, flyball::PolicyGovernorSettings{}, std::chrono::steady_clock::now);
}

struct Flight {
  std::vector<double> open_m{};     ///< Cell size at each step in the open, ...
  std::vector<double> thicket_m{};  ///< ... and in the thicket.
  std::size_t cells{};              ///< Cells that the kernel updated, governed, ...
  std::size_t cells_if_fine{};      ///< ... and had it always been fine.
};

Flight fly(flyball::PolicyGovernor& governor, flyball::KnobSettings knobs) {
  constexpr double speed_m_s = 2.0;
  constexpr double period_s = 0.25;
  const auto points = surfaces();
  Flight flight;
  for (double t_s = 0.0; t_s * speed_m_s < 120.0; t_s += period_s) {
    const double x_m = t_s * speed_m_s;
    for (const auto& [knob, value] : governor.decide(observe(points, x_m, t_s))) {
      if (!knobs.set(knob, value).ok()) {
        return {};
      }
    }
    const double cell_m = knobs.value("map.resolution_m");
    flight.cells += map_around(points, x_m, cell_m).cells;
    flight.cells_if_fine += map_around(points, x_m, 0.15).cells;
    (x_m < 60.0 - range_m ? flight.open_m : flight.thicket_m).push_back(cell_m);
  }
  return flight;
}

double share_of(const std::vector<double>& all, double value) {
  double count = 0.0;
  for (const double one : all) {
    count += one == value ? 1.0 : 0.0;
  }
  return all.empty() ? 0.0 : count / static_cast<double>(all.size());
}

}  // namespace

int main() {
  const flyball::KnobSettings knobs{
      {{"map.resolution_m", "m", "my_kernel", {0.15, 0.80}, 0.15, 0.80, 0.15, "Edge of a cell"}}};
  const auto governor = make_governor(knobs);
  if (governor == nullptr) {
    std::puts("wrong: no policy \"density\" that takes this knob");
    return 1;
  }
  const Flight flight = fly(*governor, knobs);
  const double coarse = share_of(flight.open_m, 0.80);
  const double fine = share_of(flight.thicket_m, 0.15);
  std::printf("open: coarse %.0f %% of the time; thicket: fine %.0f %% of the time\n",
              100.0 * coarse, 100.0 * fine);
  std::printf("cells updated: %zu, always fine: %zu\n", flight.cells, flight.cells_if_fine);
  const bool right = coarse > 0.7 && fine > 0.7 && 3 * flight.cells < 2 * flight.cells_if_fine;
  std::puts(right ? "right" : "wrong");
  return right ? 0 : 1;
}
