// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Everything that a map can be asked, at random places, as numbers that can be compared to the
/// last bit.

#include "flyball/kernels/inflated_window.h"
#include "flyball/runtime/occupancy.h"

#include <cstdint>
#include <random>
#include <vector>

namespace flyball::kit {

/// What a map answers to the questions of a seed.
class MapAnswers {
 public:
  MapAnswers(const OccupancyView& map, unsigned seed, int rounds) : generator_{seed} {
    answers_.push_back(map.resolution_m());
    for (int i = 0; i < rounds; ++i) {
      ask(map);
    }
    if (const auto* inflatable = dynamic_cast<const Inflatable*>(&map)) {
      ask(*inflatable);
    }
  }
  [[nodiscard]] bool operator==(const MapAnswers& other) const {
    return answers_ == other.answers_ && words_ == other.words_;
  }
  [[nodiscard]] bool operator!=(const MapAnswers& other) const { return !(*this == other); }

 private:
  static constexpr Cylinder body{0.35, 0.15};

  void ask(const OccupancyView& map) {
    for (int i = 0; i < 10; ++i) {
      add(static_cast<double>(map.state(place())));
    }
    const Vec3 from = place();
    const Vec3 to = from + step();
    add(static_cast<double>(map.body_state(from, body)));
    add(map.has_occupied({from.cwiseMin(to), from.cwiseMax(to)}) ? 1.0 : 0.0);
    add(map.segment_hits(from, to, body) ? 1.0 : 0.0);
    add(map.obstacle_density(from, 3.0, 1.0));
    add(map.nearest_obstacle_m(from, 5.0, 1.0));
  }
  void ask(const Inflatable& map) {
    for (const auto by : {Obstruction::occupied, Obstruction::occupied_or_unknown}) {
      InflatedWindow window;
      const Vec3 low = place();
      map.inflate({low, low + Vec3{4.0, 3.0, 1.0}}, body, by, window);
      const auto& cells = window.layout().cells;
      const int words = window.row_words() * cells[1] * cells[2];
      words_.insert(words_.end(), window.words(), window.words() + words);
    }
  }
  void add(double answer) { answers_.push_back(answer); }
  Vec3 place() { return {random(-3.0, 9.0), random(-4.0, 4.0), random(-0.5, 4.0)}; }
  Vec3 step() { return {random(-2.0, 2.0), random(-2.0, 2.0), random(-1.0, 1.0)}; }
  double random(double low, double high) {
    return std::uniform_real_distribution<double>{low, high}(generator_);
  }

  std::mt19937 generator_;
  std::vector<double> answers_{};
  std::vector<std::uint64_t> words_{};
};

}  // namespace flyball::kit
