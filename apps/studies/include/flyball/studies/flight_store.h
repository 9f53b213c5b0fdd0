// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The results of many flights in one SQLite file, so that a tournament or a sweep can be continued
/// and queried.

#include "flyball/records/summary.h"
#include "flyball/scenario/scenario.h"

#include <memory>
#include <optional>
#include <string>

namespace flyball {

/// Identifies exactly this mission, flown by exactly this program. Another build, or another
/// content of a data file that it reads, gives another key.
[[nodiscard]] std::string mission_key(const Scenario& scenario);

/// The table `flights` has one row for each world, policy, seed and setting, and beside it stand
/// `kernels` and `quality` with one row for each name that a flight reported. They are written
/// after each flight, so that an interrupted study loses none.
class FlightStore {
 public:
  /// Makes the file if there is none. A file that an older version made gets the new columns.
  /// @error `unavailable` when it cannot be written, `invalid_input` when it is something else.
  [[nodiscard]] static Result<FlightStore> open(const std::string& path);
  FlightStore(FlightStore&&) noexcept;
  FlightStore& operator=(FlightStore&&) noexcept;
  FlightStore(const FlightStore&) = delete;
  FlightStore& operator=(const FlightStore&) = delete;
  ~FlightStore();

  /// The flight of this mission, if it is there.
  /// @param settings  What a sweep set beside the scenario's file, `map.range_m=5`; may be empty.
  [[nodiscard]] std::optional<Summary> find(const Scenario& scenario,
                                            const std::string& settings = {}) const;
  /// Replaces an older flight of the same world, policy, seed and settings.
  /// @error `unavailable`; the file is as before.
  [[nodiscard]] Status add(const Scenario& scenario,
                           const Summary& summary,
                           const std::string& settings = {});
  /// Adds all flights of another store; they replace those of the same world, policy, seed and
  /// settings, so that adding one twice is no harm.
  /// @error As `open`, and `unavailable`; this file is as before.
  [[nodiscard]] Status add_all_of(const std::string& other);

 private:
  struct Connection;
  explicit FlightStore(std::unique_ptr<Connection> connection);
  std::unique_ptr<Connection> connection_;
};

}  // namespace flyball
