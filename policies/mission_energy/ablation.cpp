// SPDX-License-Identifier: BSD-3-Clause
#include "ablation.h"

#include "flyball/runtime/assert.h"

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

namespace flyball {
namespace {

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
      {"resolution", Part::resolution},
      {"range", Part::range},
      {"clock", Part::clock},
      {"latency_learning", Part::latency_learning, "learn_s", 1e-9},  // Over at the second look.
      {"gaps", Part::gaps},
      {"ceiling", Part::ceiling},
      {"rotor_power", Part::rotor_power},
      {"declared_zones", Part::declared_zones, "narrow_m_s", 0.0},  // No limit is as low.
      {"view_budgets", Part::view_budgets, "half_view_nodes", 0.0},
      {"view_threads", Part::view_threads, "view_threads", 1.0},
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

LearnedLatencySettings Ablation::begins_with(LearnedLatencySettings settings) const {
  if (part_ == Part::wide_first_bound) {
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

MapSetting Ablation::map(const MapRule& rule, MapNeeds needs, const LearnedLatency& latency) const {
  if (part_ == Part::resolution) {
    needs.cells_m = rule.finest_m();  // They pass every gap, so they are the ones to keep.
  }
  MapSetting setting = rule.setting(needs, latency);
  if (part_ == Part::range) {
    setting.range_m = rule.range_m();
  }
  return setting;
}

}  // namespace flyball
