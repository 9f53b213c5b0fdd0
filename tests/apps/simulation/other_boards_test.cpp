// SPDX-License-Identifier: BSD-3-Clause
//
// mission_energy on platform files of other computers. A vehicle cruises at the mission's own limit
// of speed, so latency buys it nothing; its computer takes the time and the watts of the platform
// file. What the policy then chooses is held against all clocks, by the file's own power.
#include "flyball/governors/clock_search.h"
#include "flyball/runtime/board.h"
#include "flyball/scenario/files.h"
#include "flyball/sim/platform_file.h"

#include "cruising.h"
#include "policy_start.h"
#include "scratch_folder.h"
#include "started_policy.h"
#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>

#include <gtest/gtest.h>

namespace flyball {
namespace {

constexpr double limit_m_s = 3.0;
constexpr double deceleration_m_s2 = 3.0;
constexpr double other_core_ghz = 0.8;  // Work beside the map.

/// The TX2's file with other numbers, by the key in front of them.
PlatformModel tx2_with(const std::map<std::string, double>& numbers) {
  std::ifstream in{find_shipped("platforms", "jetson_tx2").value()};
  std::string text{std::istreambuf_iterator<char>{in}, {}};
  for (const auto& [key, value] : numbers) {
    const std::size_t begin = text.find("\n" + key + " = ") + 1;
    text.replace(begin, text.find('#', begin) - begin, key + " = " + std::to_string(value) + " ");
  }
  const ScratchFolder folder;
  return *load_platform(folder.file("other.toml", text));
}

PlatformModel tx2() {
  return tx2_with({});
}
/// Its cores take three times the TX2's power.
PlatformModel hungry() {
  return tx2_with({{"core_linear_w", 3.0 * 0.11}, {"core_cubic_w", 3.0 * 0.095}});
}
/// A higher clock costs it nothing.
PlatformModel free_clock() {
  return tx2_with({{"core_linear_w", 0.0},
                   {"core_cubic_w", 0.0},
                   {"cpu_linear_w", 0.0},
                   {"memory_linear_w", 0.0}});
}

struct Vehicle {
  double rotor_w{};
  double map_s{};  ///< Of a map at the top clock, of any cells and range.
};

/// The true flight: what a setting takes.
class Truth {
 public:
  Truth(const PlatformModel& model, const Vehicle& vehicle) : platform_{model}, vehicle_{vehicle} {}

  [[nodiscard]] double map_s(double clock_hz) const {
    const ClockScaling scaling = LearnedLatencySettings{}.clock;
    return vehicle_.map_s * scaling.factor(Hertz{clock_hz}) /
           scaling.factor(platform_.frequencies().back());
  }
  /// The mapper has always a core to itself: a map takes longer than the next frame needs to come.
  [[nodiscard]] static double busy_cores(double clock_hz) {
    return 1.0 + other_core_ghz / (1e-9 * clock_hz);
  }
  [[nodiscard]] double response_s(double clock_hz) const {
    return 2.0 * map_s(clock_hz) + ClockSearchSettings{}.reaction_s;
  }
  [[nodiscard]] double joules_per_m(const MapSetting& setting) const {
    const double response = response_s(setting.clock_hz);
    const double speed_m_s =
        std::min(limit_m_s, safe_speed(deceleration_m_s2, response, free_ahead_m(setting, 1e9)));
    const Watts computer =
        platform_.power({4, Hertz{setting.clock_hz}}, busy_cores(setting.clock_hz));
    return joules_per_metre(Watts{vehicle_.rotor_w}, computer, speed_m_s);
  }
  /// All clocks are gone through. The highest one, if no other takes 2 % less; else, of those
  /// within a thousandth of the least energy, the one that responds soonest, which is the highest.
  [[nodiscard]] double best_hz(MapSetting setting) const {
    double least_j = std::numeric_limits<double>::infinity();
    for (const Hertz clock : platform_.frequencies()) {
      setting.clock_hz = clock.value();
      least_j = std::min(least_j, joules_per_m(setting));
    }
    const auto highest_within = [&](double share) {
      double best = 0.0;
      for (const Hertz clock : platform_.frequencies()) {
        setting.clock_hz = clock.value();
        best = joules_per_m(setting) <= (1.0 + share) * least_j ? clock.value() : best;
      }
      return best;
    };
    const double top_hz = platform_.frequencies().back().value();
    return highest_within(0.02) == top_hz ? top_hz : highest_within(0.001);
  }

