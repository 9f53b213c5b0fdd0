// SPDX-License-Identifier: BSD-3-Clause

#include "cli/sweep/sweep_flights.h"

#include "flyball/runtime/recorder.h"
#include "flyball/studies/comparison.h"

#include <algorithm>
#include <filesystem>

namespace flyball {
namespace {

/// What this point sets beside what all have.
std::vector<Override> varied_at(const SweepRequest& request, const SweepPoint& point) {
  std::vector<Override> varied;
  for (std::size_t i = 0; i < point.values.size(); ++i) {
    varied.push_back({request.plan.axes[i].key + "=" + point.values[i], "--over"});
  }
  return varied;
}

/// A folder's name that says the settings, and differs where they differ.
std::string folder_name(const std::string& settings) {
  std::string name = settings;
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '=' || c == '-' || c == '+';
  };
  std::replace_if(
      name.begin(), name.end(), [&](char c) { return !is_plain(c); }, ',');
  constexpr std::size_t longest = 120;  // File systems end names at 255 bytes.
  TraceHash hash;
  hash.add(std::string_view{settings});
  return name.substr(0, longest) + "-" + hash.hex().substr(0, 8);
}

/// `1..3` or `1,4,9`, as `--seeds` reads it.
std::string seeds_word(const SweepRequest& request) {
  std::string seeds = seeds_text(request.plan.seeds);
  seeds.erase(std::remove(seeds.begin(), seeds.end(), ' '), seeds.end());
  return seeds;
}

/// With commas between them.
std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : ",") + word;
  }
  return text;
}

/// What all flights of a request have in common.
void add_common(const SweepRequest& request, std::vector<std::string>& words) {
  for (const std::string& setting : request.flight.settings) {
    words.insert(words.end(), {"--set", setting});
  }
  for (const std::string& library : request.flight.plugins.libraries()) {
    words.insert(words.end(), {"--kernels", library});
  }
}

}  // namespace

std::size_t flight_count(const SweepRequest& request) {
  return points_of(request.plan.axes, request.plan.policies).size() * request.plan.seeds.size();
}

std::variant<StoredFlight, std::vector<Error>> plan_sweep_flight(const SweepRequest& request,
                                                                 std::size_t number) {
  const std::vector<SweepPoint> points = points_of(request.plan.axes, request.plan.policies);
  const std::vector<std::uint64_t>& seeds = request.plan.seeds;
  if (number >= flight_count(request)) {
    return std::vector<Error>{
        {ErrorCode::invalid_input,
         "the array is of another sweep than that of " + request.flight.scenario}};
  }
  const SweepPoint& point = points[number / seeds.size()];
  const std::string settings = point.settings(request.plan.axes);
  const std::string folder =
      (std::filesystem::path{request.batch.folder} / "flights" / folder_name(settings)).string();
  auto planned = plan_flight(request.flight, point.policy, seeds[number % seeds.size()], folder,
                             varied_at(request, point));
  if (auto* errors = std::get_if<std::vector<Error>>(&planned)) {
    return std::move(*errors);
  }
  return StoredFlight{std::move(std::get<PlannedFlight>(planned)), settings, std::nullopt};
}

std::variant<std::vector<StoredFlight>, std::vector<Error>> plan_sweep(
    const SweepRequest& request) {
  std::vector<StoredFlight> flights;
  std::vector<Error> all;
  const std::size_t count = flight_count(request);
  for (std::size_t number = 0; number < count; ++number) {
    auto planned = plan_sweep_flight(request, number);
    if (const auto* errors = std::get_if<std::vector<Error>>(&planned)) {
      add_new(*errors, all);
    } else {
      flights.push_back(std::move(std::get<StoredFlight>(planned)));
    }
  }
  if (!all.empty()) {
    return all;
  }
  return flights;
}

std::string shell_text(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    const bool is_plain = !word.empty() && word.find_first_not_of(
                                               "abcdefghijklmnopqrstuvwxyz"
                                               "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                               "0123456789_-+=.,:/@%") == std::string::npos;
    text += text.empty() ? "" : " ";
    if (is_plain) {
      text += word;
      continue;
    }
    text += "'";
    for (const char c : word) {
      text += c == '\'' ? "'\\''" : std::string{c};
    }
    text += "'";
  }
  return text;
}

std::string command_of(const StoredFlight& flight) {
  std::vector<std::string> words{"flyball"};
  const auto& arguments = flight.arguments;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == "--out") {
      ++i;  // Where the record went is no part of the mission.
    } else if (arguments[i] != "--json") {
      words.push_back(arguments[i]);
    }
  }
  return shell_text(words);
}

std::vector<std::string> point_commands(const SweepRequest& request) {
  std::vector<std::string> commands;
  for (const SweepPoint& point : points_of(request.plan.axes, request.plan.policies)) {
    std::vector<std::string> words{"flyball",    "compare", request.flight.scenario, "--policies",
                                   point.policy, "--seeds", seeds_word(request)};
    add_common(request, words);
    for (const Override& setting : varied_at(request, point)) {
      words.insert(words.end(), {"--set", setting.key_and_value});
    }
    commands.push_back(shell_text(words));
  }
  return commands;
}

std::vector<std::string> sweep_words(const SweepRequest& request) {
  const bool is_sweep = !request.plan.axes.empty();  // The command wants a setting to vary.
  std::vector<std::string> words{
      "flyball",          is_sweep ? "sweep" : "compare", request.flight.scenario,
      "--policies",       joined(request.plan.policies),  "--seeds",
      seeds_word(request)};
  for (const SweepAxis& axis : request.plan.axes) {
    words.insert(words.end(), {"--over", axis.key + "=" + joined(axis.values)});
  }
  add_common(request, words);
  if (is_sweep && request.batch.keeps_records) {
    words.emplace_back("--keep-records");
  }
  return words;
}

}  // namespace flyball
