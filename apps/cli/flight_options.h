// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// @file
/// Which mission: the arguments that `run`, `compare` and `config` have in common.

#include "flyball/scenario/scenario.h"

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): not ours
class App;
class Option;
}  // namespace CLI

namespace flyball {

struct FlightOptions {
  std::string scenario;
  std::vector<std::string> settings{};  ///< `KEY=VALUE`
  Plugins plugins{};                    ///< With those of the libraries that options name.
  std::string out{};
  bool json{};
};

/// Adds `SCENARIO`, `--set` and `--kernels`.
void add_scenario(CLI::App& command, FlightOptions& options);
/// An option that was given, but with nothing (`--policy "$UNSET"`), is a mistake: it does not
/// stand for the default.
void refuse_empty(CLI::Option& option);
/// `nan`, which CLI11's ranges let through.
void refuse_nan(CLI::Option& option);
/// An option that takes names with commas between them. Spaces around a name are
/// no part of it, and no name is empty.
CLI::Option& add_names(CLI::App& command,
                       const std::string& option,
                       std::vector<std::string>& names,
                       const std::string& description);
/// Adds `--out` and `--json`.
void add_output(CLI::App& command, FlightOptions& options);

/// Adds `--policies` and `--seeds`.
void add_contest(CLI::App& command, std::vector<std::string>& policies, std::string& seeds);
/// Adds `--jobs`.
void add_jobs(CLI::App& command, std::size_t& jobs);

/// Adds `--kernels`: what the libraries bring joins `plugins`, which outlive the command. A library
/// that cannot be loaded is refused like any bad value of an option.
void add_kernels(CLI::App& command, Plugins& plugins);
/// Adds `--trust`, for records, which may be somebody else's.
void add_trust(CLI::App& command, bool& trusts);

/// The folder of one run: `OUT/runs/POLICY/seed_N`. A policy's file counts by its stem.
[[nodiscard]] std::string run_folder(const std::string& out,
                                     const std::string& policy,
                                     std::uint64_t seed);
/// `flights/SCENARIO` unless `--out` says otherwise.
[[nodiscard]] std::string comparison_folder(const FlightOptions& options, const Scenario& scenario);

}  // namespace flyball
