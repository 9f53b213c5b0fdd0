// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// The results of a tournament in one SQLite file, so that it can be continued and queried.

#include "flyball/records/summary.h"
#include "flyball/scenario/scenario.h"

#include <memory>
#include <optional>
#include <string>

namespace flyball {

/// Identifies exactly this mission, flown by exactly this program. Another build, or another
/// content of a data file that it reads, gives another key.
[[nodiscard]] std::string mission_key(const Scenario& scenario);

/// The table `flights` has one row for each world, policy and seed. It is written after each
/// flight, so that an interrupted tournament loses none.
class TournamentStore {
 public:
  /// Makes the file if there is none.
  /// @error `unavailable` when it cannot be written, `invalid_input` when it is something else.
  [[nodiscard]] static Result<TournamentStore> open(const std::string& path);
  TournamentStore(TournamentStore&&) noexcept;
  TournamentStore& operator=(TournamentStore&&) noexcept;
  TournamentStore(const TournamentStore&) = delete;
  TournamentStore& operator=(const TournamentStore&) = delete;
  ~TournamentStore();

  /// The flight of this mission, if it is there.
  [[nodiscard]] std::optional<Summary> find(const Scenario& scenario) const;
  /// Replaces an older flight of the same world, policy and seed.
  /// @error `unavailable`; the file is as before.
  [[nodiscard]] Status add(const Scenario& scenario, const Summary& summary);

 private:
  struct Connection;
  explicit TournamentStore(std::unique_ptr<Connection> connection);
  std::unique_ptr<Connection> connection_;
};

}  // namespace flyball
