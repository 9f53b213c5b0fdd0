// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Settings of one policy that fly the same seeds of one scenario, each as a preset in a file.

#include "flyball/studies/tuning.h"

#include "stored_flights.h"
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace flyball {

/// A policy, and what is given for it beside what is tried.
struct RacedPolicy {
  std::string policy{};  ///< A name, or an absolute path to a script or a library.
  std::map<std::string, ParameterValue> parameters{};
};

/// The policy of this name, or the one that a preset or a file holds.
/// @error Those of `load_preset`; `invalid_input` for a combination.
[[nodiscard]] Result<RacedPolicy> raced_policy(const std::string& name);

struct RaceSettings {
  FlightOptions flight{};
  RacedPolicy policy{};
  std::vector<std::uint64_t> seeds{};
  std::string presets{};  ///< The folder of the candidates' presets; it is made.
  std::string flights{};  ///< The folder of the flights' records.
  StoredBatch batch{};
};

/// Which of two candidates with the same seeds is better.
using RaceOrder = bool (*)(const Candidate&, const Candidate&);

class Race {
 public:
  /// @param store  Outlives the race.
  Race(RaceSettings settings, FlightStore& store);

  /// Lets each of the candidates fly the first so many seeds, as far as it has not.
  /// @return Why they did not all fly, as the exit code that `unfinished` gives, which has said it.
  [[nodiscard]] std::optional<int> fly(const std::vector<Candidate*>& candidates,
                                       std::size_t seeds);
  /// Successive halving; afterwards those that flew all seeds stand in front, best first.
  /// @return As `fly`.
  [[nodiscard]] std::optional<int> halve(std::vector<Candidate>& candidates, RaceOrder is_better);

  /// Whether anything was to fly: no settings were refused.
  [[nodiscard]] bool has_begun() const { return has_begun_; }
  /// With which it flies as a policy.
  [[nodiscard]] std::string preset_file(const Candidate& candidate) const;
  /// What stands in such a file.
  [[nodiscard]] std::string preset_of(const Candidate& candidate,
                                      const std::string& description) const;
  [[nodiscard]] const RaceSettings& settings() const { return settings_; }

 private:
  struct Heat;
  [[nodiscard]] Status write_preset(const Candidate& candidate) const;
  /// On errors no preset is left that was not there before.
  [[nodiscard]] std::variant<std::vector<Heat>, std::vector<Error>> plan(
      const std::vector<Candidate*>& candidates, std::size_t seeds) const;
  /// Of the seeds that the candidate has not flown.
  [[nodiscard]] std::vector<Error> add_heats(Candidate& candidate,
                                             std::size_t seeds,
                                             std::vector<Heat>& heats) const;

  RaceSettings settings_;
  FlightStore& store_;
  bool has_begun_{};
};

}  // namespace flyball
