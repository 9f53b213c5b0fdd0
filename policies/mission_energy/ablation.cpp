// SPDX-License-Identifier: BSD-3-Clause
#include "ablation.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <variant>

namespace flyball {
namespace {

constexpr double no_limit = std::numeric_limits<double>::max();
constexpr double wide_open_m = 1e3;  // Farther apart than any camera sees.

}  // namespace

/// A part that is switched by a parameter of the policy says which one, and its value without it.
struct Ablation::Named {
  const char* name;
  Part part;
  const char* parameter{nullptr};
  double value{};
};

const std::vector<Ablation::Named>& Ablation::parts() {
  static const std::vector<Named> all{
      {"nothing", Part::none},
      {"search", Part::search},
      {"resolution", Part::resolution},
      {"range", Part::range},
      {"clock", Part::clock},
      {"latency_learning", Part::latency_learning, "learn_s", 1e-9},  // Over before it begins.
      {"gaps", Part::gaps},
      {"visibility", Part::visibility},
      {"ceiling", Part::ceiling},
      {"rotor_power", Part::rotor_power},
      {"declared_zones", Part::declared_zones, "narrow_m_s", 0.0},  // No limit is as low.
      {"detour_prices", Part::detour_prices},
      {"view_budgets", Part::view_budgets, "half_view_nodes", 0.0},
      {"noise_limit", Part::noise_limit},
      {"wide_first_bound", Part::wide_first_bound},
  };
  return all;
}

ParameterSpec Ablation::parameter() {
  ParameterSpec spec{"without", std::string{parts().front().name}, 0.0, 0.0,
                     "The part that is left out, to see what it earns."};
  for (const Named& one : parts()) {
    spec.choices.emplace_back(one.name);
  }
  return spec;
}

Ablation::Ablation(const Parameters& given) {
  const std::string& name = given.text("without");
  const auto found = std::find_if(parts().begin(), parts().end(),
                                  [&name](const Named& one) { return name == one.name; });
  FLYBALL_ASSERT(found != parts().end(), "without = %s", name.c_str());
  part_ = found->part;
}

Parameters Ablation::begins_with(const Parameters& given,
                                 const std::vector<ParameterSpec>& specs) const {
  auto values = given.values();
  for (const Named& one : parts()) {
    if (one.part == part_ && one.parameter != nullptr) {
      values[one.parameter] = one.value;
    }
  }
  auto changed = Parameters::resolve("mission_energy without a part", specs, values);
  FLYBALL_ASSERT(std::holds_alternative<Parameters>(changed), "part %d", static_cast<int>(part_));
  return std::get<Parameters>(std::move(changed));
}

BoardModel Ablation::begins_with(BoardModel board) const {
  if (part_ == Part::noise_limit && board.vehicle.depth_camera) {
    board.vehicle.depth_camera->rgbd_noise = false;
    board.vehicle.depth_camera->extra_noise_m = 0.0;
  }
  return board;
}

EnergySearchSettings Ablation::begins_with(EnergySearchSettings settings) const {
  if (part_ == Part::detour_prices) {
    settings.spacing_m = std::numeric_limits<double>::infinity();  // No obstacle ever comes.
  } else if (part_ == Part::wide_first_bound) {
    settings.bound.first = 0.1;  // About what a single scene's maps differ by.
    settings.bound.eta = 0.05;
  }
  return settings;
}

Observation Ablation::seen(Observation seen) const {
  if (part_ == Part::gaps) {
    seen.narrowest_gap_m = wide_open_m;
    seen.gap_distance_m = 0.0;
  } else if (part_ == Part::ceiling) {
    seen.headroom_m = 0.0;  // Nobody says.
  } else if (part_ == Part::rotor_power) {
    seen.rotor_power = Watts{0.0};  // From which nothing is learned.
  }
  return seen;
}

void Ablation::leave_one(Surroundings& around, const EnergySearch& search) {
  constexpr std::array usual_m{10.0, 15.0, 22.0, 25.0};  // Of gap_switch, finest cells first.
  const std::vector<double>& cells_m = search.cells_m();
  const std::vector<double>& ranges_m = search.ranges_m();
  const auto larger = std::upper_bound(cells_m.begin(), cells_m.end(), around.coarsest_m);
  const auto level =
      static_cast<std::size_t>(std::max(larger - cells_m.begin(), std::ptrdiff_t{1})) - 1;
  // Cells for doors are smaller than gap_switch's, and have the range of its finest.
  const auto smaller = std::lower_bound(cells_m.begin(), cells_m.end(), around.finest_m);
  const std::size_t usual =
      level - std::min(level, static_cast<std::size_t>(smaller - cells_m.begin()));
  const double most_m = std::max(search.most_range_m(cells_m[level]), around.clear_range_m);
  const auto longer =
      std::upper_bound(ranges_m.begin(), ranges_m.end(),
                       std::min(usual_m.at(std::min(usual, usual_m.size() - 1)), most_m));
  around.finest_m = cells_m[level];
  around.least_range_m = around.most_range_m =
      longer != ranges_m.begin() ? *std::prev(longer) : ranges_m.front();
  around.needs_top_clock = true;
}

void Ablation::limit(Surroundings& around, const EnergySearch& search) const {
  const std::vector<double>& ranges_m = search.ranges_m();
  if (part_ == Part::search) {
    leave_one(around, search);
  } else if (part_ == Part::resolution) {
    // The finest cells pass every gap, so they are the ones to keep.
    around.coarsest_m = around.finest_m;
  } else if (part_ == Part::range) {
    // Between those that are for slow places and those that noise does not always allow.
    around.least_range_m = around.most_range_m = ranges_m[(ranges_m.size() - 1) / 2];
  } else if (part_ == Part::clock) {
    around.needs_top_clock = true;
  } else if (part_ == Part::visibility) {
    around.visibility_m = no_limit;
  }
}

}  // namespace flyball
