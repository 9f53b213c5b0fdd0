// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/studies/replay.h"

#include "flyball/records/summary.h"
#include "flyball/records/text_table.h"

#include "commands.h"
#include "console.h"
#include "flight_options.h"
#include <memory>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct ReplayOptions {
  std::string folder;
  bool trusts{};
  Plugins plugins{};
  std::string policy{};
};

std::string differences_text(const ReplayResult& result) {
  constexpr std::size_t most = 50;
  std::vector<std::vector<std::string>> lines{{"TIME", "RECORDED", "NOW"}};
  for (const Difference& one : result.differences) {
    if (lines.size() > most) {
      break;
    }
    lines.push_back({rounded(to_seconds(one.at), 3) + " s", one.recorded, one.now});
  }
  const std::size_t left = result.differences.size() - (lines.size() - 1);
  return aligned(lines) + (left == 0 ? "" : "and " + std::to_string(left) + " more\n");
}

/// Empty where the policy never failed.
std::string trouble_line(const std::string& policy, const ReplayResult& result) {
  const std::string trouble = trouble_text(result.faults, result.decisions, result.trouble);
  return trouble.empty() ? "" : "policy " + policy + " " + trouble + "\n";
}

int repeat(const RecordedFlight& flight) {
  const Result<ReplayResult> result = replay(flight);
  if (!result) {
    return refuse({result.error()});
  }
  const std::string trouble = trouble_line(flight.scenario.governor.policy, *result);
  if (result->different == 0) {
    print(std::to_string(result->decisions) + " decisions of policy " +
          flight.scenario.governor.policy + ", each the same again, bit for bit\n" + trouble);
    return exit_success;
  }
  print(std::to_string(result->different) + " of " + std::to_string(result->decisions) +
        " decisions are others than the record says; it was written by version " + flight.version +
        "\n" + trouble + differences_text(*result));
  return exit_mission_failed;
}

int ask(const RecordedFlight& flight, const std::string& policy) {
  const Result<ReplayResult> result = shadow(flight, policy);
  if (!result) {
    return refuse({result.error()});
  }
  const double share = result->decisions == 0 ? 0.0
                                              : static_cast<double>(result->different) /
                                                    static_cast<double>(result->decisions);
  print(policy + " would have set the knobs otherwise than " + flight.scenario.governor.policy +
        " at " + std::to_string(result->different) + " of " + std::to_string(result->decisions) +
        " decisions (" + rounded(100.0 * share, 1) + " %)\n" + trouble_line(policy, *result));
  if (!result->differences.empty()) {
    print(differences_text(*result));
  }
  return exit_success;
}

int run_replay(const ReplayOptions& options) {
  Result<RecordedFlight> flight = read_flight(options.folder, options.plugins);
  if (!flight) {
    return refuse({flight.error()});
  }
  flight->may_load_library = options.trusts;
  return options.policy.empty() ? repeat(*flight) : ask(*flight, options.policy);
}

}  // namespace

void add_replay(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("replay", "repeats every decision of a recorded flight");
  const auto options = std::make_shared<ReplayOptions>();  // Owners: the parser's callbacks.
  command->add_option("RUN", options->folder, "the folder of a run")->required();
  add_trust(*command, options->trusts);
  add_kernels(*command, options->plugins);
  refuse_empty(*command
                    ->add_option("--policy", options->policy,
                                 "lists where the decisions of this policy differ")
                    ->type_name("NAME"));
  command->callback([options, &exit_code] { exit_code = run_replay(*options); });
}

}  // namespace flyball
