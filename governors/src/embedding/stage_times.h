// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// What a loop's own stages tell about it: latencies of frames, deadlines, the load of cores.

#include "flyball/runtime/time.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace flyball {

/// A part of somebody's loop; see `FlyballGovernorStage`.
struct StageSpec {
  struct Measure {
    std::string name;  ///< `map.cells`
    std::string description;
  };
  std::string name;
  Measure duration;  ///< Its name in lists: `map.duration_s`.
  std::vector<Measure> work{};
  Duration deadline{};  ///< Zero: there is none.
  std::uint32_t thread{};
  bool is_beside{};
};

/// Follows frames through the stages. A stage works on what the one before it finished last, so
/// each stage hands on when its frame was captured. A result that was worked on already is no new
/// frame. Times must not go back. Allocates only in `add`.
class StageTimes {
 public:
  struct Load {
    double busy_cores{};
    double busiest_core{};  ///< 0..1
  };

  void add(StageSpec spec);
  [[nodiscard]] std::size_t size() const { return stages_.size(); }
  [[nodiscard]] const StageSpec& spec(std::size_t stage) const { return stages_[stage].spec; }
  /// One that has begun and not ended is given up: its frame is lost, its time was spent.
  void begin(std::size_t stage, MissionTime now);
  [[nodiscard]] bool has_begun(std::size_t stage) const { return stages_[stage].begun.has_value(); }
  /// @return  Latency, where a frame leaves the last stage with this.
  /// @pre `has_begun(stage)`; `counts` has one number for each of its work, or is null.
  std::optional<Duration> end(std::size_t stage, MissionTime now, const double* counts);
  /// Empty until the stage has ended once.
  [[nodiscard]] std::optional<Duration> duration(std::size_t stage) const;
  [[nodiscard]] double count(std::size_t stage, std::size_t work) const;
  /// Of the newest frame that has left; empty before the first one.
  [[nodiscard]] std::optional<MissionTime> captured() const { return captured_; }

  /// How long ago the oldest frame was captured that a stage works on now; zero: there is none.
  [[nodiscard]] Duration age_under_way(MissionTime now) const;

  /// Deadlines that passed since the last call: of jobs that have ended, were given up or go on,
  /// each counted once.
  [[nodiscard]] std::uint32_t take_misses(MissionTime now);
  /// Since the last call, or since the first stage began.
  [[nodiscard]] Load take_load(MissionTime now);
  /// Cores that the jobs kept busy which ended between the last two calls of `take_load`, each
  /// counted whole, as `StageUse::load` has it.
  [[nodiscard]] double load(std::size_t stage) const { return stages_[stage].load; }

 private:
  struct Frame {
    MissionTime captured{};
    bool is_new{};
  };
  struct Stage {
    StageSpec spec;
    std::optional<MissionTime> begun{};
    bool is_late{};  ///< The miss of its deadline is counted.
    std::optional<Duration> last{};
    Frame input{};     ///< What the stage before it finished last.
    Frame frame{};     ///< What it works on.
    Duration busy{};   ///< Since the load was taken.
    Duration ended{};  ///< Jobs that ended since then.
    double load{};
    std::vector<double> counts{};
  };
  void stop(Stage& one, MissionTime now);
  void note_deadline(Stage& one, MissionTime now);
  [[nodiscard]] bool is_first(std::size_t stage) const;
  [[nodiscard]] Stage* after(std::size_t stage);

  std::vector<Stage> stages_;
  std::optional<MissionTime> captured_{};
  std::optional<MissionTime> load_since_{};
  std::uint32_t misses_{};
};

}  // namespace flyball
