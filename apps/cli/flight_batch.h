// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Many missions, each a process of its own: planned before the first one flies, flown a few at a
/// time, and what went wrong said once.

#include "flyball/scenario/override.h"

#include "console.h"
#include "flight_options.h"
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace flyball {

/// One mission that is to fly.
struct PlannedFlight {
  Scenario scenario{};
  std::string folder{};  ///< Its record goes there.
  std::vector<std::string> arguments{};
  std::vector<Override> given{};  ///< The settings that were asked for, without policy and seed.
};

/// Reads and checks the scenario with this policy and seed; nothing flies yet.
/// @param varied  Settings that only this flight has, on top of those of `options`.
[[nodiscard]] std::variant<PlannedFlight, std::vector<Error>> plan_flight(
    const FlightOptions& options,
    const std::string& policy,
    std::uint64_t seed,
    const std::string& folder,
    const std::vector<Override>& varied = {});

/// Adds the errors that say something new to `all`: most mistakes concern many flights.
void add_new(const std::vector<Error>& errors, std::vector<Error>& all);

/// Says what a user should know of policies before they fly: that settings change nothing which a
/// policy overrules, and that the kernel cannot confine a library.
class PolicyRemarks {
 public:
  /// Looks once at a policy, and once at its settings whatever the seed; says no sentence twice.
  void add(const Scenario& scenario, const std::vector<Override>& given);

 private:
  void tell(const std::string& sentence);

  std::set<std::string> seen_{};
  std::set<std::string> asked_{};
  std::set<std::string> told_{};
};

template <class Flight>
void remark_on_policies(const std::vector<Flight>& flights) {
  PolicyRemarks remarks;
  for (const PlannedFlight& flight : flights) {
    remarks.add(flight.scenario, flight.given);
  }
}

/// `two_level seed 7`
[[nodiscard]] std::string name_of(const PlannedFlight& flight);

struct Flown {
  int signal{};  ///< That interrupted it; 0: none.
  int exit_code{exit_success};
  std::vector<Error> errors{};  ///< Of missions that left no record.
};

/// @param took  Called for each one that has ended; false when it left no record.
[[nodiscard]] Flown fly_all(const std::vector<const PlannedFlight*>& flights,
                            std::size_t jobs,
                            const std::function<bool(std::size_t)>& took);

/// Says why not all flights were flown, and with what the command then ends. Empty: all were.
[[nodiscard]] std::optional<int> unfinished(const Flown& flown);

/// Seeds and policies of many missions come from options of their own, which `--set` would lose to.
/// @param policy_option  `--policies`, by which this command names policies.
/// @return               Every mistake.
[[nodiscard]] std::vector<Error> check_settings(const FlightOptions& options,
                                                const std::string& policy_option = "--policies");

/// Every mistake in these and in what the options of a contest's own gave. Two policies of one name
/// (files in different folders) would write over each other's flights.
[[nodiscard]] std::vector<Error> check_contest(const FlightOptions& options,
                                               const std::vector<std::string>& policies,
                                               const Result<std::vector<std::uint64_t>>& seeds);

}  // namespace flyball