 private:
  ModeledPlatform platform_;
  Vehicle vehicle_;
};

KnobSettings knobs_of(const PlatformModel& model) {
  std::vector<KnobSpec> all = conformance_knobs().specs();
  for (KnobSpec& spec : all) {
    if (spec.name == "cpu.frequency_hz") {
      spec.legal.clear();
      for (const Hertz clock : model.frequencies) {
        spec.legal.push_back(clock.value());
      }
    }
  }
  return KnobSettings{all};
}

/// What it has chosen after two minutes of flight, long after everything has been learned.
MapSetting settled(const PlatformModel& model, const BoardModel& board, const Vehicle& vehicle) {
  const StartedPolicy started = start_policy("mission_energy",
                                             {{"fine_latency_s", vehicle.map_s},
                                              {"coarse_latency_s", vehicle.map_s},
                                              {"most_range_m", 8.0}},
                                             knobs_of(model), board);
  EXPECT_TRUE(started.status.ok());
  const Truth truth{model, vehicle};
  Observation seen = kit::cruising();
  seen.speed_m_s = seen.speed_limit_m_s = limit_m_s;
  seen.max_deceleration_m_s2 = deceleration_m_s2;
  seen.rotor_power = Watts{vehicle.rotor_w};
  MapSetting chosen{0.15, 7.0, model.frequencies.back().value()};
  for (int i = 0; i < 80; ++i) {
    seen.now += std::chrono::milliseconds{1500};  // Every map is a new one.
    ++seen.map_revision;
    seen.map_resolution_m = chosen.resolution_m;
    seen.known_free_m = chosen.range_m - chosen.resolution_m;
    seen.latency = from_seconds(truth.map_s(chosen.clock_hz));
    seen.frequency = Hertz{chosen.clock_hz};
    seen.busy_cores = Truth::busy_cores(chosen.clock_hz);
    const Decision decision = started.policy->decide(seen);
    chosen = {*kit::wish_for(decision, "map.resolution_m"), *kit::wish_for(decision, "map.range_m"),
              *kit::wish_for(decision, "cpu.frequency_hz")};
  }
  return chosen;
}

struct Flown {
  Flown(const PlatformModel& model, const Vehicle& vehicle)
      : setting{settled(model, board_model_of(model), vehicle)},
        best_hz{Truth{model, vehicle}.best_hz(setting)} {}
  MapSetting setting;
  double best_hz;  ///< Of all clocks, by the platform's own power.
};

// Light ones, whose computer is a good part of the load, and a heavy one.
const std::vector<Vehicle> vehicles{{20.0, 0.06}, {20.0, 0.15}, {100.0, 0.1}, {350.0, 0.15}};

TEST(MissionEnergyOnOtherBoards, chooses_the_clock_that_an_exhaustive_search_finds) {
  for (const PlatformModel& model : {tx2(), hungry(), free_clock()}) {
    for (const Vehicle& vehicle : vehicles) {
      const Flown flown{model, vehicle};
      EXPECT_EQ(flown.setting.clock_hz, flown.best_hz)
          << vehicle.rotor_w << " W, " << model.power.core_cubic_w;
    }
  }
}

TEST(MissionEnergyOnOtherBoards, chooses_lower_clocks_where_cores_take_more) {
  int lower = 0;
  for (const Vehicle& vehicle : vehicles) {
    const double usual_hz = Flown{tx2(), vehicle}.setting.clock_hz;
    const double hungry_hz = Flown{hungry(), vehicle}.setting.clock_hz;
    EXPECT_LE(hungry_hz, usual_hz) << vehicle.rotor_w << " W";
    lower += hungry_hz < usual_hz ? 1 : 0;
  }
  EXPECT_EQ(lower, 1) << "the light ones have the lowest clock anyway, the heavy one the highest";
}

TEST(MissionEnergyOnOtherBoards, chooses_the_top_clock_where_it_is_free) {
  const PlatformModel model = free_clock();
  const double top_hz = model.frequencies.back().value();
  int lower = 0;
  for (const Vehicle& vehicle : vehicles) {
    lower += Flown{tx2(), vehicle}.setting.clock_hz < top_hz ? 1 : 0;
    EXPECT_EQ(Flown(model, vehicle).setting.clock_hz, top_hz) << vehicle.rotor_w << " W";
  }
  EXPECT_GE(lower, 3) << "of a TX2, whose clock is not free";
}

TEST(MissionEnergyOnOtherBoards, would_waste_energy_with_the_watts_of_another_board) {
  const Vehicle light = vehicles.front();
  const MapSetting blind = settled(hungry(), board_model_of(free_clock()), light);
  const MapSetting right = Flown{hungry(), light}.setting;
  const Truth truth{hungry(), light};
  EXPECT_GT(truth.joules_per_m(blind), 1.05 * truth.joules_per_m(right));
}

}  // namespace
}  // namespace flyball
