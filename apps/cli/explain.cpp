// SPDX-License-Identifier: BSD-3-Clause

#include "flyball/records/text_table.h"
#include "flyball/runtime/observation_fields.h"
#include "flyball/runtime/text/listed.h"
#include "flyball/runtime/text/number_text.h"
#include "flyball/studies/replay.h"

#include "commands.h"
#include "console.h"
#include "flight_options.h"
#include <algorithm>
#include <charconv>
#include <memory>

#include <CLI/CLI.hpp>

namespace flyball {
namespace {

struct ExplainOptions {
  std::string folder;
  bool trusts{};
  Plugins plugins{};
  double at_s{};
};

std::string seen_text(const Observation& seen) {
  std::vector<std::vector<std::string>> lines;
  for (const ObservationField& field : observation_fields()) {
    const double value = field.get(seen);
    const bool is_phase = std::string{field.name} == "phase";
    lines.push_back({std::string{"  "} + field.name,
                     is_phase ? to_string(seen.phase) : rounded(value, value > 1000.0 ? 0 : 4)});
  }
  return aligned(lines);
}

std::string setting_text(const Decision& setting) {
  return listed(setting, [](const auto& one) {
    return std::string{one.knob} + " " + rounded(one.value, one.value > 1000.0 ? 0 : 2);
  });
}

/// A choice with its numbers in the fewest digits that stand for the same value: the record's own
/// 17 make .15 of .14999999999999999.
std::string readable(const std::string& choice) {
  std::string text;
  const char* at = choice.data();
  const char* const end = at + choice.size();
  while (at != end) {
    const char* const number = std::find(at, end, '=');
    const char* const begin = number == end ? end : number + 1;
    text.append(at, begin);
    double value = 0.0;
    const auto read = std::from_chars(begin, end, value);
    if (read.ec == std::errc{}) {
      text.append(number_text(value));
    }
    at = read.ptr;
  }
  return text;
}

std::string options_text(const std::vector<PolicyOption>& options) {
  if (options.empty()) {
    return "The policy compares no alternatives.\n";
  }
  constexpr std::size_t most = 8;
  std::vector<std::vector<std::string>> lines{{"  SETTING", "J/m", "m/s", "RESPONSE", "W per s"}};
  for (std::size_t i = 0; i < std::min(most, options.size()); ++i) {
    const PolicyOption& one = options[i];
    lines.push_back({"  " + setting_text(one.setting), rounded(one.joules_per_m, 2),
                     rounded(one.speed_m_s, 2), rounded(one.response_s, 3) + " s",
                     rounded(one.watts_per_second, 1)});
  }
  return "It weighed " + std::to_string(options.size()) + " settings; the best:\n" + aligned(lines);
}

std::string worth_text(const Explanation& e) {
  if (e.watts_per_second == 0.0) {
    return "A second of latency is worth nothing here: a manoeuvre or the mission's limit of "
           "speed, not "
           "latency, holds the vehicle.\n";
  }
  return "A second of latency is worth " + rounded(e.watts_per_second, 1) +
         " W here: P / (delta + v / a), delta = " + rounded(e.response_s, 3) + " s.\n";
}

int run_explain(const ExplainOptions& options) {
  Result<RecordedFlight> flight = read_flight(options.folder, options.plugins);
  if (!flight) {
    return refuse({flight.error()});
  }
  flight->may_load_library = options.trusts;
  const Result<Explanation> told = explain(*flight, MissionTime{from_seconds(options.at_s)});
  if (!told) {
    return refuse({told.error()});
  }
  print("Policy " + flight->scenario.governor.policy + " at " + rounded(to_seconds(told->at), 3) +
        " s saw\n" + seen_text(told->seen) + "It chose " + readable(told->choice) + "\n" +
        options_text(told->options) + worth_text(*told));
  return exit_success;
}

}  // namespace

void add_explain(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "explain", "shows what a policy saw and compared at one moment of a recorded flight");
  const auto options = std::make_shared<ExplainOptions>();  // Owners: the parser's callbacks.
  command->add_option("RUN", options->folder, "the folder of a run")->required();
  add_trust(*command, options->trusts);
  add_kernels(*command, options->plugins);
  refuse_nan(*command
                  ->add_option("--at", options->at_s,
                               "mission time; the last decision until then is shown")
                  ->type_name("SECONDS")
                  ->required()
                  ->check(CLI::Range(0.0, 86400.0)));
  command->callback([options, &exit_code] { exit_code = run_explain(*options); });
}

}  // namespace flyball
